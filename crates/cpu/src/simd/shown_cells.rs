use std::sync::OnceLock;

use glassbrick_volume::{Occupancy, RowAxis};

use super::occupied_rows::OccupiedRows;

/// Which cells of a level's bricks a transfer function can see: found when a brick is first drawn, and kept from frame
/// to frame, for they depend on nothing else. Belongs to one source, level and transfer function.
pub struct ShownCells {
    /// By place in the grid.
    bricks: Vec<ShownBrick>,
    pub(super) all_rows: OccupiedRows,
}

/// Nothing is kept of bricks in which nothing is seen.
#[derive(Default)]
struct ShownBrick {
    occupancy: OnceLock<Option<Box<Occupancy>>>,
    /// By the axis along which the brick's rows lie.
    rows: [OnceLock<Option<Box<OccupiedRows>>>; RowAxis::ALL.len()],
}

impl ShownCells {
    /// Nothing is known of any of so many bricks.
    pub fn new(bricks: usize) -> Self {
        let bricks = (0..bricks).map(|_| ShownBrick::default()).collect();
        Self { bricks, all_rows: OccupiedRows::all() }
    }

    /// How far each cell of a brick is from one that is seen.
    pub(super) fn occupancy(
        &self,
        brick: u32,
        find: impl FnOnce() -> Option<Occupancy>,
    ) -> Option<&Occupancy> {
        self.bricks[brick as usize].occupancy.get_or_init(|| find().map(Box::new)).as_deref()
    }

    /// The cells of a brick that are seen, row by row.
    pub(super) fn rows(
        &self,
        brick: u32,
        row_axis: RowAxis,
        find: impl FnOnce() -> Option<OccupiedRows>,
    ) -> Option<&OccupiedRows> {
        self.bricks[brick as usize].rows[row_axis as usize].get_or_init(|| find().map(Box::new)).as_deref()
    }
}
