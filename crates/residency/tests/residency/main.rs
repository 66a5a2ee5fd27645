//! What the crate promises to those who draw with it.

mod any;
mod fake_source;
mod loader;
mod model;
mod naive_set;
mod page_table;
mod rounds;
mod working_set;

use glassbrick_volume::BrickId;

/// A brick of a row at level 0.
fn brick(x: u32) -> BrickId {
    BrickId { level: 0, x, y: 0, z: 0 }
}

fn bricks(xs: impl IntoIterator<Item = u32>) -> Vec<BrickId> {
    xs.into_iter().map(brick).collect()
}
