//! What holds of every volume, layout, transfer function and camera that proptest thinks up.
//!
//! Each property is held against counting by hand: plain loops over voxels, bricks, pixels and samples.

use proptest::prelude::ProptestConfig;

mod any;
mod boundary_bricks;
mod emptiness;
mod frame_plans;
mod instruction_sets;
mod ownership;
mod ranges;
mod sample_counts;
mod stored;
mod transfer_functions;
mod voxel_count_tables;

/// As many cases as are quick, or as `PROPTEST_CASES` asks for.
fn cases(quick: u32) -> ProptestConfig {
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    ProptestConfig::with_cases(asked.unwrap_or(quick))
}
