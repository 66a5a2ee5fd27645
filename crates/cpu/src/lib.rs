//! The CPU executor: draws a frame plan with the processor, layer by layer, bricks in parallel.
//!
//! It takes bricks from any [`BrickSource`](glassbrick_volume::BrickSource) and knows nothing about files or GPUs. Its
//! scalar code is the truth that other executors are held to.
//!
//! The picture is cut into tiles. A thread that draws a brick locks one tile of its footprint after the other,
//! finds for each ray the samples that the brick owns, and adds them to the ray's pixel. Rays meet at most one brick of
//! a layer, so the order in which threads come to a tile changes nothing.

mod by_blocks;
mod by_layers;
mod executor;
mod kernel;
mod scalar;
mod simd;
mod tiles;

use glassbrick_volume::{BrickSource, ReadError};

pub use executor::{CpuFrame, CpuScene};
pub use simd::InstructionSet;

/// Draws a planned frame on the threads of the current rayon pool.
///
/// # Errors
/// When a brick cannot be read.
///
/// # Panics
/// When this processor does not have the instructions.
pub fn draw(
    source: &dyn BrickSource,
    scene: &CpuScene,
    instruction_set: InstructionSet,
) -> Result<CpuFrame, ReadError> {
    assert!(instruction_set.is_available(), "this processor has no {}", instruction_set.name());
    let is_large = source.grid(scene.plan.level).layout.edge > simd::LARGEST_EDGE;
    if instruction_set == InstructionSet::Scalar || is_large {
        return scalar::draw(source, scene);
    }
    simd::draw(source, scene, instruction_set)
}
