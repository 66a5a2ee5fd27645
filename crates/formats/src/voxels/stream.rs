use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::vec;

use bzip2::bufread::MultiBzDecoder;
use flate2::bufread::{MultiGzDecoder, ZlibDecoder};
use glassbrick_volume::StoredType;

use super::counted_file::CountedFile;
use super::part::{Encoding, Part};
use super::text::{HexBytes, TextVoxels};
use crate::FormatError;

const BUFFER_BYTES: usize = 256 << 10;
/// So much may always follow the voxels in a stream and be read to find its sum.
const HARMLESS_REST_BYTES: u64 = 1 << 20;

/// The decoded voxels of settled parts, one after the other. One file is open at a time.
pub(crate) struct PartStream {
    parts: vec::IntoIter<Part>,
    encoding: Encoding,
    stored_type: StoredType,
    current: Option<OpenPart>,
    bytes_read: Arc<AtomicU64>,
}

struct OpenPart {
    part: Part,
    decoded: Box<dyn BufRead + Send>,
    bytes_left: u64,
}

impl PartStream {
    pub fn new(parts: Vec<Part>, encoding: Encoding, stored_type: StoredType) -> Self {
        Self { parts: parts.into_iter(), encoding, stored_type, current: None, bytes_read: Arc::default() }
    }

    /// Bytes read from the files so far, before decoding.
    pub fn bytes_read(&self) -> u64 {
        self.bytes_read.load(Ordering::Relaxed)
    }

    /// Some of the next voxels, at least one byte.
    ///
    /// # Errors
    /// When there are no more, or they are damaged.
    pub fn buffer(&mut self) -> Result<&[u8], FormatError> {
        if self.current.as_ref().is_none_or(|current| current.bytes_left == 0) {
            self.check_end()?;
            self.current = Some(self.open_next()?);
        }
        let current = self.current.as_mut().expect("a part was opened above");
        current.fill(self.encoding)
    }

    /// Passes over so many bytes of what `buffer` gave.
    pub fn consume(&mut self, bytes: usize) {
        if let Some(current) = &mut self.current {
            current.decoded.consume(bytes);
            current.bytes_left -= bytes as u64;
        }
    }

    /// Checks the sum that may follow the last voxel of a part; to be called at the end of what is read.
    ///
    /// The sum stands where the stream ends, so the rest is read on to there, unless it is long.
    ///
    /// # Errors
    /// When the voxels read are not those that were written.
    pub fn check_end(&mut self) -> Result<(), FormatError> {
        match self.current.take() {
            Some(current) if matches!(self.encoding, Encoding::Deflate | Encoding::Bzip2) => {
                current.check_rest(self.encoding)
            }
            _ => Ok(()),
        }
    }

    fn open_next(&mut self) -> Result<OpenPart, FormatError> {
        let Some(part) = self.parts.next() else {
            unreachable!("the parts hold all bytes of the volume, and no more are asked for");
        };
        let mut decoded = self.decode(&part).map_err(|error| read_error(&part, self.encoding, 0, error))?;
        skip(&mut decoded, part.skip_decoded).map_err(|error| read_error(&part, self.encoding, 0, error))?;
        let bytes_left = part.bytes;
        Ok(OpenPart { part, decoded, bytes_left })
    }

    fn decode(&self, part: &Part) -> io::Result<Box<dyn BufRead + Send>> {
        let mut file = File::open(&part.path)?;
        file.seek(SeekFrom::Start(part.offset_bytes()))?;
        let file = CountedFile { file, bytes_read: Arc::clone(&self.bytes_read) };
        let mut file = BufReader::with_capacity(BUFFER_BYTES, file);
        fn buffered(decoder: impl Read + Send + 'static) -> Box<dyn BufRead + Send> {
            Box::new(BufReader::with_capacity(BUFFER_BYTES, decoder))
        }
        Ok(match self.encoding {
            Encoding::Raw => Box::new(file),
            Encoding::Deflate => match file.fill_buf()? {
                [0x1f, 0x8b, ..] => buffered(MultiGzDecoder::new(file)),
                _ => buffered(ZlibDecoder::new(file)),
            },
            Encoding::Bzip2 => buffered(MultiBzDecoder::new(file)),
            Encoding::Text => buffered(TextVoxels::new(file, self.stored_type)),
            Encoding::Hex => buffered(HexBytes::new(file)),
        })
    }
}

impl OpenPart {
    fn fill(&mut self, encoding: Encoding) -> Result<&[u8], FormatError> {
        let found = self.part.bytes - self.bytes_left;
        let failed = |error| read_error(&self.part, encoding, found, error);
        let wanted = usize::try_from(self.bytes_left).unwrap_or(usize::MAX);
        loop {
            match self.decoded.fill_buf() {
                Ok([]) => return Err(failed(io::ErrorKind::UnexpectedEof.into())),
                Ok(_) => break,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(failed(error)),
            }
        }
        // This gives the same bytes again; borrowing them above would hold `self` through the loop.
        let bytes = self.decoded.fill_buf().map_err(failed)?;
        Ok(&bytes[..bytes.len().min(wanted)])
    }

    /// Reads what follows the voxels to the end of the stream, but not more than as much again as was read.
    fn check_rest(mut self, encoding: Encoding) -> Result<(), FormatError> {
        let found = self.part.bytes - self.bytes_left;
        let most = found.saturating_add(self.part.skip_decoded).saturating_add(HARMLESS_REST_BYTES);
        let mut rest: u64 = 0;
        while rest < most {
            let bytes = match self.decoded.fill_buf() {
                Ok([]) => break,
                Ok(buffer) => buffer.len(),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                    return self.check_break_off(encoding, rest);
                }
                // What follows the stream, such as padding, has no header of a stream and does not matter.
                Err(error) if error.to_string().contains("header") => break,
                Err(error) => {
                    let found = found.saturating_add(rest).min(self.part.bytes);
                    return Err(read_error(&self.part, encoding, found, error));
                }
            };
            self.decoded.consume(bytes);
            rest += bytes as u64;
        }
        Ok(())
    }

    /// Judges a stream without an end: it may lack its sum, or voxels of a step that was not asked for, but
    /// where it holds more than was ever claimed, it is not what was written.
    fn check_break_off(&self, encoding: Encoding, rest: u64) -> Result<(), FormatError> {
        if rest <= self.bytes_left {
            return Ok(());
        }
        let what = format!(
            "the {} data goes on for {} bytes after the last voxel, and breaks off there; it is damaged, get it \
             anew",
            encoding.name(),
            rest - self.bytes_left
        );
        Err(FormatError::malformed(&self.part.path, what))
    }
}

fn skip(decoded: &mut dyn BufRead, bytes: u64) -> io::Result<()> {
    let skipped = io::copy(&mut decoded.take(bytes), &mut io::sink())?;
    if skipped < bytes { Err(io::ErrorKind::UnexpectedEof.into()) } else { Ok(()) }
}

fn read_error(part: &Part, encoding: Encoding, found: u64, error: io::Error) -> FormatError {
    let expected = part.bytes;
    match error.kind() {
        io::ErrorKind::UnexpectedEof => FormatError::malformed(
            &part.path,
            format!("the voxels end after {found} of {expected} bytes; the file is cut short, get it anew"),
        ),
        io::ErrorKind::InvalidData | io::ErrorKind::InvalidInput => FormatError::malformed(
            &part.path,
            format!("the {} data is damaged after {found} of {expected} bytes: {error}", encoding.name()),
        ),
        _ if encoding == Encoding::Bzip2 => FormatError::malformed(
            &part.path,
            format!("the bzip2 data is damaged after {found} of {expected} bytes: {error}"),
        ),
        _ => FormatError::io(&part.path, error),
    }
}
