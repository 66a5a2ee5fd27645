//! The report inside a picture: its name there, and what text may be.

use std::path::Path;

use crate::Error;

/// The PNG keyword and EXR attribute that carry the report.
pub const REPORT_KEYWORD: &str = "glassbrick";

/// Common readers refuse text chunks of 8 MB; half of that is a thousand times a report of one frame.
const REPORT_MAX_BYTES: usize = 4 << 20;

/// Refuses a report too long to be carried by the picture at `path`.
pub fn check_report(report_json: &str, path: &Path) -> Result<(), Error> {
    if report_json.len() <= REPORT_MAX_BYTES {
        return Ok(());
    }
    Err(Error::Output {
        path: path.to_owned(),
        what: format!(
            "a report of {} bytes is too long for a picture, which carries {REPORT_MAX_BYTES}; shorten it",
            report_json.len()
        ),
    })
}

/// The same JSON in ASCII, for formats whose text is of bytes: what is beyond ASCII can only stand in strings,
/// where an escape means the same.
pub fn ascii_json(json: &str) -> String {
    let mut ascii = String::with_capacity(json.len());
    for character in json.chars() {
        if character.is_ascii() {
            ascii.push(character);
        } else {
            for unit in character.encode_utf16(&mut [0; 2]) {
                ascii.push_str(&format!("\\u{unit:04x}"));
            }
        }
    }
    ascii
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ascii_json_reads_as_the_same_text() {
        let json = r#"{"warnings":["Schädel μm 𝛼","plain \n"]}"#;
        let ascii = ascii_json(json);
        assert!(ascii.is_ascii());
        let read = |text: &str| serde_json::from_str::<serde_json::Value>(text).expect("JSON");
        assert_eq!(read(&ascii), read(json));
    }

    #[test]
    fn a_report_beyond_the_limit_is_refused() {
        let path = Path::new("out.png");
        assert!(check_report(&" ".repeat(REPORT_MAX_BYTES), path).is_ok());
        assert!(check_report(&" ".repeat(REPORT_MAX_BYTES + 1), path).is_err());
    }
}
