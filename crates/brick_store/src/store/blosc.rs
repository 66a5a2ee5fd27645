//! The blosc container by the C library: voxels' bytes are shuffled by significance, then compressed.

use std::ffi::{CStr, c_void};

/// Bytes are grouped by their place in an element.
const BYTE_SHUFFLE: i32 = 1;

/// Bytes that the container takes besides the data, at most.
pub const OVERHEAD: usize = blosc_src::BLOSC_MAX_OVERHEAD as usize;

/// How bytes are compressed.
#[derive(Clone, Copy)]
pub struct Compressor {
    pub name: &'static CStr,
    pub level: i32,
    /// Bytes that are compressed as one.
    pub block_bytes: usize,
}

/// Appends the container of `bytes`, which hold elements of `element_bytes`.
pub fn compress(compressor: &Compressor, element_bytes: usize, bytes: &[u8], out: &mut Vec<u8>) {
    let start = out.len();
    out.resize(start + bytes.len() + OVERHEAD, 0);
    let room = &mut out[start..];
    // SAFETY: both pointers are to slices of the lengths given with them, and the name ends with a zero.
    let written = unsafe {
        blosc_src::blosc_compress_ctx(
            compressor.level,
            BYTE_SHUFFLE,
            element_bytes,
            bytes.len(),
            bytes.as_ptr().cast::<c_void>(),
            room.as_mut_ptr().cast::<c_void>(),
            room.len(),
            compressor.name.as_ptr(),
            compressor.block_bytes,
            1,
        )
    };
    let written = usize::try_from(written).ok().filter(|&written| written > 0);
    out.truncate(start + written.expect("blosc stores what it cannot compress, and there is room for that"));
}

/// Fills `out` from a container; false where it is damaged or holds another number of bytes.
pub fn decompress(container: &[u8], out: &mut [u8]) -> bool {
    let mut held_bytes = 0;
    // SAFETY: the pointers are to a slice of the length given and to a number.
    let is_sound = unsafe {
        blosc_src::blosc_cbuffer_validate(
            container.as_ptr().cast::<c_void>(),
            container.len(),
            &raw mut held_bytes,
        )
    } == 0;
    if !is_sound || held_bytes != out.len() {
        return false;
    }
    // SAFETY: the container's header fits its length, and blosc writes no more than the length of `out`.
    let written = unsafe {
        blosc_src::blosc_decompress_ctx(
            container.as_ptr().cast::<c_void>(),
            out.as_mut_ptr().cast::<c_void>(),
            out.len(),
            1,
        )
    };
    usize::try_from(written) == Ok(out.len())
}
