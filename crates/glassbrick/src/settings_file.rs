//! Small JSON files that people write: read whole, within a bound, and refused with the place of what is wrong.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use serde::de::DeserializeOwned;

use crate::Error;

const MAX_BYTES: u64 = 16 << 20;

/// Reads a JSON object from a file as `T`.
///
/// # Errors
/// When it cannot be read, is longer than 16 MiB, or is no object such as `T`.
pub fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, Error> {
    let fail = |source| Error::Read { path: path.to_owned(), source };
    let mut json = Vec::new();
    File::open(path).map_err(fail)?.take(MAX_BYTES + 1).read_to_end(&mut json).map_err(fail)?;
    if json.len() as u64 > MAX_BYTES {
        return Err(settings_error(path, "is longer than 16 MiB; is it the right file?"));
    }
    let text = json.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&json);
    if text.trim_ascii_start().first() != Some(&b'{') {
        return Err(settings_error(path, "is not a JSON object; is it the right file?"));
    }
    serde_json::from_slice(text).map_err(|error| settings_error(path, error))
}

/// An error about what the file at `path` says, in one line even where it quotes the file.
pub fn settings_error(path: &Path, what: impl ToString) -> Error {
    Error::Settings { path: path.to_owned(), what: what.to_string().replace(['\n', '\r'], " ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashMap;
    use std::fs;

    #[test]
    fn files_that_are_too_long_missing_folders_or_no_objects_are_refused() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let long = folder.path().join("long.json");
        fs::write(&long, vec![b' '; (16 << 20) + 1]).expect("a scratch file");
        let list = folder.path().join("list.json");
        fs::write(&list, "[1,2]").expect("a scratch file");
        for (path, word) in [
            (long, "longer than 16 MiB"),
            (list, "not a JSON object"),
            (folder.path().join("none.json"), "cannot be read"),
            (folder.path().to_owned(), "cannot be read"),
        ] {
            let error = read_json::<HashMap<String, u8>>(&path).expect_err("refused").to_string();
            assert!(error.contains(word) && error.contains(&*path.to_string_lossy()), "{error}");
        }
    }

    #[test]
    fn a_byte_order_mark_is_no_harm() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let path = folder.path().join("marked.json");
        fs::write(&path, b"\xef\xbb\xbf {\"a\":1}").expect("a scratch file");
        let object: HashMap<String, u8> = read_json(&path).expect("it is JSON");
        assert_eq!(object["a"], 1);
    }
}
