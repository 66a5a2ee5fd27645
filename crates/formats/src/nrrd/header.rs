use std::collections::BTreeMap;
use std::path::Path;
use std::str::FromStr;

use crate::FormatError;
use crate::header_text::{HeaderLines, quoted};

/// The fields of a NRRD header, as text.
pub(crate) struct Header {
    /// By name, in lower case and without spaces.
    fields: BTreeMap<String, String>,
    /// The lines after `data file: LIST`.
    pub listed_files: Vec<String>,
    /// Where the voxels of an attached header start; nothing where the file ended with the header.
    pub data_start: Option<u64>,
}

impl Header {
    pub fn read(path: &Path) -> Result<Self, FormatError> {
        let mut lines = HeaderLines::open(path)?;
        let magic = lines.next()?.unwrap_or_default();
        if !matches!(magic.trim_end(), "NRRD0001" | "NRRD0002" | "NRRD0003" | "NRRD0004" | "NRRD0005") {
            let what = format!("starts with {}; NRRD0001 to NRRD0005 are read", quoted(&magic));
            return Err(FormatError::unsupported(path, what));
        }
        let mut header = Self { fields: BTreeMap::new(), listed_files: Vec::new(), data_start: None };
        while let Some(line) = lines.next()? {
            if line.is_empty() {
                header.data_start = Some(lines.offset_bytes);
                break;
            }
            header.take_line(&line).map_err(|what| FormatError::malformed(path, what))?;
            if header.field("datafile").is_some_and(|value| value.split_whitespace().next() == Some("LIST")) {
                while let Some(name) = lines.next()? {
                    if !name.trim().is_empty() {
                        header.listed_files.push(name.trim().to_owned());
                    }
                }
            }
        }
        Ok(header)
    }

    fn take_line(&mut self, line: &str) -> Result<(), String> {
        if line.starts_with('#') {
            return Ok(());
        }
        // A key/value pair has ":=" where a field has ": "; both may hold the other's mark later in the line.
        let Some(colon) = line.find(':') else {
            return Err(format!("the header line {} is neither a field nor a comment", quoted(line)));
        };
        if line[colon..].starts_with(":=") {
            return Ok(());
        }
        let name: String = line[..colon].to_ascii_lowercase().split_whitespace().collect();
        let name = if name == "centers" { "centerings".to_owned() } else { name };
        let value = line[colon + 1..].trim().to_owned();
        match self.fields.insert(name, value) {
            None => Ok(()),
            Some(_) => Err(format!("the field {} is there twice", quoted(&line[..colon]))),
        }
    }

    /// A field's value; the name is written in lower case without spaces.
    pub fn field(&self, name: &str) -> Option<&str> {
        self.fields.get(name).map(String::as_str)
    }

    /// A field's words, of which there must be `count`.
    pub fn words(&self, name: &str, count: usize) -> Result<Option<Vec<String>>, String> {
        let Some(value) = self.field(name) else { return Ok(None) };
        let words = split_words(value);
        if words.len() != count {
            return Err(format!("the field {name:?} has {} entries; there should be {count}", words.len()));
        }
        Ok(Some(words))
    }

    /// A field's numbers, of which there must be `count`.
    pub fn numbers<T: FromStr>(&self, name: &str, count: usize) -> Result<Option<Vec<T>>, String> {
        let parse = |word: String| {
            let wrong = || format!("the field {name:?} holds {}, which is no fitting number", quoted(&word));
            word.parse().map_err(|_| wrong())
        };
        match self.words(name, count)? {
            Some(words) => words.into_iter().map(parse).collect::<Result<_, _>>().map(Some),
            None => Ok(None),
        }
    }
}

/// The words of a value: apart by white space, except within quotes and parentheses.
pub(crate) fn split_words(value: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut rest = value.trim_start();
    while let Some(first) = rest.chars().next() {
        let end = match first {
            '(' => rest.find(')').map(|end| end + 1),
            '"' => rest[1..].find('"').map(|end| end + 2),
            _ => rest.find(char::is_whitespace),
        };
        let (word, after) = rest.split_at(end.unwrap_or(rest.len()));
        words.push(word.trim_matches('"').to_owned());
        rest = after.trim_start();
    }
    words
}

/// The numbers of a vector such as `(1,0,0)`, or nothing where the word is `none` or all of them are NaN.
pub(crate) fn vector(word: &str) -> Result<Option<Vec<f64>>, String> {
    if word.eq_ignore_ascii_case("none") {
        return Ok(None);
    }
    let inner = word.strip_prefix('(').and_then(|word| word.strip_suffix(')'));
    let numbers = inner.map(|inner| inner.split(',').map(|number| number.trim().parse()).collect());
    match numbers {
        Some(Ok(numbers)) => {
            let numbers: Vec<f64> = numbers;
            Ok((!numbers.iter().all(|number| number.is_nan())).then_some(numbers))
        }
        _ => Err(format!("{} is no vector; it should look like (1,0,0)", quoted(word))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_keep_quotes_and_vectors_together() {
        assert_eq!(split_words(r#" (1, 0,0)  none "mm" "a b" x "#), ["(1, 0,0)", "none", "mm", "a b", "x"]);
        assert_eq!(split_words("(1,0"), ["(1,0"]);
        assert_eq!(split_words("\""), [""]);
    }

    #[test]
    fn vectors_are_read() {
        assert_eq!(vector("(1, -2.5e1,0)"), Ok(Some(vec![1.0, -25.0, 0.0])));
        assert_eq!(vector("none"), Ok(None));
        assert_eq!(vector("(nan,nan,nan)"), Ok(None));
        assert!(vector("(1,2").is_err() && vector("(a,b,c)").is_err() && vector("1").is_err());
    }
}
