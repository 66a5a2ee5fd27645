use std::sync::{Arc, OnceLock};

use crate::{BrickCells, BrickGrid, BrickId, BrickRange, ReadError, RowAxis, VolumeDesc, VoxelCountTable};

/// Where bricks come from. Renderers and residency know nothing else of files.
pub trait BrickSource: Send + Sync {
    /// The volume at full resolution.
    fn desc(&self) -> &VolumeDesc;

    /// How many levels there are; level 0 is full resolution.
    fn levels(&self) -> u32;

    /// The bricks of a level.
    fn grid(&self, level: u32) -> BrickGrid;

    /// The range of every brick of a level, by place in the grid. Always at hand.
    fn ranges(&self, level: u32) -> &[BrickRange];

    /// The voxel-count table of every brick of a level, by place in the grid; made or loaded at first use.
    ///
    /// # Errors
    /// When the voxels or tables cannot be read.
    fn voxel_count_tables(&self, level: u32) -> Result<Arc<Vec<VoxelCountTable>>, ReadError>;

    /// A brick with its halo.
    ///
    /// # Errors
    /// When it cannot be read; the message names it.
    fn brick(&self, id: BrickId) -> Result<Arc<Brick>, ReadError>;

    /// A brick with its halo, whose rows lie along an axis.
    ///
    /// # Errors
    /// As of [`brick`](Self::brick).
    fn brick_along(&self, id: BrickId, row_axis: RowAxis) -> Result<Arc<Brick>, ReadError> {
        self.brick(id).map(|brick| brick.shared_along(row_axis))
    }

    /// Several bricks with their halos, in the order of `ids`. Threads may share the work; what is found in memory, and
    /// stays there, depends on the order alone.
    fn bricks(&self, ids: &[BrickId]) -> Vec<Result<Arc<Brick>, ReadError>> {
        ids.iter().map(|&id| self.brick(id)).collect()
    }

    /// Hints that bricks may soon be asked for, so that slow storage can begin to bring them; reads none.
    fn will_need(&self, bricks: &[BrickId]);

    /// Whether that many bricks can be in use at once without going over the memory that was promised.
    fn can_hold(&self, bricks: usize) -> bool;

    /// Whether a brick is at hand without being loaded.
    fn is_kept(&self, _id: BrickId) -> bool {
        false
    }

    /// Voxels of the volume that are not finite; they are read as 0.
    fn not_finite(&self) -> u64;

    /// Bytes read from files so far, before decoding.
    fn bytes_read(&self) -> u64;
}

/// The voxels of a brick in stored values, halo included: edge³ of them, rows along x unless it is turned, and then
/// [`Brick::PADDING`] more that mean nothing, so that kernels may read a little beyond.
#[derive(Clone, Debug, PartialEq)]
pub struct Brick {
    /// Voxels along each axis.
    pub edge: u32,
    pub voxels: Voxels,
    /// The axis that has changed places with x.
    pub row_axis: RowAxis,
    /// Found when they are first asked for.
    cells: OnceLock<BrickCells>,
}

/// Voxels in the type that they are kept in memory in; `u32`, `i32` and `f64` were rounded to `f32`.
#[derive(Clone, Debug, PartialEq)]
pub enum Voxels {
    U8(Vec<u8>),
    I8(Vec<i8>),
    U16(Vec<u16>),
    I16(Vec<i16>),
    F32(Vec<f32>),
}

impl Brick {
    /// Elements behind the last voxel.
    pub const PADDING: usize = 16;

    /// A brick of edge³ voxels and the padding behind them.
    pub fn new(edge: u32, voxels: Voxels) -> Self {
        Self { edge, voxels, row_axis: RowAxis::X, cells: OnceLock::new() }
    }

    /// The brick with its rows along an axis. What was found of its cells is turned, too.
    pub fn along(self, row_axis: RowAxis) -> Self {
        let Self { edge, mut voxels, row_axis: before, cells } = self;
        let mut cells = cells.into_inner();
        for turn in [before, row_axis] {
            let edge = edge as usize;
            match &mut voxels {
                Voxels::U8(voxels) => turn.turn(voxels, edge),
                Voxels::I8(voxels) => turn.turn(voxels, edge),
                Voxels::U16(voxels) => turn.turn(voxels, edge),
                Voxels::I16(voxels) => turn.turn(voxels, edge),
                Voxels::F32(voxels) => turn.turn(voxels, edge),
            }
            if let Some(BrickCells { edge, min, max }) = &mut cells {
                turn.turn(min, *edge);
                turn.turn(max, *edge);
            }
        }
        Self { edge, voxels, row_axis, cells: cells.map_or_else(OnceLock::new, OnceLock::from) }
    }

    /// The brick with its rows along an axis: the same where they are, turned in place where nobody else holds it.
    pub fn shared_along(self: Arc<Self>, row_axis: RowAxis) -> Arc<Self> {
        if self.row_axis == row_axis { self } else { Arc::new(Arc::unwrap_or_clone(self).along(row_axis)) }
    }

    /// The ranges of the brick's cells.
    pub fn cells(&self) -> &BrickCells {
        self.cells.get_or_init(|| BrickCells::of(self))
    }

    /// Size in memory, in bytes, cells included.
    pub fn bytes(&self) -> usize {
        let voxels = match &self.voxels {
            Voxels::U8(voxels) => voxels.len(),
            Voxels::I8(voxels) => voxels.len(),
            Voxels::U16(voxels) => 2 * voxels.len(),
            Voxels::I16(voxels) => 2 * voxels.len(),
            Voxels::F32(voxels) => 4 * voxels.len(),
        };
        voxels + BrickCells::bytes(self.edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cells_of_a_turned_brick_are_those_of_its_voxels() {
        let edge = 21;
        let voxels = (0..edge * edge * edge + Brick::PADDING as u32).map(|place| (place * 7919 / 8) as u16);
        let brick = Brick::new(edge, Voxels::U16(voxels.collect()));
        brick.cells();
        for row_axis in RowAxis::ALL {
            let turned = brick.clone().along(row_axis);
            assert!(turned.cells.get().is_some(), "they are not found again");
            assert_eq!(*turned.cells(), BrickCells::of(&turned), "{row_axis:?}");
            assert_eq!(turned.along(RowAxis::X), brick, "{row_axis:?}, and back");
        }
    }
}
