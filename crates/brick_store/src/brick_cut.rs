use glam::UVec3;
use glassbrick_volume::{Brick, BrickGrid, VolumeDesc};

use crate::FlatVoxels;
use crate::decode::{Kept, Stored, with_stored};

/// Cuts a brick with its halo out of flat voxels; voxels beyond the volume repeat its edge.
pub fn cut_brick(desc: &VolumeDesc, voxels: &FlatVoxels, grid: &BrickGrid, brick: UVec3) -> Brick {
    with_stored!(desc.stored_type, voxels.endian, cut(voxels, grid, brick))
}

fn cut<S: Stored>(voxels: &FlatVoxels, grid: &BrickGrid, brick: UVec3) -> Brick {
    let edge = grid.layout.edge as usize;
    let start = grid.halo_start(brick);
    let clamped = |position: i32, extent: u32| position.clamp(0, extent as i32 - 1) as usize;
    let row_bytes = grid.extent.x as usize * S::BYTES;
    let first = start.x.max(0) as usize;
    let end = (start.x + edge as i32).min(grid.extent.x as i32) as usize;
    let before = (first as i32 - start.x) as usize;
    let inside = end - first;

    let mut kept = vec![S::Kept::default(); grid.layout.voxels() + Brick::PADDING];
    let mut rows = kept.chunks_exact_mut(edge);
    for z in 0..edge as i32 {
        let slice = voxels.slice(clamped(start.z + z, grid.extent.z) as u32);
        for y in 0..edge as i32 {
            let row = rows.next().expect("a brick has edge² rows");
            let row_start = clamped(start.y + y, grid.extent.y) * row_bytes;
            let stored = &slice[row_start + first * S::BYTES..row_start + end * S::BYTES];
            S::decode(stored, &mut row[before..before + inside]);
            let (left, right) = (row[before], row[before + inside - 1]);
            row[..before].fill(left);
            row[before + inside..].fill(right);
        }
    }
    Brick::new(grid.layout.edge, S::Kept::into_voxels(kept))
}
