//! The kept data elements of a file, as a tree.

use super::element::Encoding;
use super::tag::Tag;

/// Data elements of one level.
#[derive(Clone, Debug, Default)]
pub(super) struct DataSet {
    elements: Vec<(Tag, Value)>,
}

/// What an element holds.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Text(String),
    Numbers(Vec<f64>),
    Items(Vec<DataSet>),
}

impl DataSet {
    /// The first value as text, without padding; nothing where it is empty.
    pub(super) fn text(&self, tag: Tag) -> Option<&str> {
        match self.find(tag)? {
            Value::Text(text) => Some(text.as_str()).filter(|text| !text.is_empty()),
            _ => None,
        }
    }

    /// All values as numbers; nothing where one of them is not a finite number.
    pub(super) fn numbers(&self, tag: Tag) -> Option<Vec<f64>> {
        let numbers: Vec<f64> = match self.find(tag)? {
            Value::Numbers(numbers) => numbers.clone(),
            Value::Text(text) => {
                text.split('\\').map(|number| number.trim().parse().ok()).collect::<Option<_>>()?
            }
            Value::Items(_) => return None,
        };
        (!numbers.is_empty() && numbers.iter().all(|number| number.is_finite())).then_some(numbers)
    }

    /// The first value as a number.
    pub(super) fn number(&self, tag: Tag) -> Option<f64> {
        self.numbers(tag).map(|numbers| numbers[0])
    }

    /// The first value as a whole number that fits.
    pub(super) fn whole(&self, tag: Tag) -> Option<u32> {
        let number = self.number(tag)?;
        (number.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&number)).then_some(number as u32)
    }

    /// The items of a sequence; none where there is no such sequence.
    pub(super) fn items(&self, tag: Tag) -> &[DataSet] {
        match self.find(tag) {
            Some(Value::Items(items)) => items,
            _ => &[],
        }
    }

    pub(super) fn has(&self, tag: Tag) -> bool {
        self.find(tag).is_some()
    }

    /// Adds an element; of several with one tag the first holds.
    pub(super) fn add(&mut self, tag: Tag, value: Value) {
        if !self.has(tag) {
            self.elements.push((tag, value));
        }
    }

    fn find(&self, tag: Tag) -> Option<&Value> {
        self.elements.iter().find(|(kept, _)| *kept == tag).map(|(_, value)| value)
    }
}

impl Value {
    /// Makes sense of the bytes of an element of this value representation; whatever is no number is text.
    pub(super) fn decode(vr: [u8; 2], bytes: &[u8], encoding: Encoding) -> Self {
        let numbers = |size: usize, number: fn(u64) -> f64| {
            let chunks = bytes.chunks_exact(size);
            Self::Numbers(chunks.map(|chunk| number(bits(chunk, encoding.big_endian))).collect())
        };
        match &vr {
            b"US" => numbers(2, |bits| bits as f64),
            b"SS" => numbers(2, |bits| f64::from(bits as u16 as i16)),
            b"UL" | b"OL" => numbers(4, |bits| bits as f64),
            b"SL" => numbers(4, |bits| f64::from(bits as u32 as i32)),
            b"UV" | b"OV" => numbers(8, |bits| bits as f64),
            b"SV" => numbers(8, |bits| bits as i64 as f64),
            b"FL" | b"OF" => numbers(4, |bits| f64::from(f32::from_bits(bits as u32))),
            b"FD" | b"OD" => numbers(8, f64::from_bits),
            _ => {
                let padding = |character: char| character == '\0' || character.is_whitespace();
                Self::Text(String::from_utf8_lossy(bytes).trim_matches(padding).to_owned())
            }
        }
    }
}

fn bits(bytes: &[u8], big_endian: bool) -> u64 {
    let append = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
    if big_endian { bytes.iter().fold(0, append) } else { bytes.iter().rev().fold(0, append) }
}
