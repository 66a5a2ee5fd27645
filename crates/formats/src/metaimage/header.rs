use std::collections::BTreeMap;
use std::path::Path;
use std::str::FromStr;

use crate::FormatError;
use crate::header_text::{HeaderLines, quoted};

/// The fields of a MetaImage header, as text.
pub(crate) struct Header {
    fields: BTreeMap<String, String>,
    /// The lines after `ElementDataFile = LIST`.
    pub listed_files: Vec<String>,
    /// Where the file goes on after `ElementDataFile`, the last field.
    pub end_bytes: u64,
}

impl Header {
    pub fn read(path: &Path) -> Result<Self, FormatError> {
        let mut lines = HeaderLines::open(path)?;
        let mut header = Self { fields: BTreeMap::new(), listed_files: Vec::new(), end_bytes: 0 };
        while let Some(line) = lines.next()? {
            if line.trim().is_empty() {
                continue;
            }
            let Some((key, value)) = line.split_once('=') else {
                let what = format!("the header line {} is no \"Key = value\"", quoted(&line));
                return Err(FormatError::malformed(path, what));
            };
            let (key, value) = (key.trim().to_owned(), value.trim().to_owned());
            let last = key == "ElementDataFile";
            let is_list = last && value.split_whitespace().next().is_some_and(|word| word == "LIST");
            if header.fields.insert(key.clone(), value).is_some() {
                let what = format!("the field {} is there twice", quoted(&key));
                return Err(FormatError::malformed(path, what));
            }
            if is_list {
                while let Some(name) = lines.next()? {
                    if !name.trim().is_empty() {
                        header.listed_files.push(name.trim().to_owned());
                    }
                }
            }
            if last {
                header.end_bytes = lines.offset_bytes;
                return Ok(header);
            }
        }
        Err(FormatError::malformed(path, "the header does not end with ElementDataFile"))
    }

    /// A field's value.
    pub fn field(&self, name: &str) -> Option<&str> {
        self.fields.get(name).map(String::as_str)
    }

    /// The first of these fields that is there: its name and value.
    fn first<'a>(&'a self, names: &[&'a str]) -> Option<(&'a str, &'a str)> {
        names.iter().find_map(|name| Some((*name, self.field(name)?)))
    }

    /// The first of these fields that is there, as `count` numbers.
    pub fn numbers<T: FromStr>(&self, names: &[&str], count: usize) -> Result<Option<Vec<T>>, String> {
        let Some((name, value)) = self.first(names) else { return Ok(None) };
        let numbers: Result<Vec<T>, _> = value.split_whitespace().map(str::parse).collect();
        match numbers {
            Ok(numbers) if numbers.len() == count => Ok(Some(numbers)),
            _ => Err(format!("the field {name} is {}; it must be {count} fitting numbers", quoted(value))),
        }
    }

    /// The first of these fields that is there, as one number.
    pub fn number<T: FromStr>(&self, names: &[&str]) -> Result<Option<T>, String> {
        Ok(self.numbers(names, 1)?.and_then(|mut numbers| numbers.pop()))
    }

    /// The first of these fields that is there, as true or false.
    pub fn truth(&self, names: &[&str]) -> Result<Option<bool>, String> {
        let Some((name, value)) = self.first(names) else { return Ok(None) };
        match value.as_bytes().first() {
            Some(b'T' | b't' | b'1') => Ok(Some(true)),
            Some(b'F' | b'f' | b'0') => Ok(Some(false)),
            _ => Err(format!("the field {name} is {}; it must be True or False", quoted(value))),
        }
    }
}
