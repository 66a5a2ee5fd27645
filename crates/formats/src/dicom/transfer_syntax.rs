//! Transfer syntaxes: how a file's data elements and frames are encoded.

use super::element::Encoding;

/// How frames are encoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum FrameCoding {
    /// Uncompressed.
    Native,
    Rle,
    Jpeg,
    Jpeg2000,
    /// A coding of this name that is not decoded here.
    Unknown(&'static str),
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct TransferSyntax {
    pub uid: String,
    pub encoding: Encoding,
    /// Whether the data set is deflated as a whole.
    pub deflated: bool,
    pub coding: FrameCoding,
}

impl TransferSyntax {
    /// The transfer syntax of that UID. One that is not known is taken to differ in its frames only, as all
    /// do that were added to the standard.
    pub(super) fn from_uid(uid: &str) -> Self {
        let plain =
            |encoding| Self { uid: uid.to_owned(), encoding, deflated: false, coding: FrameCoding::Native };
        let coded = |coding| Self { coding, ..plain(Encoding::EXPLICIT) };
        match uid.strip_prefix("1.2.840.10008.1.2").unwrap_or("?") {
            "" => plain(Encoding::IMPLICIT),
            ".1" => plain(Encoding::EXPLICIT),
            ".2" => plain(Encoding { explicit_vr: true, big_endian: true }),
            ".1.99" => Self { deflated: true, ..plain(Encoding::EXPLICIT) },
            ".5" => coded(FrameCoding::Rle),
            ".4.50" | ".4.51" | ".4.53" | ".4.55" | ".4.57" | ".4.70" => coded(FrameCoding::Jpeg),
            ".4.90" | ".4.91" | ".4.201" | ".4.202" | ".4.203" => coded(FrameCoding::Jpeg2000),
            ".4.80" => coded(FrameCoding::Unknown("JPEG-LS lossless")),
            ".4.81" => coded(FrameCoding::Unknown("JPEG-LS near-lossless")),
            ".4.92" | ".4.93" => coded(FrameCoding::Unknown("multi-component JPEG 2000")),
            ".4.110" | ".4.111" | ".4.112" => coded(FrameCoding::Unknown("JPEG XL")),
            other if other.starts_with(".4.10") => coded(FrameCoding::Unknown("a video coding")),
            _ => coded(FrameCoding::Unknown("a coding that is not known here")),
        }
    }
}
