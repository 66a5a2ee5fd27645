//! The CPU executor: draws a frame plan with the processor, layer by layer, bricks in parallel.
//!
//! It takes bricks from any [`BrickSource`](glassbrick_volume::BrickSource) and knows nothing about files or GPUs. Its
//! scalar code is the truth that other executors are held to.
//!
//! The picture is cut into tiles. A thread that draws a brick locks one tile of its footprint after the other,
//! finds for each ray the samples that the brick owns, and adds them to the ray's pixel. Rays meet at most one brick of
//! a layer, so the order in which threads come to a tile changes nothing.

mod executor;
mod kernel;
mod scalar;
mod tiles;

use glassbrick_volume::{BrickSource, ReadError};

pub use executor::{CpuFrame, CpuScene};

/// Draws a planned frame on the threads of the current rayon pool.
///
/// # Errors
/// When a brick cannot be read.
pub fn draw(source: &dyn BrickSource, scene: &CpuScene) -> Result<CpuFrame, ReadError> {
    scalar::draw(source, scene)
}
