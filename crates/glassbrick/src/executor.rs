use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use glassbrick_cpu::{CpuScene, InstructionSet};
use glassbrick_gpu::{GpuFrame, GpuRenderer, GpuScene};
use glassbrick_volume::{
    BakedTransferFunction, BrickId, BrickSource, Frame, FramePlan, FrameRays, ResidencyCounts,
};

use crate::visible_levels::VisibleLevel;
use crate::{Backend, Error, RenderRequest, Volume};

/// What draws frames.
pub enum Executor {
    Cpu(InstructionSet),
    Gpu { renderer: Box<Mutex<GpuRenderer>>, adapter: String },
}

/// Whether a frame waits for bricks.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Waiting {
    /// Until the picture is complete.
    Complete,
    /// Not at all: what is resident is drawn.
    Never,
}

/// A finished frame, whatever drew it.
pub struct Drawn {
    pub frame: Frame,
    pub pass: &'static str,
    pub samples: Option<u64>,
    pub occluded: usize,
    pub rendered: usize,
    pub damaged: BTreeMap<u32, String>,
    pub complete: bool,
    /// What went through a GPU's memory; nothing where the CPU drew.
    pub residency: Option<ResidencyCounts>,
}

impl Executor {
    pub fn new(volume: &Volume, request: &RenderRequest) -> Result<Self, Error> {
        let Backend::Gpu(gpu) = &request.backend else {
            return Ok(Self::Cpu(request.instruction_set.unwrap_or_else(InstructionSet::best)));
        };
        let source: Arc<dyn BrickSource> = Arc::clone(&volume.source) as _;
        let renderer =
            GpuRenderer::new(Arc::clone(gpu.device()), source, request.gpu_memory_bytes, volume.threads())?;
        Ok(Self::Gpu { renderer: Box::new(Mutex::new(renderer)), adapter: gpu.adapter().to_owned() })
    }

    pub fn backend(&self) -> &'static str {
        match self {
            Self::Cpu(_) => "cpu",
            Self::Gpu { .. } => "gpu",
        }
    }

    /// What it draws on.
    pub fn adapter(&self, volume: &Volume) -> String {
        match self {
            Self::Cpu(set) => format!("CPU, {}, {} threads", set.name(), volume.threads()),
            Self::Gpu { adapter, .. } => adapter.clone(),
        }
    }

    #[expect(
        clippy::too_many_arguments,
        reason = "a frame brings a volume, a request, rays and a plan together"
    )]
    pub fn draw(
        &self,
        volume: &Volume,
        request: &RenderRequest,
        transfer_function: &BakedTransferFunction,
        rays: &FrameRays,
        plan: &FramePlan,
        visible: &VisibleLevel,
        waiting: Waiting,
    ) -> Result<Drawn, Error> {
        match self {
            Self::Cpu(set) => {
                let scene = CpuScene {
                    rays,
                    plan,
                    transfer_function,
                    settings: request.settings,
                    shown_cells: &visible.cells,
                    allow_damaged: request.allow_damaged,
                };
                let source = volume.source.as_ref();
                let drawn = volume.threads.install(|| glassbrick_cpu::draw(source, &scene, *set))?;
                Ok(Drawn {
                    frame: drawn.frame,
                    pass: "layers",
                    samples: Some(drawn.samples),
                    occluded: drawn.occluded,
                    rendered: drawn.rendered,
                    complete: drawn.damaged.is_empty(),
                    damaged: drawn.damaged,
                    residency: None,
                })
            }
            Self::Gpu { renderer, .. } => {
                let scene = GpuScene {
                    rays,
                    plan,
                    transfer_function,
                    settings: request.settings,
                    pass: request.pass,
                    allow_damaged: request.allow_damaged,
                };
                let mut renderer = renderer.lock().unwrap_or_else(PoisonError::into_inner);
                let drawn = match waiting {
                    Waiting::Complete => renderer.draw(&scene)?,
                    Waiting::Never => renderer.draw_resident(&scene)?,
                };
                Ok(of_gpu(drawn, request.gpu_memory_bytes))
            }
        }
    }

    /// Prefetches and pins boundary bricks; returns how many. The CPU's memory pins none.
    pub fn pin(&self, bricks: impl FnOnce(usize) -> Vec<BrickId>) -> Result<usize, Error> {
        match self {
            Self::Cpu(_) => Ok(0),
            Self::Gpu { renderer, .. } => {
                let mut renderer = renderer.lock().unwrap_or_else(PoisonError::into_inner);
                let bricks = bricks(renderer.slots());
                Ok(renderer.pin(&bricks)?)
            }
        }
    }
}

fn of_gpu(drawn: GpuFrame, budget_bytes: u64) -> Drawn {
    let residency = ResidencyCounts {
        budget_bytes,
        peak_bytes: drawn.peak_bytes,
        hits: drawn.slots.hits,
        misses: drawn.slots.misses,
        uploads: drawn.uploads.uploads,
        bytes_uploaded: drawn.uploads.bytes,
        evictions: drawn.slots.evictions,
        bytes_read: 0,
    };
    Drawn {
        frame: drawn.frame,
        pass: drawn.pass.name(),
        samples: drawn.samples,
        occluded: drawn.occluded,
        rendered: drawn.rendered,
        damaged: drawn.damaged,
        complete: drawn.complete,
        residency: Some(residency),
    }
}
