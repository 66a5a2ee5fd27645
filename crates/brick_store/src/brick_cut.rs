use glam::UVec3;
use glassbrick_volume::{Brick, BrickGrid, VolumeDesc};

use crate::FlatVoxels;
use crate::decode::{Kept, Stored, with_stored};

/// Slices of stored voxels, x fastest.
pub trait Slices {
    /// The stored bytes of a slice.
    fn slice(&self, z: u32) -> &[u8];
}

/// Cuts a brick with its halo out of flat voxels; voxels beyond the volume repeat its edge.
pub fn cut_brick(desc: &VolumeDesc, voxels: &FlatVoxels, grid: &BrickGrid, brick: UVec3) -> Brick {
    with_stored!(desc.stored_type, voxels.endian, cut_kept(voxels, grid, brick))
}

fn cut_kept<S: Stored>(voxels: &FlatVoxels, grid: &BrickGrid, brick: UVec3) -> Brick {
    let mut kept = vec![S::Kept::default(); grid.layout.voxels() + Brick::PADDING];
    cut(voxels, grid, brick, S::BYTES, &mut kept[..grid.layout.voxels()], S::decode);
    Brick::new(grid.layout.edge, S::Kept::into_voxels(kept))
}

/// Cuts a brick of voxels of `N` bytes, as they are stored in slices of this machine's byte order, into little-endian
/// ones.
pub fn cut_stored<const N: usize>(slices: &impl Slices, grid: &BrickGrid, brick: UVec3, out: &mut [u8]) {
    let (out, _) = out.as_chunks_mut::<N>();
    cut(slices, grid, brick, N, out, |stored, row| {
        let (voxels, _) = stored.as_chunks::<N>();
        row.copy_from_slice(voxels);
        if cfg!(target_endian = "big") {
            row.iter_mut().for_each(|voxel| voxel.reverse());
        }
    });
}

/// Fills `out`, edge³ voxels, row by row; `decode` makes a part of a row of stored bytes.
#[inline(always)]
fn cut<V: Copy>(
    slices: &impl Slices,
    grid: &BrickGrid,
    brick: UVec3,
    voxel_bytes: usize,
    out: &mut [V],
    decode: impl Fn(&[u8], &mut [V]),
) {
    let edge = grid.layout.edge as usize;
    let start = grid.halo_start(brick);
    let clamped = |position: i32, extent: u32| position.clamp(0, extent as i32 - 1) as usize;
    let row_bytes = grid.extent.x as usize * voxel_bytes;
    let first = start.x.max(0) as usize;
    let end = (start.x + edge as i32).min(grid.extent.x as i32) as usize;
    let before = (first as i32 - start.x) as usize;
    let inside = end - first;

    let mut rows = out.chunks_exact_mut(edge);
    for z in 0..edge as i32 {
        let slice = slices.slice(clamped(start.z + z, grid.extent.z) as u32);
        for y in 0..edge as i32 {
            let row = rows.next().expect("a brick has edge² rows");
            let row_start = clamped(start.y + y, grid.extent.y) * row_bytes;
            let stored = &slice[row_start + first * voxel_bytes..row_start + end * voxel_bytes];
            decode(stored, &mut row[before..before + inside]);
            let (left, right) = (row[before], row[before + inside - 1]);
            row[..before].fill(left);
            row[before + inside..].fill(right);
        }
    }
}
