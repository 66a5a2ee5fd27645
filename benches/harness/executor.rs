use glassbrick::{Backend, GpuPass, RenderRequest, RenderSettings, Skip};

/// A way to draw that is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Executor {
    Hw,
    Sw,
    Slices,
    Raycast,
    Cpu,
}

impl Executor {
    /// Every executor: first the baselines, as in Xie, Yang and Zhu 2007, then what is compared with them.
    pub const ALL: [Self; 5] = [Self::Hw, Self::Sw, Self::Slices, Self::Raycast, Self::Cpu];

    /// The name in commands and results.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Hw => "hw",
            Self::Sw => "sw",
            Self::Slices => "slices",
            Self::Raycast => "raycast",
            Self::Cpu => "cpu",
        }
    }

    /// What it is, in one line.
    pub const fn summary(self) -> &'static str {
        match self {
            Self::Hw => "GPU slices without any visibility test: every brick in the frustum is drawn",
            Self::Sw => {
                "a plain ray caster on the CPU, without bricks or vectors, with early ray termination"
            }
            Self::Slices => "GPU slices by layers, with occlusion queries and a stencil of what is opaque",
            Self::Raycast => "GPU rays through a page table of bricks, with skipping and early termination",
            Self::Cpu => "the CPU renderer: bricks, cells, vectors, every thread",
        }
    }

    /// Whether it draws on a GPU.
    pub const fn needs_gpu(self) -> bool {
        matches!(self, Self::Hw | Self::Slices | Self::Raycast)
    }

    /// A request, changed so that this executor draws it; `backend` is the GPU for those that need it.
    pub fn request(self, request: RenderRequest, backend: Backend) -> RenderRequest {
        let pass = if self == Self::Raycast { GpuPass::Raycast } else { GpuPass::Slices };
        let skip = if self == Self::Hw { Skip::None } else { request.settings.skip };
        let settings = RenderSettings { skip, ..request.settings };
        RenderRequest { backend, pass, settings, ..request }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_distinct() {
        let mut names = Executor::ALL.map(Executor::name).to_vec();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), Executor::ALL.len());
    }
}
