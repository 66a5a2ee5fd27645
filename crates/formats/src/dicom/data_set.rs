//! The kept data elements of a file, as a tree.

use super::byte_stream::{ByteStream, Parsed};
use super::element::{ElementHeader, Encoding, read_header};
use super::tag::{self, Tag};

/// Deeper nesting than any real file has.
const MAX_DEPTH: usize = 32;
/// A longer value of an element that is kept is damaged, and skipped.
const MAX_VALUE_BYTES: u32 = 4096;
/// The same for an element with a number for each frame.
const MAX_VECTOR_BYTES: u32 = 4 << 20;

/// Data elements of one level.
#[derive(Clone, Debug, Default)]
pub(super) struct DataSet {
    elements: Vec<(Tag, Value)>,
}

#[derive(Clone, Debug)]
enum Value {
    Text(String),
    Numbers(Vec<f64>),
    Items(Vec<DataSet>),
}

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

impl DataSet {
    /// The first value as text, without padding; nothing where it is empty.
    pub(super) fn text(&self, tag: Tag) -> Option<&str> {
        match self.find(tag)? {
            Value::Text(text) => Some(text.as_str()).filter(|text| !text.is_empty()),
            _ => None,
        }
    }

    /// All values as numbers; nothing where one of them is not a finite number.
    pub(super) fn numbers(&self, tag: Tag) -> Option<Vec<f64>> {
        let numbers: Vec<f64> = match self.find(tag)? {
            Value::Numbers(numbers) => numbers.clone(),
            Value::Text(text) => {
                text.split('\\').map(|number| number.trim().parse().ok()).collect::<Option<_>>()?
            }
            Value::Items(_) => return None,
        };
        (!numbers.is_empty() && numbers.iter().all(|number| number.is_finite())).then_some(numbers)
    }

    /// The first value as a number.
    pub(super) fn number(&self, tag: Tag) -> Option<f64> {
        self.numbers(tag).map(|numbers| numbers[0])
    }

    /// The first value as a whole number that fits.
    pub(super) fn whole(&self, tag: Tag) -> Option<u32> {
        let number = self.number(tag)?;
        (number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number)).then_some(number as u32)
    }

    /// The items of a sequence; none where there is no such sequence.
    pub(super) fn items(&self, tag: Tag) -> &[DataSet] {
        match self.find(tag) {
            Some(Value::Items(items)) => items,
            _ => &[],
        }
    }

    pub(super) fn has(&self, tag: Tag) -> bool {
        self.find(tag).is_some()
    }

    /// Adds an element; of several with one tag the first holds.
    fn add(&mut self, tag: Tag, value: Value) {
        if !self.has(tag) {
            self.elements.push((tag, value));
        }
    }

    fn find(&self, tag: Tag) -> Option<&Value> {
        self.elements.iter().find(|(kept, _)| *kept == tag).map(|(_, value)| value)
    }
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
            let value = decode(vr, &stream.take(bytes.into())?, encoding);
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

fn decode(vr: [u8; 2], bytes: &[u8], encoding: Encoding) -> Value {
    let numbers = |size: usize, number: fn(u64) -> f64| {
        let chunks = bytes.chunks_exact(size);
        Value::Numbers(chunks.map(|chunk| number(bits(chunk, encoding.big_endian))).collect())
    };
    match &vr {
        b"US" => numbers(2, |bits| bits as f64),
        b"SS" => numbers(2, |bits| f64::from(bits as u16 as i16)),
        b"UL" | b"OL" => numbers(4, |bits| bits as f64),
        b"SL" => numbers(4, |bits| f64::from(bits as u32 as i32)),
        b"UV" | b"OV" => numbers(8, |bits| bits as f64),
        b"SV" => numbers(8, |bits| bits as i64 as f64),
        b"FL" | b"OF" => numbers(4, |bits| f64::from(f32::from_bits(bits as u32))),
        b"FD" | b"OD" => numbers(8, f64::from_bits),
        _ => {
            let padding = |character: char| character == '\0' || character.is_whitespace();
            Value::Text(String::from_utf8_lossy(bytes).trim_matches(padding).to_owned())
        }
    }
}

fn bits(bytes: &[u8], big_endian: bool) -> u64 {
    let append = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
    if big_endian { bytes.iter().fold(0, append) } else { bytes.iter().rev().fold(0, append) }
}
