use glassbrick_cpu::InstructionSet;
use glassbrick_gpu::GpuPass;
use glassbrick_volume::{NearlyEmpty, RenderSettings, TransferFunction};

use crate::{Backend, Error, process_memory};

/// Pixels along a side of a picture, at most.
const MOST_PIXELS: u32 = 32_768;

/// Memory that a pixel takes at least: colour, opacity and depth, and three bytes of its picture.
const PIXEL_BYTES: u64 = 5 * size_of::<f32>() as u64 + 3;

/// Memory of a GPU for bricks, where nothing is said.
pub const DEFAULT_GPU_MEMORY_BYTES: u64 = 512 << 20;

/// What is to be drawn, besides the volume and the camera.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderRequest {
    pub transfer_function: TransferFunction,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Distance of samples, in voxels of the smallest spacing.
    pub step_voxels: f64,
    pub settings: RenderSettings,
    /// Nearly empty bricks to drop, in direct volume rendering; loses something of the picture.
    pub nearly_empty: NearlyEmpty,
    pub level: LevelChoice,
    /// What draws.
    pub backend: Backend,
    /// How a GPU draws.
    pub pass: GpuPass,
    /// Memory of a GPU for bricks.
    pub gpu_memory_bytes: u64,
    /// Whether bricks that cannot be read are left out; else the first one ends the drawing.
    pub allow_damaged: bool,
    /// What the CPU draws with; the best that it has where nothing is said.
    pub instruction_set: Option<InstructionSet>,
}

impl RenderRequest {
    /// The defaults for a transfer function: 512×512 pixels, one-voxel steps, everything exact.
    pub fn new(transfer_function: TransferFunction) -> Self {
        Self {
            transfer_function,
            size: [512, 512],
            step_voxels: 1.0,
            settings: RenderSettings::default(),
            nearly_empty: NearlyEmpty::KEEP,
            level: LevelChoice::Auto,
            backend: Backend::Cpu,
            pass: GpuPass::default(),
            gpu_memory_bytes: DEFAULT_GPU_MEMORY_BYTES,
            allow_damaged: false,
            instruction_set: None,
        }
    }
}

/// Which level of the volume to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelChoice {
    /// The coarsest whose voxels are no larger than a pixel where the volume is nearest.
    Auto,
    Exact(u32),
}

impl RenderRequest {
    /// Whether this can be drawn of any volume.
    ///
    /// # Errors
    /// What is impossible.
    pub(crate) fn check(&self) -> Result<(), Error> {
        if self.size.iter().any(|pixels| !(1..=MOST_PIXELS).contains(pixels)) {
            return Err(Error::View("a picture has 1 to 32768 pixels on a side"));
        }
        let frame_bytes = self.size.iter().map(|&pixels| u64::from(pixels)).product::<u64>() * PIXEL_BYTES;
        let is_too_much = process_memory::available_bytes().is_some_and(|available| frame_bytes > available);
        if is_too_much || !process_memory::can_reserve(frame_bytes) {
            return Err(Error::View(
                "a picture of this size does not fit into the memory that is free; make it smaller",
            ));
        }
        if self.instruction_set.is_some_and(|set| !set.is_available()) {
            return Err(Error::View("this processor does not have the instructions that were asked for"));
        }
        let unit = 0.0..=1.0;
        if !unit.contains(&self.nearly_empty.alpha) || !unit.contains(&self.nearly_empty.beta) {
            return Err(Error::View("alpha and beta lie between 0 and 1"));
        }
        if self.settings.opacity_cutoff.is_nan() || self.settings.opacity_cutoff <= 0.0 {
            return Err(Error::View("the opacity cutoff lies above 0; 1 never stops"));
        }
        Ok(())
    }
}
