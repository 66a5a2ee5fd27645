use glam::UVec3;
use glassbrick_volume::{Bins, BrickGrid, BrickRange, VCT_BINS, VolumeDesc, VoxelCountTable};
use rayon::prelude::*;

use crate::FlatVoxels;
use crate::brick_cut::Slices;
use crate::decode::{Kept, Stored, with_stored};

/// Ranges of whole numbers up to this get their bins from a look-up.
const LONGEST_LOOK_UP: f64 = 65_536.0;

/// Counts the core voxels of every brick, in parallel over the bricks.
pub fn scan_tables(
    desc: &VolumeDesc,
    voxels: &FlatVoxels,
    grid: &BrickGrid,
    ranges: &[BrickRange],
) -> Vec<VoxelCountTable> {
    ranges
        .par_iter()
        .enumerate()
        .map(|(index, range)| {
            let brick = grid.brick(index);
            with_stored!(desc.stored_type, voxels.endian, count_brick(voxels, grid, brick, range))
        })
        .collect()
}

fn count_brick<S: Stored>(
    voxels: &FlatVoxels,
    grid: &BrickGrid,
    brick: UVec3,
    range: &BrickRange,
) -> VoxelCountTable {
    let (start, end) = (grid.core_start(brick), grid.core_end(brick));
    let row_voxels = (end.x - start.x) as usize;
    let rows = (start.z..end.z).flat_map(|z| {
        (start.y..end.y).map(move |y| {
            let first = (y as usize * grid.extent.x as usize + start.x as usize) * S::BYTES;
            &voxels.slice(z)[first..first + row_voxels * S::BYTES]
        })
    });
    count_core::<S>(rows, row_voxels, range)
}

/// Counts a core's voxels, given as rows of stored bytes.
pub fn count_core<'a, S: Stored>(
    rows: impl Iterator<Item = &'a [u8]>,
    row_voxels: usize,
    range: &BrickRange,
) -> VoxelCountTable {
    let [min, max] = range.core.map(f64::from);
    let bins = Bins { min, max, whole_numbers: S::WHOLE_NUMBERS };
    // Neighbours are alike: counted apart, they do not wait for each other's count.
    let mut counts = [[0u32; VCT_BINS]; 4];
    let mut row = vec![S::Kept::default(); row_voxels];
    if S::Kept::IS_INTEGER && max - min < LONGEST_LOOK_UP {
        let look_up: Vec<u8> =
            (0..=(max - min) as usize).map(|above| bins.bin(min + above as f64) as u8).collect();
        let least = min as i32;
        for stored in rows {
            S::decode(stored, &mut row);
            count_row(&row, &mut counts, |voxel| usize::from(look_up[(voxel.to_i32() - least) as usize]));
        }
    } else {
        for stored in rows {
            S::decode(stored, &mut row);
            count_row(&row, &mut counts, |voxel| bins.bin(f64::from(voxel.to_f32())));
        }
    }
    let sum = std::array::from_fn(|bin| counts.iter().map(|counts| counts[bin]).sum());
    VoxelCountTable::from_counts(sum, bins)
}

#[inline(always)]
fn count_row<K: Kept>(row: &[K], counts: &mut [[u32; VCT_BINS]; 4], bin: impl Fn(K) -> usize) {
    let (fours, rest) = row.as_chunks::<4>();
    for four in fours {
        for (counts, &voxel) in counts.iter_mut().zip(four) {
            counts[bin(voxel)] += 1;
        }
    }
    for &voxel in rest {
        counts[0][bin(voxel)] += 1;
    }
}
