//! Headers of data elements in the three encodings of PS3.5: explicit and implicit VR, little and big endian.

use super::byte_stream::{ByteStream, Parsed};
use super::tag::Tag;

/// How data elements are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Encoding {
    /// Whether each element names its value representation.
    pub explicit_vr: bool,
    pub big_endian: bool,
}

impl Encoding {
    pub(super) const IMPLICIT: Self = Self { explicit_vr: false, big_endian: false };
    pub(super) const EXPLICIT: Self = Self { explicit_vr: true, big_endian: false };

    pub(super) fn u16(self, bytes: [u8; 2]) -> u16 {
        if self.big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) }
    }

    pub(super) fn u32(self, bytes: [u8; 4]) -> u32 {
        if self.big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) }
    }
}

/// What stands before a data element's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ElementHeader {
    pub tag: Tag,
    /// The value representation, where it is written.
    pub vr: Option<[u8; 2]>,
    /// Bytes of the value; nothing where a delimiter ends it.
    pub length: Option<u32>,
}

/// Value representations with a length of 32 bits.
const LONG: [&[u8; 2]; 13] =
    [b"OB", b"OD", b"OF", b"OL", b"OV", b"OW", b"SQ", b"SV", b"UC", b"UN", b"UR", b"UT", b"UV"];
/// Value representations with a length of 16 bits.
const SHORT: [&[u8; 2]; 21] = [
    b"AE", b"AS", b"AT", b"CS", b"DA", b"DS", b"DT", b"FL", b"FD", b"IS", b"LO", b"LT", b"PN", b"SH", b"SL",
    b"SS", b"ST", b"TM", b"UI", b"UL", b"US",
];

/// Whether these two bytes name a value representation.
pub(super) fn is_vr(bytes: [u8; 2]) -> bool {
    LONG.contains(&&bytes) || SHORT.contains(&&bytes)
}

/// Reads the header of the element that comes next.
pub(super) fn read_header(stream: &mut ByteStream, encoding: Encoding) -> Parsed<ElementHeader> {
    let mut tag = [0; 4];
    stream.read(&mut tag)?;
    let tag = Tag(encoding.u16([tag[0], tag[1]]), encoding.u16([tag[2], tag[3]]));
    let mut rest = [0; 4];
    stream.read(&mut rest)?;
    let (vr, length) = if !encoding.explicit_vr || tag.0 == 0xFFFE {
        (None, encoding.u32(rest))
    } else {
        let vr = [rest[0], rest[1]];
        if LONG.contains(&&vr) {
            let mut length = [0; 4];
            stream.read(&mut length)?;
            (Some(vr), encoding.u32(length))
        } else {
            (Some(vr), u32::from(encoding.u16([rest[2], rest[3]])))
        }
    };
    let undefined = length == u32::MAX;
    Ok(ElementHeader { tag, vr, length: (!undefined).then_some(length) })
}
