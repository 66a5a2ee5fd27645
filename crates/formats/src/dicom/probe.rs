//! Finds out whether a file is DICOM, and reads its header.

use std::fs::File;
use std::path::Path;

use super::byte_stream::{ByteStream, Parsed};
use super::data_set::DataSet;
use super::data_set_reader::{PixelElement, read_data_set, read_meta};
use super::element::{Encoding, is_vr};
use super::image::Image;
use super::tag;
use super::transfer_syntax::TransferSyntax;
use crate::FormatError;

/// Bytes before the mark, which may hold anything.
const PREAMBLE_BYTES: u64 = 128;
const MARK: &[u8] = b"DICM";

/// What a file turned out to be.
#[derive(Debug)]
pub(super) enum Probed {
    NotDicom,
    /// DICOM of another kind, such as a structure set or a report.
    NoImage,
    /// DICOM that cannot be read, or holds no scalar image.
    Refused(FormatError),
    Image(Box<Image>),
}

/// Reads a file's header.
pub(super) fn probe(path: &Path) -> Probed {
    let (mut stream, file_bytes) = match open(path) {
        Ok(opened) => opened,
        Err(source) => return Probed::Refused(FormatError::io(path, source)),
    };
    let marked = match has_mark(&mut stream) {
        Ok(marked) => marked,
        Err(what) => return Probed::Refused(FormatError::malformed(path, what)),
    };
    if !marked && !looks_like_data_set(stream.peek().unwrap_or_default()) {
        return Probed::NotDicom;
    }
    match read(stream) {
        // Without a mark, the bytes must also make sense to be taken for DICOM.
        Ok((_, root, _)) if !marked && !root.has(tag::SOP_CLASS_UID) && !root.has(tag::ROWS) => {
            Probed::NotDicom
        }
        Err(_) if !marked => Probed::NotDicom,
        Err(what) => Probed::Refused(FormatError::malformed(path, what)),
        Ok((_, _, None)) => Probed::NoImage,
        Ok((transfer_syntax, root, Some(pixels))) => {
            match Image::read(path, file_bytes, transfer_syntax, &root, pixels) {
                Ok(image) => Probed::Image(Box::new(image)),
                Err(what) => Probed::Refused(FormatError::unsupported(path, what)),
            }
        }
    }
}

/// Opens the data set of a file again, at its first element.
pub(super) fn open_data_set(path: &Path) -> Parsed<ByteStream> {
    let (mut stream, _) = open(path).map_err(|error| error.to_string())?;
    has_mark(&mut stream)?;
    start_data_set(stream).map(|(_, stream)| stream)
}

fn open(path: &Path) -> std::io::Result<(ByteStream, u64)> {
    let file = File::open(path)?;
    let bytes = file.metadata()?.len();
    Ok((ByteStream::new(file, bytes), bytes))
}

/// Goes to the first element, which comes after the preamble and its mark in all but very old files.
fn has_mark(stream: &mut ByteStream) -> Parsed<bool> {
    let marked = stream.peek()?.get(PREAMBLE_BYTES as usize..).is_some_and(|rest| rest.starts_with(MARK));
    if marked {
        stream.skip(PREAMBLE_BYTES + MARK.len() as u64)?;
    }
    Ok(marked)
}

/// Whether these could be the first bytes of file meta information or of a data set.
fn looks_like_data_set(bytes: &[u8]) -> bool {
    let Some(&[group_low, group_high, element_low, element_high, a, b, c, d]) = bytes.first_chunk() else {
        return false;
    };
    let known_group = |group| matches!(group, 0x0002 | 0x0008);
    let little = known_group(u16::from_le_bytes([group_low, group_high])) && element_high == 0;
    let big = known_group(u16::from_be_bytes([group_low, group_high])) && element_low == 0;
    let short = |length: u32| length < 256;
    (little && (is_vr([a, b]) || short(u32::from_le_bytes([a, b, c, d]))))
        || (big && (is_vr([a, b]) || short(u32::from_be_bytes([a, b, c, d]))))
}

fn read(stream: ByteStream) -> Parsed<(TransferSyntax, DataSet, Option<PixelElement>)> {
    let (transfer_syntax, mut stream) = start_data_set(stream)?;
    let (root, pixels) = read_data_set(&mut stream, transfer_syntax.encoding)?;
    Ok((transfer_syntax, root, pixels))
}

/// Reads the file meta information, and goes to the first element of the data set.
fn start_data_set(mut stream: ByteStream) -> Parsed<(TransferSyntax, ByteStream)> {
    let meta = match stream.peek()? {
        [0x02, 0x00, ..] => read_meta(&mut stream)?,
        _ => DataSet::default(),
    };
    let mut transfer_syntax = match meta.text(tag::TRANSFER_SYNTAX_UID) {
        Some(uid) => TransferSyntax::from_uid(uid),
        None => TransferSyntax::from_uid("1.2.840.10008.1.2"),
    };
    if transfer_syntax.deflated {
        stream = stream.inflate();
    }
    transfer_syntax.encoding = true_encoding(stream.peek()?, transfer_syntax.encoding);
    Ok((transfer_syntax, stream))
}

/// The encoding in which the first element makes sense: transfer syntaxes are missing, or wrong, in real
/// files.
fn true_encoding(bytes: &[u8], claimed: Encoding) -> Encoding {
    let Some(&[group_low, group_high, _, _, a, b]) = bytes.first_chunk() else { return claimed };
    let big_endian = match (group_low, group_high) {
        (0, 1..) => true,
        (1.., 0) => false,
        _ => claimed.big_endian,
    };
    Encoding { explicit_vr: is_vr([a, b]), big_endian }
}
