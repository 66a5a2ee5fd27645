//! JPEG 2000 frames, lossless and lossy.

use jpeg2k::{DecodeParameters, Image};

use super::byte_stream::Parsed;

/// The marks with which a codestream begins: start of codestream, image and tile size.
const START: [u8; 4] = [0xFF, 0x4F, 0xFF, 0x51];
/// How far into a file format's boxes the codestream is looked for.
const MAX_BOXES_BYTES: usize = 4096;

/// Checks that a frame has one component of this size before it is decoded; gives its bits.
pub(super) fn check(encoded: &[u8], columns: u32, rows: u32) -> Parsed<u32> {
    let searched = &encoded[..encoded.len().min(MAX_BOXES_BYTES)];
    let start = searched.windows(START.len()).position(|window| window == START);
    let damaged = "has a JPEG 2000 frame without a header; the file is damaged";
    let sizes: &[u8; 41] =
        encoded.get(start.ok_or(damaged)? + 4..).and_then(<[u8]>::first_chunk).ok_or(damaged)?;
    let word = |at: usize| u32::from_be_bytes([sizes[at], sizes[at + 1], sizes[at + 2], sizes[at + 3]]);
    let (width, height) = (word(4).wrapping_sub(word(12)), word(8).wrapping_sub(word(16)));
    let components = u16::from_be_bytes([sizes[36], sizes[37]]);
    let steps = (sizes[39], sizes[40]);
    if (width, height, components, steps) != (columns, rows, 1, (1, 1)) {
        return Err(format!(
            "has a JPEG 2000 frame of {width}×{height} with {components} components where {columns}×{rows} \
             with 1 is said"
        ));
    }
    Ok(u32::from(sizes[38] & 0x7F) + 1)
}

/// Decodes a frame that was checked.
pub(super) fn decode(encoded: &[u8], columns: u32, rows: u32) -> Parsed<Vec<i32>> {
    let image = Image::from_bytes_with(encoded, DecodeParameters::new().strict(true))
        .map_err(|error| format!("has a JPEG 2000 frame that is damaged: {error}"))?;
    match image.components() {
        [component] if (component.width(), component.height()) == (columns, rows) => {
            Ok(component.data().to_vec())
        }
        _ => Err("has a JPEG 2000 frame that decodes to another size than it says".to_owned()),
    }
}
