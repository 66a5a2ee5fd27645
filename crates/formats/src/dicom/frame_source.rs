//! Where in its file each frame lies.

use std::collections::HashSet;
use std::fs::File;
use std::io::{Read, Seek, SeekFrom};

use super::byte_stream::Parsed;
use super::element::{Encoding, read_header};
use super::image::Image;
use super::probe::open_data_set;
use super::tag::Tag;
use super::transfer_syntax::FrameCoding;

/// Where an encoded frame's bytes lie: offset and size of each fragment.
pub(super) type Fragments = Vec<(u64, u32)>;

/// More fragments than any real file has.
const MAX_FRAGMENTS: usize = 1 << 20;

/// Finds the fragments of each of an image's frames.
pub(super) fn find_fragments(image: &Image) -> Parsed<Vec<Fragments>> {
    let mut stream = open_data_set(&image.path)?;
    stream.skip(image.pixels.offset.saturating_sub(stream.position()))?;
    let table = read_header(&mut stream, Encoding::EXPLICIT)?;
    let (Tag::ITEM, Some(table_bytes)) = (table.tag, table.length) else {
        return Err("has no offset table before its fragments; the file is damaged".to_owned());
    };
    let frames = image.frames.len();
    let table = if u64::from(table_bytes) == 4 * frames as u64 {
        let bytes = stream.take(table_bytes.into())?;
        bytes.as_chunks().0.iter().map(|&offset| u64::from(u32::from_le_bytes(offset))).collect()
    } else {
        stream.skip(table_bytes.into())?;
        Vec::new()
    };
    let first_item = stream.position();
    let mut fragments = Fragments::new();
    while !stream.at_end()? {
        let header = read_header(&mut stream, Encoding::EXPLICIT)?;
        let (Tag::ITEM, Some(bytes)) = (header.tag, header.length) else { break };
        if fragments.len() == MAX_FRAGMENTS {
            return Err(format!("has more than {MAX_FRAGMENTS} fragments"));
        }
        fragments.push((stream.position(), bytes));
        stream.skip(bytes.into())?;
    }
    let table = if image.extended_offsets.len() == frames { image.extended_offsets.clone() } else { table };
    group_by_frame(image, fragments, &table, first_item)
}

/// Shares the fragments among the frames: one each, or by the offset table, or by the marks at which images
/// start.
fn group_by_frame(
    image: &Image,
    fragments: Fragments,
    table: &[u64],
    first_item: u64,
) -> Parsed<Vec<Fragments>> {
    let frames = image.frames.len();
    if frames == 1 && !fragments.is_empty() {
        return Ok(vec![fragments]);
    }
    if fragments.len() == frames {
        return Ok(fragments.into_iter().map(|fragment| vec![fragment]).collect());
    }
    let starts: Vec<bool> = if table.len() == frames {
        // An offset leads to the fragment's item, eight bytes before its value.
        let table: HashSet<u64> = table.iter().copied().collect();
        fragments.iter().map(|(offset, _)| table.contains(&(offset - 8 - first_item))).collect()
    } else {
        let file = File::open(&image.path).map_err(|error| error.to_string())?;
        fragments.iter().map(|&(offset, _)| starts_image(&file, offset, image)).collect()
    };
    let mut grouped: Vec<Fragments> = Vec::new();
    for (fragment, starts) in fragments.into_iter().zip(starts) {
        match grouped.last_mut() {
            Some(frame) if !starts => frame.push(fragment),
            _ => grouped.push(vec![fragment]),
        }
    }
    if grouped.len() != frames {
        return Err(format!("claims {frames} frames, but its fragments make {}", grouped.len()));
    }
    Ok(grouped)
}

fn starts_image(file: &File, offset: u64, image: &Image) -> bool {
    let mark: &[u8] = match image.transfer_syntax.coding {
        FrameCoding::Jpeg => &[0xFF, 0xD8],
        FrameCoding::Jpeg2000 => &[0xFF, 0x4F],
        _ => return true,
    };
    let mut bytes = [0; 2];
    read_at(file, offset, &mut bytes).is_ok() && bytes == mark
}

/// Reads a frame's fragments one after the other.
pub(super) fn read_fragments(image: &Image, fragments: &Fragments) -> Parsed<Vec<u8>> {
    let file = File::open(&image.path).map_err(|error| error.to_string())?;
    let mut encoded = Vec::new();
    for &(offset, bytes) in fragments {
        // The length was held against the file's when it was opened.
        let start = encoded.len();
        encoded.resize(start + bytes as usize, 0);
        read_at(&file, offset, &mut encoded[start..])?;
    }
    Ok(encoded)
}

/// Reads the bytes of an uncompressed frame that start `offset` bytes into the voxels, and says how many bytes of
/// the file that took.
pub(super) fn read_native(image: &Image, offset: u64, out: &mut [u8]) -> Parsed<u64> {
    if image.transfer_syntax.deflated {
        let mut stream = open_data_set(&image.path)?;
        stream.skip(image.pixels.offset + offset)?;
        stream.read(out)?;
        return Ok(stream.encoded_position());
    }
    let file = File::open(&image.path).map_err(|error| error.to_string())?;
    read_at(&file, image.pixels.offset + offset, out)?;
    Ok(out.len() as u64)
}

fn read_at(mut file: &File, offset: u64, out: &mut [u8]) -> Parsed<()> {
    let read = file.seek(SeekFrom::Start(offset)).and_then(|_| file.read_exact(out));
    read.map_err(|error| format!("cannot be read at byte {offset}: {error}"))
}
