//! JPEG frames: baseline and progressive of 8 bits, lossless of up to 16.

use jpeg_decoder::{Decoder, PixelFormat};

use super::byte_stream::Parsed;

/// Checks that a frame has one component of this size, and is of a kind that is decoded.
pub(super) fn check(encoded: &[u8], columns: u32, rows: u32) -> Parsed<()> {
    start(encoded, columns, rows).map(drop)
}

/// Decodes a frame of one component of this size.
pub(super) fn decode(encoded: &[u8], columns: u32, rows: u32) -> Parsed<Vec<u16>> {
    let voxels = columns as usize * rows as usize;
    let decoded = start(encoded, columns, rows)?.decode().map_err(|error| refusal(&error))?;
    // Whether a voxel takes one byte or two is seen by the size: it does not follow from the pixel format
    // alone.
    if decoded.len() == voxels {
        Ok(decoded.into_iter().map(u16::from).collect())
    } else if decoded.len() == 2 * voxels {
        Ok(decoded.as_chunks().0.iter().map(|&voxel| u16::from_ne_bytes(voxel)).collect())
    } else {
        Err(format!("has a JPEG frame of {} bytes for {voxels} voxels", decoded.len()))
    }
}

fn start(encoded: &[u8], columns: u32, rows: u32) -> Parsed<Decoder<&[u8]>> {
    let mut decoder = Decoder::new(encoded);
    decoder.set_max_decoding_buffer_size(2 * columns as usize * rows as usize);
    decoder.read_info().map_err(|error| refusal(&error))?;
    let info = decoder.info().ok_or("has a JPEG frame without a header")?;
    if (u32::from(info.width), u32::from(info.height)) != (columns, rows) {
        return Err(format!(
            "has a JPEG frame of {}×{} where {columns}×{rows} is said",
            info.width, info.height
        ));
    }
    if !matches!(info.pixel_format, PixelFormat::L8 | PixelFormat::L16) {
        return Err("has a JPEG frame with colours".to_owned());
    }
    Ok(decoder)
}

fn refusal(error: &jpeg_decoder::Error) -> String {
    match error {
        jpeg_decoder::Error::Unsupported(_) => {
            format!(
                "has JPEG frames that are not decoded here ({error}); decompress it first, with gdcmconv say"
            )
        }
        _ => format!("has a JPEG frame that is damaged: {error}"),
    }
}
