use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use super::header::Header;
use crate::FormatError;
use crate::header_text::{companion, number_range, numbered_name, quoted};
use crate::voxels::{Encoding, Part, Start, equal_parts};

/// The files that hold the array of `total_bytes`, and where in them it starts.
pub(crate) fn find(
    path: &Path,
    header: &Header,
    encoding: Encoding,
    total_bytes: u64,
) -> Result<Vec<Part>, FormatError> {
    let malformed = |what: String| FormatError::malformed(path, what);
    let line_skip = header.numbers::<u64>("lineskip", 1).map_err(malformed)?.map_or(0, |numbers| numbers[0]);
    let byte_skip = header.numbers::<i64>("byteskip", 1).map_err(malformed)?.map_or(0, |numbers| numbers[0]);

    let mut parts = match header.field("datafile") {
        None => {
            let start = header.data_start.ok_or_else(|| {
                malformed("the header is followed by no data and names no \"data file\"".to_owned())
            })?;
            vec![Part { path: path.to_owned(), start: Start::At(start), skip_decoded: 0, bytes: total_bytes }]
        }
        Some(value) => {
            let files = named_files(path, header, value)?;
            let count = files.len();
            equal_parts(files, Start::At(0), total_bytes).ok_or_else(|| {
                malformed(format!("the voxels do not divide into the {count} files of \"data file\""))
            })?
        }
    };
    for part in &mut parts {
        let Start::At(start) = part.start else { continue };
        let start = skip_lines(&part.path, start, line_skip)?;
        (part.start, part.skip_decoded) = match (byte_skip, encoding) {
            (0.., Encoding::Deflate | Encoding::Bzip2) => (Start::At(start), byte_skip.unsigned_abs()),
            (0.., _) => (Start::At(start.saturating_add(byte_skip.unsigned_abs())), 0),
            (-1, Encoding::Raw) => (Start::FromEnd, 0),
            _ => {
                let what = format!("\"byte skip: {byte_skip}\" is not read; it may be -1, for raw encoding");
                return Err(FormatError::unsupported(path, what));
            }
        };
    }
    Ok(parts)
}

/// The files of `data file: NAME`, `LIST [subdim]` or `PATTERN min max step [subdim]`.
fn named_files(path: &Path, header: &Header, value: &str) -> Result<Vec<PathBuf>, FormatError> {
    let malformed = |what: String| FormatError::malformed(path, what);
    let words: Vec<&str> = value.split_whitespace().collect();
    let (names, subdimension) = match words[..] {
        ["LIST"] => (header.listed_files.clone(), None),
        ["LIST", subdimension] => (header.listed_files.clone(), Some(subdimension)),
        [pattern, first, last, step, ref rest @ ..] if pattern.contains('%') && rest.len() <= 1 => {
            (numbered_files(path, header, pattern, [first, last, step])?, rest.first().copied())
        }
        _ => return Ok(vec![companion(path, value)?]),
    };
    check_count(header, names.len() as u64, subdimension).map_err(malformed)?;
    names.iter().map(|name| companion(path, name)).collect()
}

fn numbered_files(
    path: &Path,
    header: &Header,
    pattern: &str,
    range: [&str; 3],
) -> Result<Vec<String>, FormatError> {
    let wrong = || {
        let what = format!(
            "\"data file\" counts {} from {} to {} by {}, which does not give one file per slice",
            quoted(pattern),
            quoted(range[0]),
            quoted(range[1]),
            quoted(range[2])
        );
        FormatError::malformed(path, what)
    };
    let [Ok(first), Ok(last), Ok(step)] = range.map(str::parse::<i64>) else { return Err(wrong()) };
    let most = sizes(header).into_iter().fold(1, u64::saturating_mul).min(1 << 22);
    let numbers = number_range(first, last, step, most).ok_or_else(wrong)?;
    numbers.into_iter().map(|number| numbered_name(pattern, number).ok_or_else(wrong)).collect()
}

/// Each file holds `subdimension` axes: as many files as the slower axes have samples, or, with all axes in each,
/// slabs along the slowest.
fn check_count(header: &Header, files: u64, subdimension: Option<&str>) -> Result<(), String> {
    let sizes = sizes(header);
    let axes = match subdimension {
        None => sizes.len().saturating_sub(1),
        Some(word) => match word.parse::<usize>() {
            Ok(axes) if (1..=sizes.len()).contains(&axes) => axes,
            _ => return Err(format!("\"data file\" has {} for its dimension per file", quoted(word))),
        },
    };
    let expected = sizes[axes..].iter().fold(1, |product: u64, &size| product.saturating_mul(size));
    let fits = if axes == sizes.len() {
        files > 0 && sizes.last().is_some_and(|size| size.is_multiple_of(files))
    } else {
        files == expected
    };
    if fits {
        Ok(())
    } else {
        Err(format!("\"data file\" names {files} files; the sizes ask for {expected}"))
    }
}

/// The sizes, which the axes were read from without an error before.
fn sizes(header: &Header) -> Vec<u64> {
    let words = header.field("sizes").unwrap_or("").split_whitespace();
    words.map(|word| word.parse().unwrap_or(0)).collect()
}

/// The offset after so many lines from `start` on.
fn skip_lines(path: &Path, start: u64, lines: u64) -> Result<u64, FormatError> {
    if lines == 0 {
        return Ok(start);
    }
    let failed = |error| FormatError::io(path, error);
    let mut file = File::open(path).map_err(failed)?;
    file.seek(SeekFrom::Start(start)).map_err(failed)?;
    let mut reader = BufReader::new(file);
    let mut offset = start;
    for line in 0..lines {
        // A line is passed over in pieces, so that a file without line ends is never held whole.
        loop {
            let mut piece = Vec::new();
            let read = reader.by_ref().take(1 << 16).read_until(b'\n', &mut piece).map_err(failed)?;
            offset += read as u64;
            if read == 0 {
                let what = format!("has {line} lines; \"line skip\" asks to pass over {lines}");
                return Err(FormatError::malformed(path, what));
            }
            if piece.ends_with(b"\n") {
                break;
            }
        }
    }
    Ok(offset)
}
