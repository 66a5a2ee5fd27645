use glam::{IVec3, UVec3, Vec3};

use crate::volume_level::{level_end, level_extent};
use crate::{RowAxis, VOLUME_MARGIN_VOXELS};

/// How a volume is cut: bricks of `edge`³ voxels, of which a halo on every side repeats the neighbours' voxels.
///
/// What is between the halos is the core, and cores tile the volume. Voxels of a brick beyond the volume repeat
/// the volume's edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BrickLayout {
    /// Voxels along each axis of a brick, halo included.
    pub edge: u32,
    /// Voxels of halo on each side; 2 serves central differences everywhere in the core.
    pub halo: u32,
}

impl Default for BrickLayout {
    fn default() -> Self {
        Self { edge: 64, halo: 2 }
    }
}

impl BrickLayout {
    /// Voxels along each axis of a core.
    pub const fn core(self) -> u32 {
        self.edge - 2 * self.halo
    }

    /// Voxels of a brick, halo included.
    pub const fn voxels(self) -> usize {
        (self.edge as usize).pow(3)
    }

    /// The grid of bricks that covers a volume of `extent` voxels.
    pub fn grid(self, extent: UVec3) -> BrickGrid {
        self.level_grid(extent, 0)
    }

    /// The grid of bricks that covers a level of a volume that has `extent` voxels at level 0.
    pub fn level_grid(self, extent: UVec3, level: u32) -> BrickGrid {
        let level_extent = level_extent(extent, level);
        BrickGrid {
            layout: self,
            extent: level_extent,
            end: level_end(extent, level).as_vec3(),
            counts: level_extent.map(|n| n.div_ceil(self.core())),
        }
    }

    /// How many levels a volume has until one brick is left.
    pub fn levels(self, extent: UVec3) -> u32 {
        let is_one_brick = |level| level_extent(extent, level).max_element() <= self.core();
        1 + (0..).find(|&level| is_one_brick(level)).expect("an extent of 32 bits is halved to one voxel")
    }
}

/// A brick by its level (0 is full resolution) and its place in that level's grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BrickId {
    pub level: u32,
    pub x: u32,
    pub y: u32,
    pub z: u32,
}

impl BrickId {
    /// The brick at a place in a level's grid.
    pub fn new(level: u32, brick: UVec3) -> Self {
        Self { level, x: brick.x, y: brick.y, z: brick.z }
    }

    /// Its place in the grid.
    pub fn place(self) -> UVec3 {
        UVec3::new(self.x, self.y, self.z)
    }
}

/// The bricks of one level of a volume.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrickGrid {
    pub layout: BrickLayout,
    /// Voxels of the level.
    pub extent: UVec3,
    /// Where the level's box ends, in its voxel coordinates: at level 0 half a voxel beyond the last centre.
    pub end: Vec3,
    /// Bricks along each axis.
    pub counts: UVec3,
}

impl BrickGrid {
    /// The grid of the volume that lies turned so that its bricks' rows lie along an axis.
    pub fn along(&self, row_axis: RowAxis) -> Self {
        Self {
            layout: self.layout,
            extent: row_axis.swapped(self.extent.to_array()).into(),
            end: row_axis.swapped(self.end.to_array()).into(),
            counts: row_axis.swapped(self.counts.to_array()).into(),
        }
    }

    /// Number of bricks.
    pub fn len(&self) -> usize {
        self.counts.as_usizevec3().element_product()
    }

    /// Whether there is no brick at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The place in tables of a brick: x fastest.
    pub fn index(&self, brick: UVec3) -> usize {
        let (brick, counts) = (brick.as_usizevec3(), self.counts.as_usizevec3());
        (brick.z * counts.y + brick.y) * counts.x + brick.x
    }

    /// The brick at a place in tables.
    pub fn brick(&self, index: usize) -> UVec3 {
        let counts = self.counts.as_usizevec3();
        let (rows, x) = (index / counts.x, index % counts.x);
        UVec3::new(x as u32, (rows % counts.y) as u32, (rows / counts.y) as u32)
    }

    /// The brick at a place in tables, as a brick of the grid that [`along`](Self::along) gives.
    pub fn brick_along(&self, index: usize, row_axis: RowAxis) -> UVec3 {
        row_axis.swapped(self.brick(index).to_array()).into()
    }

    /// First voxel of a brick's core.
    pub fn core_start(&self, brick: UVec3) -> UVec3 {
        brick * self.layout.core()
    }

    /// One past the last voxel of a brick's core, within the volume.
    pub fn core_end(&self, brick: UVec3) -> UVec3 {
        ((brick + 1) * self.layout.core()).min(self.extent)
    }

    /// First voxel of a brick with its halo; it may lie before the volume.
    pub fn halo_start(&self, brick: UVec3) -> IVec3 {
        self.core_start(brick).as_ivec3() - self.layout.halo as i32
    }

    /// The half-open box [low, high) of sample positions that belong to a brick: its core's voxels with their faces.
    /// The outermost cores reach to the volume's margin. The bounds are exact in `f32`.
    pub fn owned_box(&self, brick: UVec3) -> [Vec3; 2] {
        let margin = VOLUME_MARGIN_VOXELS as f32;
        let first = brick.cmpeq(UVec3::ZERO);
        let last = (brick + 1).cmpeq(self.counts);
        let low = self.core_start(brick).as_vec3() - 0.5;
        let high = self.core_end(brick).as_vec3() - 0.5;
        [Vec3::select(first, low - margin, low), Vec3::select(last, self.end + margin, high)]
    }

    /// The one brick that a sample at this position belongs to; none outside the volume.
    pub fn owner(&self, sample_voxel: Vec3) -> Option<UVec3> {
        let margin = VOLUME_MARGIN_VOXELS as f32;
        let inside = sample_voxel.cmpge(Vec3::splat(-0.5 - margin)).all()
            && sample_voxel.cmplt(self.end + margin).all();
        let cell = (sample_voxel + 0.5).floor().as_ivec3().max(IVec3::ZERO).as_uvec3();
        inside.then(|| (cell / self.layout.core()).min(self.counts - 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_sample_is_owned_by_exactly_one_brick() {
        let grid = BrickLayout { edge: 16, halo: 2 }.grid(UVec3::new(12, 25, 1));
        assert_eq!(grid.counts, UVec3::new(1, 3, 1));
        let around = |seam: f32| [seam.next_down(), seam, seam.next_up()];
        for y in [-0.501, -0.5, 0.0, 11.5, 23.5, 24.0, 24.5].into_iter().flat_map(around) {
            let sample = Vec3::new(3.0, y, 0.25);
            let owners: Vec<UVec3> = (0..grid.len())
                .map(|index| grid.brick(index))
                .filter(|&brick| {
                    let [low, high] = grid.owned_box(brick);
                    sample.cmpge(low).all() && sample.cmplt(high).all()
                })
                .collect();
            assert_eq!(owners, grid.owner(sample).into_iter().collect::<Vec<_>>(), "y = {y}");
        }
    }

    #[test]
    fn levels_end_with_one_brick() {
        let layout = BrickLayout::default();
        assert_eq!(layout.levels(UVec3::new(60, 1, 60)), 1);
        assert_eq!(layout.levels(UVec3::new(61, 1, 1)), 2);
        assert_eq!(layout.levels(UVec3::new(512, 304, 1730)), 6);
        assert_eq!(layout.levels(UVec3::MAX), 28);
    }

    #[test]
    fn a_level_ends_where_level_0_does() {
        let grid = BrickLayout { edge: 8, halo: 2 }.level_grid(UVec3::new(9, 8, 5), 1);
        assert_eq!((grid.extent, grid.counts), (UVec3::new(5, 4, 3), UVec3::new(2, 1, 1)));
        let margin = VOLUME_MARGIN_VOXELS as f32;
        assert_eq!(grid.owned_box(UVec3::X)[1], Vec3::new(4.0, 3.5, 2.0) + margin);
        assert_eq!(grid.owner(Vec3::new(3.9, 0.0, 2.0)), Some(UVec3::X));
        assert_eq!(grid.owner(Vec3::new(3.9, 0.0, 2.1)), None);
    }

    #[test]
    fn the_index_of_a_brick_goes_there_and_back() {
        let grid = BrickLayout::default().grid(UVec3::new(512, 304, 1730));
        assert_eq!(grid.len(), 9 * 6 * 29);
        for index in [0, 8, 9, 500, grid.len() - 1] {
            assert_eq!(grid.index(grid.brick(index)), index);
        }
    }
}
