//! What a report says of its bricks is what brute force says: of how many nothing can be seen, exactly; and of the rest,
//! none that a ray needs is left out, and each stage leaves as many as the one before it, or fewer.

mod bounds;
mod nearly_empty;
mod phantoms;
mod runs;

use glassbrick::{BrickLayout, Gpu, GpuPass, RenderRequest};
use glassbrick_tests::gpu::gpu;

use crate::gpu::on;

/// Cores of 60 and of 28 voxels.
const LAYOUTS: [BrickLayout; 2] = [BrickLayout { edge: 64, halo: 2 }, BrickLayout { edge: 32, halo: 2 }];

/// What draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Executor {
    Cpu,
    Gpu(GpuPass),
}

impl Executor {
    /// The GPU that it draws on: none for the CPU. Nothing at all where there is none; the test says then that it is
    /// skipped.
    fn device(self) -> Option<Option<&'static Gpu>> {
        match self {
            Self::Cpu => Some(None),
            Self::Gpu(_) => gpu().map(Some),
        }
    }

    /// A request that asks for it.
    fn asked(self, device: Option<&Gpu>, request: RenderRequest) -> RenderRequest {
        match (self, device) {
            (Self::Gpu(pass), Some(gpu)) => on(gpu, pass, request),
            _ => request,
        }
    }

    /// What reports call it.
    fn pass(self) -> &'static str {
        match self {
            Self::Cpu => "layers",
            Self::Gpu(pass) => pass.name(),
        }
    }
}
