//! The CPU executor: draws a frame plan with the processor.
//!
//! It takes bricks from any [`BrickSource`](glassbrick_volume::BrickSource) and knows nothing about files or GPUs.
//!
//! The picture is cut into tiles of rays. Where memory holds all bricks of the frame, a thread takes a block of tiles
//! through all its bricks, front to back (`by_blocks`); else threads share the bricks of one layer after the other, each
//! locking the tiles that a brick can meet (`by_layers`). Rays meet at most one brick of a layer, so the order in which
//! threads come to a tile changes nothing.
//!
//! How a tile takes a brick's samples is a kernel's: `scalar` goes sample by sample and is the truth that others are
//! held to; `simd` takes packets of rays at once, and leaps over cells of a brick that show nothing. Where rays go along
//! the volume's rows and memory holds all bricks, `simd::rows` takes rows of pixels through all their bricks instead.

mod by_blocks;
mod by_layers;
mod executor;
mod kernel;
mod scalar;
mod simd;
mod tiles;

use glassbrick_volume::{BrickSource, ReadError};

pub use executor::{CpuFrame, CpuScene};
pub use simd::{InstructionSet, ShownCells};

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
