/// Turns voxels of `voxel_bytes` each into the other byte order, in place.
pub(crate) fn swap_bytes(voxels: &mut [u8], voxel_bytes: usize) {
    match voxel_bytes {
        2 => swap_each::<2>(voxels),
        4 => swap_each::<4>(voxels),
        8 => swap_each::<8>(voxels),
        _ => {}
    }
}

/// The size is a constant so that the compiler makes vector shuffles of this.
fn swap_each<const BYTES: usize>(voxels: &mut [u8]) {
    for voxel in voxels.as_chunks_mut::<BYTES>().0 {
        voxel.reverse();
    }
}
