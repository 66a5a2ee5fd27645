use std::path::{Path, PathBuf};

use super::header::Header;
use crate::FormatError;
use crate::header_text::{companion, number_range, numbered_name, quoted};
use crate::voxels::{Encoding, Part, Start, equal_parts};

/// The files that hold the voxels of all `sizes`, and where in them they start.
pub(crate) fn find(
    path: &Path,
    header: &Header,
    sizes: &[u64],
    encoding: Encoding,
    total_bytes: u64,
) -> Result<Vec<Part>, FormatError> {
    let malformed = |what: String| FormatError::malformed(path, what);
    let header_size = header.number::<i64>(&["HeaderSize"]).map_err(malformed)?.unwrap_or(0);
    let start = match (header_size, encoding) {
        (0.., _) => Start::At(header_size.unsigned_abs()),
        (-1, Encoding::Raw) => Start::FromEnd,
        _ => {
            let what =
                format!("HeaderSize = {header_size} is not read; it may be -1, for uncompressed voxels");
            return Err(FormatError::unsupported(path, what));
        }
    };
    let value = header.field("ElementDataFile").unwrap_or("");
    if value.eq_ignore_ascii_case("LOCAL") {
        let start = if header_size == 0 { Start::At(header.end_bytes) } else { start };
        return Ok(vec![Part { path: path.to_owned(), start, skip_decoded: 0, bytes: total_bytes }]);
    }
    let files = named_files(path, header, value, sizes)?;
    let count = files.len();
    equal_parts(files, start, total_bytes).ok_or_else(|| {
        malformed(format!("the voxels do not divide into the {count} files of ElementDataFile"))
    })
}

/// The files of `ElementDataFile = NAME`, `LIST [dimensions]` or `PATTERN [first [last [step]]]`.
fn named_files(
    path: &Path,
    header: &Header,
    value: &str,
    sizes: &[u64],
) -> Result<Vec<PathBuf>, FormatError> {
    let malformed = |what: String| FormatError::malformed(path, what);
    let words: Vec<&str> = value.split_whitespace().collect();
    let (names, dimensions_per_file) = match words[..] {
        ["LIST"] => (header.listed_files.clone(), sizes.len() - 1),
        ["LIST", word] => {
            let dimensions = word.trim_end_matches(['D', 'd']).parse::<usize>().unwrap_or(0);
            if !(1..=sizes.len()).contains(&dimensions) {
                return Err(malformed(format!("ElementDataFile is LIST with {} dimensions", quoted(word))));
            }
            (header.listed_files.clone(), dimensions)
        }
        [pattern, ref range @ ..] if pattern.contains('%') && range.len() <= 3 => {
            (numbered_files(path, pattern, range, sizes)?, sizes.len() - 1)
        }
        _ => return Ok(vec![companion(path, value)?]),
    };
    let expected =
        sizes[dimensions_per_file..].iter().fold(1, |product: u64, &size| product.saturating_mul(size));
    if names.len() as u64 != expected {
        let what = format!("ElementDataFile names {} files; DimSize asks for {expected}", names.len());
        return Err(malformed(what));
    }
    names.iter().map(|name| companion(path, name)).collect()
}

fn numbered_files(
    path: &Path,
    pattern: &str,
    range: &[&str],
    sizes: &[u64],
) -> Result<Vec<String>, FormatError> {
    let wrong = || {
        let what =
            format!("ElementDataFile counts {} in a way that is not one file per slice", quoted(pattern));
        FormatError::malformed(path, what)
    };
    let numbers: Result<Vec<i64>, _> = range.iter().map(|word| word.parse()).collect();
    let numbers = numbers.map_err(|_| wrong())?;
    let most = sizes.last().copied().unwrap_or(1).min(1 << 22);
    let first = numbers.first().copied().unwrap_or(1);
    let last = numbers.get(1).copied().or_else(|| first.checked_add(most as i64 - 1)).ok_or_else(wrong)?;
    let step = numbers.get(2).copied().unwrap_or(1);
    let numbers = number_range(first, last, step, most).ok_or_else(wrong)?;
    numbers.into_iter().map(|number| numbered_name(pattern, number).ok_or_else(wrong)).collect()
}
