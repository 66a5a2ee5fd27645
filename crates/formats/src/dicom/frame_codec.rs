//! Frames as they are stored, from whatever encodes them.

use std::panic::{AssertUnwindSafe, catch_unwind};

use super::byte_stream::Parsed;
use super::frame_source::{Fragments, read_fragments, read_native};
use super::image::Image;
use super::pixel_format::BitField;
use super::transfer_syntax::FrameCoding;
use super::{jpeg, jpeg2000, rle};

/// Decodes a frame into stored values in this machine's byte order; `out` has the size of one frame. No
/// rescaling and no windowing. Says how many bytes of the file it took.
pub(super) fn decode_frame(
    image: &Image,
    frame: usize,
    fragments: &Fragments,
    out: &mut [u8],
) -> Parsed<u64> {
    let mut bytes_read = fragments.iter().map(|&(_, bytes)| u64::from(bytes)).sum();
    let voxel_bytes = image.format.stored_type.bytes();
    let mut bits = image.format.bits;
    match image.transfer_syntax.coding {
        FrameCoding::Native => bytes_read = read_voxels(image, frame, out)?,
        FrameCoding::Rle => rle::decode(&read_fragments(image, fragments)?, voxel_bytes, out)?,
        FrameCoding::Jpeg => {
            let encoded = read_fragments(image, fragments)?;
            let samples = guarded(|| jpeg::decode(&encoded, image.columns, image.rows))?;
            place(samples.into_iter().map(u32::from), voxel_bytes, out);
        }
        FrameCoding::Jpeg2000 => {
            let encoded = read_fragments(image, fragments)?;
            let precision = jpeg2000::check(&encoded, image.columns, image.rows)?;
            if precision as usize > 8 * voxel_bytes {
                return Err(format!(
                    "has JPEG 2000 frames of {precision} bits in {} allocated",
                    8 * voxel_bytes
                ));
            }
            bits = BitField::low(precision);
            let samples = guarded(|| jpeg2000::decode(&encoded, image.columns, image.rows))?;
            place(samples.into_iter().map(|sample| sample as u32), voxel_bytes, out);
        }
        FrameCoding::Unknown(name) => return Err(format!("is compressed with {name}")),
    }
    image.format.extract(bits, out);
    Ok(bytes_read)
}

/// Checks the header of an encoded frame, so that one that cannot be decoded is refused before any is.
pub(super) fn check_frame(image: &Image, fragments: &Fragments) -> Parsed<()> {
    let (columns, rows) = (image.columns, image.rows);
    match image.transfer_syntax.coding {
        FrameCoding::Jpeg => {
            let encoded = read_fragments(image, fragments)?;
            guarded(|| jpeg::check(&encoded, columns, rows))
        }
        FrameCoding::Jpeg2000 => jpeg2000::check(&read_fragments(image, fragments)?, columns, rows).map(drop),
        FrameCoding::Native | FrameCoding::Rle | FrameCoding::Unknown(_) => Ok(()),
    }
}

/// Reads an uncompressed frame into this machine's byte order, its bits as they are. Says how many bytes of the
/// file it took.
pub(super) fn read_voxels(image: &Image, frame: usize, out: &mut [u8]) -> Parsed<u64> {
    let offset = image.frame_bytes() * frame as u64;
    let big_endian = image.transfer_syntax.encoding.big_endian;
    if big_endian && image.format.stored_type.bytes() == 1 && image.pixels.words {
        return read_swapped_bytes(image, offset, out);
    }
    let bytes_read = read_native(image, offset, out)?;
    if big_endian != cfg!(target_endian = "big") {
        swap(image.format.stored_type.bytes(), out);
    }
    Ok(bytes_read)
}

/// Reads bytes that were written as big-endian words of two.
fn read_swapped_bytes(image: &Image, offset: u64, out: &mut [u8]) -> Parsed<u64> {
    let skipped = (offset % 2) as usize;
    let there = u64::from(image.pixels.bytes.unwrap_or(0)) - (offset - skipped as u64);
    let wanted = (skipped + out.len()).next_multiple_of(2);
    if there < wanted as u64 {
        return Err("has voxels in words of two bytes, and ends within one".to_owned());
    }
    let mut words = vec![0; wanted];
    let bytes_read = read_native(image, offset - skipped as u64, &mut words)?;
    swap(2, &mut words);
    out.copy_from_slice(&words[skipped..skipped + out.len()]);
    Ok(bytes_read)
}

fn swap(voxel_bytes: usize, voxels: &mut [u8]) {
    match voxel_bytes {
        2 => voxels.as_chunks_mut::<2>().0.iter_mut().for_each(|voxel| voxel.reverse()),
        4 => voxels.as_chunks_mut::<4>().0.iter_mut().for_each(|voxel| voxel.reverse()),
        8 => voxels.as_chunks_mut::<8>().0.iter_mut().for_each(|voxel| voxel.reverse()),
        _ => {}
    }
}

/// Writes the low bytes of each sample. There are as many samples as `out` has voxels: the decoders see to
/// that.
fn place(samples: impl Iterator<Item = u32>, voxel_bytes: usize, out: &mut [u8]) {
    match voxel_bytes {
        1 => out.iter_mut().zip(samples).for_each(|(voxel, sample)| *voxel = sample as u8),
        2 => {
            let voxels = out.as_chunks_mut().0.iter_mut();
            voxels.zip(samples).for_each(|(voxel, sample)| *voxel = (sample as u16).to_ne_bytes());
        }
        _ => {
            let voxels = out.as_chunks_mut().0.iter_mut();
            voxels.zip(samples).for_each(|(voxel, sample)| *voxel = sample.to_ne_bytes());
        }
    }
}

/// Runs a decoder from outside, which may panic on damaged frames.
fn guarded<T>(decode: impl FnOnce() -> Parsed<T>) -> Parsed<T> {
    catch_unwind(AssertUnwindSafe(decode)).unwrap_or_else(|_| Err("has a frame that is damaged".to_owned()))
}
