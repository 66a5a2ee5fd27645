use std::path::PathBuf;

use glassbrick_volume::StoredType;

use crate::FormatError;

/// How voxels are written in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    Raw,
    /// A gzip or zlib stream, whichever it turns out to be.
    Deflate,
    Bzip2,
    /// Numbers in words.
    Text,
    /// Two hexadecimal digits a byte.
    Hex,
}

impl Encoding {
    pub fn name(self) -> &'static str {
        match self {
            Self::Raw => "raw",
            Self::Deflate => "deflate",
            Self::Bzip2 => "bzip2",
            Self::Text => "text",
            Self::Hex => "hex",
        }
    }

    /// The most bytes of voxels that so many bytes of a file can hold.
    fn most_voxel_bytes(self, file_bytes: u64, stored_type: StoredType) -> u64 {
        match self {
            Self::Raw => file_bytes,
            // Deflate's longest match is 258 bytes for two bits: 1032 to 1.
            Self::Deflate => file_bytes.saturating_mul(1040),
            // A bzip2 block of zeros holds 45.9 MB in some 40 bytes.
            Self::Bzip2 => file_bytes.saturating_mul(2_000_000),
            // A digit and a space each, but the last.
            Self::Text => file_bytes.div_ceil(2).saturating_mul(stored_type.bytes() as u64),
            Self::Hex => file_bytes / 2,
        }
    }
}

/// Where in a file the voxels start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Start {
    At(u64),
    /// The voxels are the last bytes of the file.
    FromEnd,
}

/// Voxels in one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    pub path: PathBuf,
    pub start: Start,
    /// Bytes to pass over after decoding.
    pub skip_decoded: u64,
    /// Bytes of voxels that this file gives, decoded.
    pub bytes: u64,
}

impl Part {
    /// Finds out where the part starts, and that the file is long enough for what the header claims.
    pub fn settle(&mut self, encoding: Encoding, stored_type: StoredType) -> Result<(), FormatError> {
        let metadata = self.path.metadata().map_err(|error| FormatError::io(&self.path, error))?;
        let length = metadata.len();
        let needed = self.skip_decoded.saturating_add(self.bytes);
        let start = match self.start {
            Start::At(offset) => offset,
            Start::FromEnd => length.saturating_sub(needed),
        };
        let available = length.saturating_sub(start);
        if encoding.most_voxel_bytes(available, stored_type) < needed {
            let what = match encoding {
                Encoding::Raw => format!(
                    "the header claims {needed} bytes of voxels from byte {start} on, but the file ends after \
                     {available}; it is cut short, or the header is wrong"
                ),
                _ => format!(
                    "the header claims {needed} bytes of voxels, more than {available} bytes of {} data can \
                     hold; the file is cut short, or the header is wrong",
                    encoding.name()
                ),
            };
            return Err(FormatError::malformed(&self.path, what));
        }
        self.start = Start::At(start);
        Ok(())
    }

    /// Where the part starts in its file. It must be settled.
    pub fn offset_bytes(&self) -> u64 {
        match self.start {
            Start::At(offset) => offset,
            Start::FromEnd => unreachable!("a part is settled before it is read"),
        }
    }
}

/// Parts of equal size, one of each file, that hold `total_bytes` together; nothing where they do not divide.
pub(crate) fn equal_parts(paths: Vec<PathBuf>, start: Start, total_bytes: u64) -> Option<Vec<Part>> {
    let files = paths.len() as u64;
    if files == 0 || !total_bytes.is_multiple_of(files) {
        return None;
    }
    let part = |path| Part { path, start, skip_decoded: 0, bytes: total_bytes / files };
    Some(paths.into_iter().map(part).collect())
}

/// What lies from byte `start` to byte `end` of all parts' voxels. The parts must be raw and settled.
pub(crate) fn window(parts: Vec<Part>, start: u64, end: u64) -> Vec<Part> {
    let mut position = 0;
    let mut inside = Vec::new();
    for part in parts {
        let (first, last) = (start.clamp(position, position + part.bytes), end.min(position + part.bytes));
        if first < last {
            let offset = part.offset_bytes() + part.skip_decoded + (first - position);
            let bytes = last - first;
            inside.push(Part { path: part.path, start: Start::At(offset), skip_decoded: 0, bytes });
        }
        position += part.bytes;
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(name: &str, offset: u64, bytes: u64) -> Part {
        Part { path: name.into(), start: Start::At(offset), skip_decoded: 0, bytes }
    }

    #[test]
    fn a_window_cuts_the_parts_at_its_ends() {
        let parts = vec![part("a", 5, 10), part("b", 0, 10), part("c", 0, 10)];
        assert_eq!(window(parts.clone(), 8, 21), [part("a", 13, 2), part("b", 0, 10), part("c", 0, 1)]);
        assert_eq!(window(parts.clone(), 10, 20), [part("b", 0, 10)]);
        assert_eq!(window(parts.clone(), 0, 30), parts);
    }

    #[test]
    fn a_file_too_short_for_its_header_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("voxels");
        std::fs::write(&path, [0; 100]).unwrap();
        let settle = |start, bytes, encoding| {
            let mut part = Part { path: path.clone(), start, skip_decoded: 0, bytes };
            part.settle(encoding, StoredType::U16).map(|()| part.start)
        };
        assert_eq!(settle(Start::At(40), 60, Encoding::Raw).unwrap(), Start::At(40));
        assert_eq!(settle(Start::FromEnd, 60, Encoding::Raw).unwrap(), Start::At(40));
        assert!(settle(Start::At(41), 60, Encoding::Raw).is_err());
        assert!(settle(Start::At(101), 1, Encoding::Raw).is_err());
        assert!(settle(Start::FromEnd, 101, Encoding::Raw).is_err());
        assert!(settle(Start::At(0), 104_001, Encoding::Deflate).is_err());
        assert!(settle(Start::At(0), 102, Encoding::Text).is_err());
        assert!(settle(Start::At(0), u64::MAX, Encoding::Bzip2).is_err());
        assert!(settle(Start::At(0), 51, Encoding::Hex).is_err());
    }
}
