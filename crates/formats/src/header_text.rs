//! Text headers: their lines, the files that they name, and their words in messages.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Take};
use std::path::{Component, Path, PathBuf};

use crate::FormatError;

/// Bytes beyond which a text header is taken to be no header. Some hold long private fields.
const LONGEST_HEADER_BYTES: u64 = 16 << 20;

/// Lines of a text header, and the place in the file where the next line would start.
pub(crate) struct HeaderLines {
    path: PathBuf,
    reader: BufReader<Take<File>>,
    /// Bytes read so far.
    pub offset_bytes: u64,
}

impl HeaderLines {
    pub fn open(path: &Path) -> Result<Self, FormatError> {
        let file = File::open(path).map_err(|error| FormatError::io(path, error))?;
        let reader = BufReader::new(file.take(LONGEST_HEADER_BYTES));
        Ok(Self { path: path.to_owned(), reader, offset_bytes: 0 })
    }

    /// The next line without its end, or nothing at the end of the file.
    pub fn next(&mut self) -> Result<Option<String>, FormatError> {
        let mut line = Vec::new();
        let read = self.reader.read_until(b'\n', &mut line).map_err(|e| FormatError::io(&self.path, e))?;
        self.offset_bytes += read as u64;
        if self.offset_bytes >= LONGEST_HEADER_BYTES {
            return Err(FormatError::malformed(&self.path, "the header does not end within 16 MiB"));
        }
        if read == 0 {
            return Ok(None);
        }
        let text = String::from_utf8_lossy(&line);
        Ok(Some(text.trim_end_matches(['\n', '\r']).to_owned()))
    }
}

/// A header's words as a message shows them: on one line, and not too long.
pub(crate) fn quoted(words: &str) -> String {
    let mut shown: String = words.chars().take(60).collect();
    if shown.len() < words.len() {
        shown.push('…');
    }
    format!("{shown:?}")
}

/// The file that a header names, which must lie in the header's folder or below it.
pub(crate) fn companion(header: &Path, name: &str) -> Result<PathBuf, FormatError> {
    let relative = Path::new(name);
    let stays = relative.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if name.is_empty() || name.contains('\0') || !stays {
        return Err(FormatError::unsupported(
            header,
            format!(
                "names the data file {}, which is outside the header's folder; put the file beside the header \
                 and name it there",
                quoted(name)
            ),
        ));
    }
    let path = header.parent().unwrap_or(Path::new("")).join(relative);
    match path.metadata() {
        Ok(metadata) if metadata.is_file() => Ok(path),
        Ok(_) => Err(FormatError::malformed(header, format!("names {}, which is no file", quoted(name)))),
        Err(error) => Err(FormatError::malformed(
            header,
            format!("names the data file {}, which cannot be opened: {error}", quoted(name)),
        )),
    }
}

/// The name that a pattern such as `slice%03d.raw` gives a number, if it has exactly one place for it.
pub(crate) fn numbered_name(pattern: &str, number: i64) -> Option<String> {
    let (before, rest) = pattern.split_once('%')?;
    let letter = rest.find(|c: char| !c.is_ascii_digit())?;
    let (width, after) = rest.split_at(letter);
    let after = after.strip_prefix(['d', 'i', 'u'])?;
    let columns = if width.is_empty() { 0 } else { width.parse::<usize>().ok().filter(|&n| n <= 64)? };
    if after.contains('%') {
        return None;
    }
    Some(if width.starts_with('0') {
        format!("{before}{number:0columns$}{after}")
    } else {
        format!("{before}{number:columns$}{after}")
    })
}

/// The numbers from `first` to `last` by `step`, if the step leads there and they are not more than `most`.
pub(crate) fn number_range(first: i64, last: i64, step: i64, most: u64) -> Option<Vec<i64>> {
    let (distance, step_i128) = (i128::from(last) - i128::from(first), i128::from(step));
    if step == 0 || distance.signum() * step_i128.signum() < 0 {
        return None;
    }
    let count = distance / step_i128 + 1;
    if count > i128::from(most) {
        return None;
    }
    Some((0..count).map(|n| (i128::from(first) + n * step_i128) as i64).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn companions_stay_in_the_folder() {
        let folder = tempfile::tempdir().unwrap();
        let header = folder.path().join("a.mhd");
        std::fs::create_dir(folder.path().join("sub")).unwrap();
        std::fs::write(folder.path().join("sub/a.raw"), b"1").unwrap();
        assert!(companion(&header, "./sub/a.raw").is_ok());
        for name in ["../a.raw", "sub/../../a.raw", "/etc/passwd", "", "sub", "missing.raw", "a\0b"] {
            assert!(companion(&header, name).is_err(), "{name:?}");
        }
    }

    #[test]
    fn patterns_take_one_number() {
        assert_eq!(numbered_name("quarter.%d", 7).as_deref(), Some("quarter.7"));
        assert_eq!(numbered_name("s%03d.raw", 7).as_deref(), Some("s007.raw"));
        assert_eq!(numbered_name("s%3u", 7).as_deref(), Some("s  7"));
        for pattern in ["none", "%s", "%", "%d%d", "%999999999999999999999d", "%99d"] {
            assert_eq!(numbered_name(pattern, 1), None, "{pattern}");
        }
    }

    #[test]
    fn ranges_are_counted_before_they_are_made() {
        assert_eq!(number_range(1, 7, 3, 9), Some(vec![1, 4, 7]));
        assert_eq!(number_range(3, 1, -1, 9), Some(vec![3, 2, 1]));
        assert_eq!(number_range(5, 5, 1, 1), Some(vec![5]));
        for (first, last, step) in [(1, 2, 0), (1, 2, -1), (i64::MIN, i64::MAX, 1), (0, 10, 1)] {
            assert_eq!(number_range(first, last, step, 9), None);
        }
    }

    #[test]
    fn words_in_messages_are_short_and_on_one_line() {
        assert_eq!(quoted("a\tb\u{1b}"), "\"a\\tb\\u{1b}\"");
        assert!(quoted(&"x".repeat(10_000)).len() < 80);
    }
}
