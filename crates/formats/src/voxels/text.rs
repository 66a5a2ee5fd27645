//! Voxels in words: decimal numbers and hexadecimal bytes.

use std::io::{self, BufRead, Read};

use glassbrick_volume::StoredType;

/// Characters of the longest number that is read. An f64 in decimal may have over 300 digits.
const LONGEST_NUMBER: usize = 1024;

/// Decimal numbers, apart by white space or commas, as bytes of the stored type in this machine's order.
pub(crate) struct TextVoxels<R> {
    text: R,
    stored_type: StoredType,
    /// The number being given, and how many of its bytes remain.
    voxel: [u8; 8],
    bytes_left: usize,
    numbers: u64,
}

impl<R: BufRead> TextVoxels<R> {
    pub fn new(text: R, stored_type: StoredType) -> Self {
        Self { text, stored_type, voxel: [0; 8], bytes_left: 0, numbers: 0 }
    }

    /// Reads the next number into `voxel`; false at the end of the text.
    fn next_number(&mut self) -> io::Result<bool> {
        let mut word = Vec::new();
        loop {
            let buffer = self.text.fill_buf()?;
            let Some(&byte) = buffer.first() else { break };
            self.text.consume(1);
            if !byte.is_ascii_whitespace() && byte != b',' {
                word.push(byte);
            } else if !word.is_empty() {
                break;
            }
            if word.len() > LONGEST_NUMBER {
                return Err(invalid(format!("voxel {} has over {LONGEST_NUMBER} digits", self.numbers)));
            }
        }
        if word.is_empty() {
            return Ok(false);
        }
        self.numbers += 1;
        self.voxel = std::str::from_utf8(&word)
            .ok()
            .and_then(|word| voxel_bytes(word, self.stored_type))
            .ok_or_else(|| {
                let shown = crate::header_text::quoted(&String::from_utf8_lossy(&word));
                invalid(format!("voxel {} is {shown}, which is no {}", self.numbers - 1, self.stored_type))
            })?;
        self.bytes_left = self.stored_type.bytes();
        Ok(true)
    }
}

impl<R: BufRead> Read for TextVoxels<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let mut filled = 0;
        while filled < out.len() {
            if self.bytes_left == 0 && !self.next_number()? {
                break;
            }
            let size = self.stored_type.bytes();
            let rest = &self.voxel[size - self.bytes_left..size];
            let count = rest.len().min(out.len() - filled);
            out[filled..filled + count].copy_from_slice(&rest[..count]);
            self.bytes_left -= count;
            filled += count;
        }
        Ok(filled)
    }
}

/// A word as a voxel, if it is a number that the type can hold.
fn voxel_bytes(word: &str, stored_type: StoredType) -> Option<[u8; 8]> {
    let mut voxel = [0; 8];
    let mut put = |bytes: &[u8]| voxel[..bytes.len()].copy_from_slice(bytes);
    match stored_type {
        StoredType::U8 => put(&whole::<u8>(word)?.to_ne_bytes()),
        StoredType::I8 => put(&whole::<i8>(word)?.to_ne_bytes()),
        StoredType::U16 => put(&whole::<u16>(word)?.to_ne_bytes()),
        StoredType::I16 => put(&whole::<i16>(word)?.to_ne_bytes()),
        StoredType::U32 => put(&whole::<u32>(word)?.to_ne_bytes()),
        StoredType::I32 => put(&whole::<i32>(word)?.to_ne_bytes()),
        StoredType::F32 => put(&word.parse::<f32>().ok()?.to_ne_bytes()),
        StoredType::F64 => put(&word.parse::<f64>().ok()?.to_ne_bytes()),
    }
    Some(voxel)
}

/// A whole number, also where it is written like `12.0` or `1e3`.
fn whole<T: TryFrom<i64>>(word: &str) -> Option<T> {
    let number = match word.parse::<i64>() {
        Ok(number) => number,
        Err(_) => {
            let number = word.parse::<f64>().ok()?;
            (number.fract() == 0.0 && number.abs() < 1e15).then_some(number as i64)?
        }
    };
    T::try_from(number).ok()
}

/// Pairs of hexadecimal digits as bytes; white space does not count.
pub(crate) struct HexBytes<R> {
    text: R,
}

impl<R: BufRead> HexBytes<R> {
    pub fn new(text: R) -> Self {
        Self { text }
    }

    fn next_digit(&mut self) -> io::Result<Option<u8>> {
        loop {
            let Some(&byte) = self.text.fill_buf()?.first() else { return Ok(None) };
            self.text.consume(1);
            if byte.is_ascii_whitespace() {
                continue;
            }
            return match char::from(byte).to_digit(16) {
                Some(digit) => Ok(Some(digit as u8)),
                None => Err(invalid(format!("{:?} is no hexadecimal digit", char::from(byte)))),
            };
        }
    }
}

impl<R: BufRead> Read for HexBytes<R> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        for (filled, byte) in out.iter_mut().enumerate() {
            let (Some(high), Some(low)) = (self.next_digit()?, self.next_digit()?) else {
                return Ok(filled);
            };
            *byte = high << 4 | low;
        }
        Ok(out.len())
    }
}

fn invalid(what: String) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str, stored_type: StoredType) -> io::Result<Vec<u8>> {
        let mut bytes = Vec::new();
        TextVoxels::new(text.as_bytes(), stored_type).read_to_end(&mut bytes)?;
        Ok(bytes)
    }

    #[test]
    fn numbers_become_voxels() {
        let expected: Vec<u8> = [1i16, -2, 300].iter().flat_map(|v| v.to_ne_bytes()).collect();
        assert_eq!(read(" 1,-2\r\n3e2", StoredType::I16).unwrap(), expected);
        assert_eq!(read("1.5 nan", StoredType::F64).unwrap().len(), 16);
        assert!(read("", StoredType::U8).unwrap().is_empty());
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        for word in ["256", "-1", "1.5", "x", "0x10", "1e300"] {
            let error = read(&format!("1 {word}"), StoredType::U8).unwrap_err().to_string();
            assert!(error.contains("voxel 1 is") && error.contains("no u8"), "{error}");
        }
        assert!(read(&"1".repeat(1 << 20), StoredType::F32).unwrap_err().to_string().len() < 200);
    }

    #[test]
    fn hexadecimal_digits_become_bytes() {
        let mut bytes = Vec::new();
        HexBytes::new("0aF f\n10 7".as_bytes()).read_to_end(&mut bytes).unwrap();
        assert_eq!(bytes, [0x0a, 0xff, 0x10]);
        assert!(HexBytes::new("0g".as_bytes()).read(&mut [0]).is_err());
    }
}
