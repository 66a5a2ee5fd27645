use glam::UVec3;
use glassbrick_volume::{Bins, BrickGrid, BrickRange, VCT_BINS, VolumeDesc, VoxelCountTable};
use rayon::prelude::*;

use crate::FlatVoxels;
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
    let [min, max] = range.core.map(f64::from);
    let bins = Bins { min, max, whole_numbers: S::WHOLE_NUMBERS };
    let mut counts = [0u32; VCT_BINS];
    if S::Kept::IS_INTEGER && max - min < LONGEST_LOOK_UP {
        let look_up: Vec<u8> =
            (0..=(max - min) as usize).map(|above| bins.bin(min + above as f64) as u8).collect();
        for_core_voxels::<S>(voxels, grid, brick, |voxel| {
            counts[usize::from(look_up[(f64::from(voxel.to_f32()) - min) as usize])] += 1;
        });
    } else {
        for_core_voxels::<S>(voxels, grid, brick, |voxel| {
            counts[bins.bin(f64::from(voxel.to_f32()))] += 1;
        });
    }
    VoxelCountTable::from_counts(counts, bins)
}

fn for_core_voxels<S: Stored>(
    voxels: &FlatVoxels,
    grid: &BrickGrid,
    brick: UVec3,
    mut visit: impl FnMut(S::Kept),
) {
    let (start, end) = (grid.core_start(brick), grid.core_end(brick));
    let mut row = vec![S::Kept::default(); (end.x - start.x) as usize];
    for z in start.z..end.z {
        let slice = voxels.slice(z);
        for y in start.y..end.y {
            let first = (y as usize * grid.extent.x as usize + start.x as usize) * S::BYTES;
            S::decode(&slice[first..first + row.len() * S::BYTES], &mut row);
            row.iter().for_each(|&voxel| visit(voxel));
        }
    }
}
