use super::lanes::Lanes;

/// A voxel as vectors of rays read it.
pub trait LaneVoxel: Copy + Send + Sync {
    /// Reads the voxels at each index and right behind it.
    ///
    /// # Safety
    /// Each index and the next must lie in the array, and four bytes behind the start of each.
    unsafe fn pair<L: Lanes>(voxels: *const Self, indices: L::I) -> (L::F, L::F);
}

impl LaneVoxel for u8 {
    #[inline(always)]
    unsafe fn pair<L: Lanes>(voxels: *const Self, indices: L::I) -> (L::F, L::F) {
        // SAFETY: the caller's promise.
        let four = unsafe { L::gather_bytes(voxels, indices) };
        let byte = L::splat_i(0xFF);
        (L::to_f(L::and_i(four, byte)), L::to_f(L::and_i(L::shift_right::<8>(four), byte)))
    }
}

impl LaneVoxel for i8 {
    #[inline(always)]
    unsafe fn pair<L: Lanes>(voxels: *const Self, indices: L::I) -> (L::F, L::F) {
        // SAFETY: the caller's promise.
        let four = unsafe { L::gather_bytes(voxels.cast(), indices) };
        (
            L::to_f(L::shift_right::<24>(L::shift_left::<24>(four))),
            L::to_f(L::shift_right::<24>(L::shift_left::<16>(four))),
        )
    }
}

impl LaneVoxel for u16 {
    #[inline(always)]
    unsafe fn pair<L: Lanes>(voxels: *const Self, indices: L::I) -> (L::F, L::F) {
        // SAFETY: the caller's promise.
        let both = unsafe { L::gather_bytes(voxels.cast(), L::shift_left::<1>(indices)) };
        let low = L::splat_i(0xFFFF);
        (L::to_f(L::and_i(both, low)), L::to_f(L::and_i(L::shift_right::<16>(both), low)))
    }
}

impl LaneVoxel for i16 {
    #[inline(always)]
    unsafe fn pair<L: Lanes>(voxels: *const Self, indices: L::I) -> (L::F, L::F) {
        // SAFETY: the caller's promise.
        let both = unsafe { L::gather_bytes(voxels.cast(), L::shift_left::<1>(indices)) };
        (L::to_f(L::shift_right::<16>(L::shift_left::<16>(both))), L::to_f(L::shift_right::<16>(both)))
    }
}

impl LaneVoxel for f32 {
    #[inline(always)]
    unsafe fn pair<L: Lanes>(voxels: *const Self, indices: L::I) -> (L::F, L::F) {
        // SAFETY: the caller's promise.
        unsafe { (L::gather(voxels, indices), L::gather(voxels, L::add_i(indices, L::splat_i(1)))) }
    }
}
