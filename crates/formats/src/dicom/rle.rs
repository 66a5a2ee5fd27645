//! RLE Lossless (PS3.5 annex G): a frame as byte planes, the most significant first, each packed in runs.

use super::byte_stream::Parsed;

const HEADER_BYTES: usize = 64;

/// Decodes a frame of voxels of `voxel_bytes` bytes into this machine's byte order.
pub(super) fn decode(encoded: &[u8], voxel_bytes: usize, out: &mut [u8]) -> Parsed<()> {
    let cut_off = || "has an RLE frame that is cut off".to_owned();
    let header = encoded.get(..HEADER_BYTES).ok_or_else(cut_off)?;
    let mut words = header.as_chunks().0.iter().map(|&word| u32::from_le_bytes(word) as usize);
    let planes = words.next().unwrap_or(0);
    if planes != voxel_bytes {
        return Err(format!("has {planes} RLE planes where a voxel has {voxel_bytes} bytes"));
    }
    for (plane, start) in words.take(planes).enumerate() {
        let packed = encoded.get(start..).ok_or_else(cut_off)?;
        let byte = if cfg!(target_endian = "big") { plane } else { voxel_bytes - 1 - plane };
        unpack(packed, out.iter_mut().skip(byte).step_by(voxel_bytes)).ok_or_else(cut_off)?;
    }
    Ok(())
}

/// Unpacks runs until `out` is full; nothing where they end before.
fn unpack<'a>(mut packed: &[u8], mut out: impl ExactSizeIterator<Item = &'a mut u8>) -> Option<()> {
    while out.len() > 0 {
        let (&control, rest) = packed.split_first()?;
        match control as i8 {
            literal @ 0.. => {
                let (bytes, rest) = rest.split_at_checked(literal as usize + 1)?;
                bytes.iter().zip(out.by_ref().take(bytes.len())).for_each(|(byte, voxel)| *voxel = *byte);
                packed = rest;
            }
            i8::MIN => packed = rest,
            repeat => {
                let (&byte, rest) = rest.split_first()?;
                let count = 1 - isize::from(repeat);
                out.by_ref().take(count as usize).for_each(|voxel| *voxel = byte);
                packed = rest;
            }
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(planes: &[&[u8]]) -> Vec<u8> {
        let mut encoded = vec![0; HEADER_BYTES];
        encoded[0] = planes.len() as u8;
        for (index, plane) in planes.iter().enumerate() {
            let start = encoded.len() as u32;
            encoded[4 + 4 * index..8 + 4 * index].copy_from_slice(&start.to_le_bytes());
            encoded.extend_from_slice(plane);
        }
        encoded
    }

    #[test]
    fn runs_and_literals_of_two_planes_make_sixteen_bit_voxels() {
        let mut out = [0; 8];
        decode(&frame(&[&[0xFD, 0x12], &[3, 1, 2, 3, 4]]), 2, &mut out).expect("a sound frame");
        let voxels: Vec<u16> = out.as_chunks().0.iter().map(|&voxel| u16::from_ne_bytes(voxel)).collect();
        assert_eq!(voxels, [0x1201, 0x1202, 0x1203, 0x1204]);
    }

    #[test]
    fn damaged_frames_are_refused() {
        let mut out = [0; 8];
        assert!(decode(&[], 2, &mut out).is_err());
        assert!(decode(&frame(&[&[0xFD, 0x12]]), 2, &mut out).is_err());
        assert!(decode(&frame(&[&[0xFD, 0x12], &[3, 1, 2]]), 2, &mut out).is_err());
        let mut far = frame(&[&[0xFD, 0x12], &[0xFD, 0x12]]);
        far[8..12].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(decode(&far, 2, &mut out).is_err());
    }
}
