use glam::UVec3;
use glassbrick_volume::{BrickGrid, BrickRange, VolumeDesc};
use rayon::prelude::*;

use crate::FlatVoxels;
use crate::brick_cut::Slices;
use crate::decode::{Kept, Stored, with_stored};

/// What one pass over a volume finds.
pub struct RangeScan {
    /// By place in the grid.
    pub ranges: Vec<BrickRange>,
    pub not_finite: u64,
}

/// Reads every voxel once and finds the range of every brick. Layers of bricks are scanned in parallel.
pub fn scan_ranges(desc: &VolumeDesc, voxels: &FlatVoxels, grid: &BrickGrid) -> RangeScan {
    let layers: Vec<(Vec<BrickRange>, u64)> = (0..grid.counts.z)
        .into_par_iter()
        .map(|layer| with_stored!(desc.stored_type, voxels.endian, scan_layer(voxels, grid, layer)))
        .collect();
    RangeScan {
        not_finite: layers.iter().map(|(_, not_finite)| not_finite).sum(),
        ranges: layers.into_iter().flat_map(|(ranges, _)| ranges).collect(),
    }
}

/// Smallest and largest of kept voxels.
#[derive(Clone, Copy)]
struct MinMax<K>(K, K);

impl<K: Kept> MinMax<K> {
    const NOTHING: Self = Self(K::ABOVE_ALL, K::BELOW_ALL);

    #[inline(always)]
    fn of(voxels: &[K]) -> Self {
        let mut all = Self::NOTHING;
        for &voxel in voxels {
            all = Self(all.0.least(voxel), all.1.most(voxel));
        }
        all
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self(self.0.least(other.0), self.1.most(other.1))
    }

    fn to_f32(self) -> [f32; 2] {
        [self.0.to_f32(), self.1.to_f32()]
    }
}

/// The ranges of a layer of bricks, and how many of its core voxels are not finite.
fn scan_layer<S: Stored>(voxels: &FlatVoxels, grid: &BrickGrid, layer: u32) -> (Vec<BrickRange>, u64) {
    let columns = grid.counts.x as usize;
    let bricks = columns * grid.counts.y as usize;
    let mut reach = vec![MinMax::<S::Kept>::NOTHING; bricks];
    let mut core = reach.clone();
    let mut row_reach = vec![MinMax::<S::Kept>::NOTHING; columns];
    let mut row_core = row_reach.clone();
    let mut row = vec![S::Kept::default(); grid.extent.x as usize];
    let mut not_finite = 0;

    let core_z = grid.core_start(UVec3::Z * layer).z..grid.core_end(UVec3::Z * layer).z;
    for z in core_z.start.saturating_sub(1)..(core_z.end + 1).min(grid.extent.z) {
        let in_core_z = core_z.contains(&z);
        let slice = voxels.slice(z);
        if in_core_z {
            not_finite += S::count_not_finite(slice);
        }
        for (y, stored) in slice.chunks_exact(row.len() * S::BYTES).enumerate() {
            S::decode(stored, &mut row);
            scan_row(grid, &row, &mut row_reach, &mut row_core);
            let y = y as u32;
            let owner = y / grid.layout.core();
            for brick_y in owner.saturating_sub(1)..(owner + 2).min(grid.counts.y) {
                let brick = UVec3::Y * brick_y;
                if y + 1 < grid.core_start(brick).y || y > grid.core_end(brick).y {
                    continue;
                }
                let bricks = brick_y as usize * columns..(brick_y as usize + 1) * columns;
                widen(&mut reach[bricks.clone()], &row_reach);
                if brick_y == owner && in_core_z {
                    widen(&mut core[bricks], &row_core);
                }
            }
        }
    }
    let ranges = reach.iter().zip(&core);
    let ranges = ranges.map(|(reach, core)| BrickRange { reach: reach.to_f32(), core: core.to_f32() });
    (ranges.collect(), not_finite)
}

fn widen<K: Kept>(bricks: &mut [MinMax<K>], row: &[MinMax<K>]) {
    for (brick, row) in bricks.iter_mut().zip(row) {
        *brick = brick.and(*row);
    }
}

/// The range of each brick's part of a row: with one voxel around it, and its core alone.
#[inline(always)]
fn scan_row<K: Kept>(grid: &BrickGrid, row: &[K], reach: &mut [MinMax<K>], core: &mut [MinMax<K>]) {
    for (brick, voxels) in row.chunks(grid.layout.core() as usize).enumerate() {
        core[brick] = MinMax::of(voxels);
        let start = brick * grid.layout.core() as usize;
        let before = row[start.saturating_sub(1)];
        let after = row[(start + voxels.len()).min(row.len() - 1)];
        reach[brick] = core[brick].and(MinMax(before, before)).and(MinMax(after, after));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glassbrick_volume::{BrickLayout, StoredType};

    #[test]
    fn ranges_are_those_counted_by_hand() {
        let desc = VolumeDesc::new(UVec3::new(13, 9, 11), StoredType::U16);
        let at = |x: u32, y: u32, z: u32| (x * 7919 + y * 104_729 + z * 1_299_709) % 9973;
        let extent = desc.extent;
        let stored = (0..extent.z)
            .flat_map(|z| (0..extent.y).flat_map(move |y| (0..extent.x).map(move |x| at(x, y, z))))
            .flat_map(|voxel| (voxel as u16).to_ne_bytes())
            .collect();
        let voxels = FlatVoxels::array(&desc, stored).expect("right length");
        let grid = BrickLayout { edge: 8, halo: 2 }.grid(extent);
        let scan = scan_ranges(&desc, &voxels, &grid);
        for (index, range) in scan.ranges.iter().enumerate() {
            let brick = grid.brick(index);
            let by_hand = |around: u32| {
                let low = grid.core_start(brick).saturating_sub(UVec3::splat(around));
                let high = (grid.core_end(brick) + around).min(extent);
                let mut range = [f32::INFINITY, f32::NEG_INFINITY];
                for z in low.z..high.z {
                    for y in low.y..high.y {
                        for x in low.x..high.x {
                            let voxel = at(x, y, z) as f32;
                            range = [range[0].min(voxel), range[1].max(voxel)];
                        }
                    }
                }
                range
            };
            assert_eq!(range.core, by_hand(0), "core of {brick}");
            assert_eq!(range.reach, by_hand(1), "reach of {brick}");
        }
    }
}
