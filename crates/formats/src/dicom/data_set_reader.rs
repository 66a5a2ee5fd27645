//! Reads data sets: the elements that are kept, up to the voxels.

use super::byte_stream::{ByteStream, Parsed};
use super::data_set::{DataSet, Value};
use super::element::{ElementHeader, Encoding, read_header};
use super::tag::{self, Tag};

/// Deeper nesting than any real file has.
const MAX_DEPTH: usize = 32;
/// A longer value of an element that is kept is damaged, and skipped.
const MAX_VALUE_BYTES: u32 = 4096;
/// The same for an element with a number for each frame.
const MAX_VECTOR_BYTES: u32 = 4 << 20;

/// Where the voxels lie in the file, deflated files in the inflated data set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PixelElement {
    pub tag: Tag,
    pub offset: u64,
    /// Nothing where the frames are encapsulated, each in fragments of its own.
    pub bytes: Option<u32>,
    /// Whether the values are written as 16-bit words even where a voxel is one byte.
    pub words: bool,
}

/// Reads a data set up to its voxels, or to the end where it has none.
pub(super) fn read_data_set(
    stream: &mut ByteStream,
    encoding: Encoding,
) -> Parsed<(DataSet, Option<PixelElement>)> {
    let mut data_set = DataSet::default();
    while !stream.at_end()? {
        let header = read_header(stream, encoding)?;
        if tag::is_pixel_data(header.tag) {
            let pixels = PixelElement {
                tag: header.tag,
                offset: stream.position(),
                bytes: header.length,
                words: header.vr.is_none_or(|vr| vr == *b"OW"),
            };
            return Ok((data_set, Some(pixels)));
        }
        read_element(stream, encoding, header, &mut data_set, 0)?;
    }
    Ok((data_set, None))
}

/// Reads the file meta information: explicit VR, little endian, group 0002.
pub(super) fn read_meta(stream: &mut ByteStream) -> Parsed<DataSet> {
    let mut meta = DataSet::default();
    while !stream.at_end()? {
        let start = stream.position();
        let header = read_header(stream, Encoding::EXPLICIT)?;
        if header.tag.0 != 0x0002 {
            stream.rewind(start)?;
            break;
        }
        read_element(stream, Encoding::EXPLICIT, header, &mut meta, 0)?;
    }
    Ok(meta)
}

fn read_element(
    stream: &mut ByteStream,
    encoding: Encoding,
    header: ElementHeader,
    out: &mut DataSet,
    depth: usize,
) -> Parsed<()> {
    let written = header.vr.filter(|vr| vr != b"UN");
    let kept = tag::kept_vr(header.tag).map(|standard| written.unwrap_or(standard));
    match (kept, header.length) {
        (Some(vr), _) if vr == *b"SQ" => {
            let inner = if header.vr == Some(*b"UN") { Encoding::IMPLICIT } else { encoding };
            let items = read_items(stream, inner, header.length, depth + 1)?;
            out.add(header.tag, Value::Items(items));
        }
        (Some(vr), Some(bytes)) if bytes <= most_bytes(header.tag) => {
            let value = Value::decode(vr, &stream.take(bytes.into())?, encoding);
            out.add(header.tag, value);
        }
        (_, Some(bytes)) => stream.skip(bytes.into())?,
        (_, None) => skip_to_delimiter(stream, encoding, header)?,
    }
    Ok(())
}

fn most_bytes(tag: Tag) -> u32 {
    if tag::is_vector(tag) { MAX_VECTOR_BYTES } else { MAX_VALUE_BYTES }
}

fn read_items(
    stream: &mut ByteStream,
    encoding: Encoding,
    length: Option<u32>,
    depth: usize,
) -> Parsed<Vec<DataSet>> {
    if depth > MAX_DEPTH {
        return Err(format!("nests its sequences more than {MAX_DEPTH} deep; the file is damaged"));
    }
    let end = length.map(|length| stream.position() + u64::from(length));
    let mut items = Vec::new();
    while end.is_none_or(|end| stream.position() < end) {
        let header = read_header(stream, encoding)?;
        match header.tag {
            Tag::ITEM => items.push(read_item(stream, encoding, header.length, depth)?),
            Tag::SEQUENCE_END => break,
            other => return Err(unexpected(other, stream)),
        }
    }
    Ok(items)
}

fn read_item(
    stream: &mut ByteStream,
    encoding: Encoding,
    length: Option<u32>,
    depth: usize,
) -> Parsed<DataSet> {
    let end = length.map(|length| stream.position() + u64::from(length));
    let mut item = DataSet::default();
    while end.is_none_or(|end| stream.position() < end) {
        let header = read_header(stream, encoding)?;
        if header.tag == Tag::ITEM_END {
            break;
        }
        read_element(stream, encoding, header, &mut item, depth)?;
    }
    Ok(item)
}

/// Skips a value of undefined length: nested sequences and items, or fragments.
fn skip_to_delimiter(stream: &mut ByteStream, outer: Encoding, opened: ElementHeader) -> Parsed<()> {
    let inside = |vr, outer| if vr == Some(*b"UN") { Encoding::IMPLICIT } else { outer };
    let mut open = vec![inside(opened.vr, outer)];
    while let Some(&encoding) = open.last() {
        let header = read_header(stream, encoding)?;
        match (header.tag, header.length) {
            (Tag::ITEM_END | Tag::SEQUENCE_END, _) => drop(open.pop()),
            (_, Some(bytes)) => stream.skip(bytes.into())?,
            (_, None) if open.len() > 2 * MAX_DEPTH => {
                return Err(format!("nests its sequences more than {MAX_DEPTH} deep; the file is damaged"));
            }
            (_, None) => open.push(inside(header.vr, encoding)),
        }
    }
    Ok(())
}

fn unexpected(tag: Tag, stream: &ByteStream) -> String {
    format!(
        "holds ({:04X},{:04X}) at byte {} where an item should begin; the file is damaged",
        tag.0,
        tag.1,
        stream.position()
    )
}
