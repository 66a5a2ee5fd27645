use std::collections::BTreeMap;

use glassbrick_residency::WorkingSetCounts;
use glassbrick_volume::{BakedTransferFunction, Frame, FramePlan, FrameRays, RenderSettings};

use crate::residents::UploadCounts;

/// Which pass draws a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GpuPass {
    /// One march per pixel.
    #[default]
    Raycast,
    /// Slices back to front in layers front to back.
    Slices,
}

impl GpuPass {
    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Raycast => "raycast",
            Self::Slices => "slices",
        }
    }
}

/// What is to be drawn.
pub struct GpuScene<'a> {
    pub rays: &'a FrameRays,
    pub plan: &'a FramePlan,
    pub transfer_function: &'a BakedTransferFunction,
    pub settings: RenderSettings,
    pub pass: GpuPass,
    /// Whether bricks that cannot be read are left out; else the first one ends the drawing.
    pub allow_damaged: bool,
}

/// A finished frame and what it took.
pub struct GpuFrame {
    pub frame: Frame,
    /// What drew it: rays where slices cannot, as the mean on devices that do not blend f32.
    pub pass: GpuPass,
    /// Samples evaluated; nothing where they cannot be counted.
    pub samples: Option<u64>,
    /// Planned bricks that could not change the picture when their turn came.
    pub occluded: usize,
    /// Planned bricks of which something was drawn.
    pub rendered: usize,
    /// Why bricks were left out that could not be read, by place in the grid.
    pub damaged: BTreeMap<u32, String>,
    /// Whether every brick that was needed was drawn.
    pub complete: bool,
    pub slots: WorkingSetCounts,
    pub uploads: UploadCounts,
    /// Bytes of atlas textures at once, at most.
    pub peak_bytes: u64,
}
