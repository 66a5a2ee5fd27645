//! The bytes of a DICOM file, read once from front to back, whether stored plainly or deflated.

use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};

use flate2::bufread::DeflateDecoder;

/// What is wrong with a file: a sentence without the file's name.
pub(super) type Parsed<T> = Result<T, String>;

/// Most headers fit, so that one read is enough for a file.
const BUFFER_BYTES: usize = 16 * 1024;

/// No file inflates to more: the length of its voxels is a number of 32 bits.
const MAX_INFLATED_BYTES: u64 = 5 << 30;

/// A front-to-back reader that knows where it is and how much there is.
pub(super) struct ByteStream {
    source: Source,
    position: u64,
    /// Where the file ends; the most that deflated bytes may become.
    end: u64,
}

enum Source {
    Plain(BufReader<File>),
    Deflated(BufReader<DeflateDecoder<BufReader<File>>>),
}

impl ByteStream {
    pub(super) fn new(file: File, file_bytes: u64) -> Self {
        let source = Source::Plain(BufReader::with_capacity(BUFFER_BYTES, file));
        Self { source, position: 0, end: file_bytes }
    }

    /// What follows from here is deflated; positions count the inflated bytes from 0.
    pub(super) fn inflate(self) -> Self {
        let source = match self.source {
            Source::Plain(file) => {
                Source::Deflated(BufReader::with_capacity(BUFFER_BYTES, DeflateDecoder::new(file)))
            }
            deflated @ Source::Deflated(_) => deflated,
        };
        Self { source, position: 0, end: MAX_INFLATED_BYTES }
    }

    pub(super) fn position(&self) -> u64 {
        self.position
    }

    /// How many bytes of the file it took to come here, from where they are deflated if they are.
    pub(super) fn encoded_position(&self) -> u64 {
        match &self.source {
            Source::Plain(_) => self.position,
            Source::Deflated(inflated) => inflated.get_ref().total_in(),
        }
    }

    pub(super) fn at_end(&mut self) -> Parsed<bool> {
        Ok(self.peek()?.is_empty())
    }

    /// Some of the bytes that come next; none only at the end.
    pub(super) fn peek(&mut self) -> Parsed<&[u8]> {
        match &mut self.source {
            Source::Plain(file) => file.fill_buf(),
            Source::Deflated(inflated) => inflated.fill_buf(),
        }
        .map_err(|error| format!("cannot be read: {error}"))
    }

    pub(super) fn read(&mut self, out: &mut [u8]) -> Parsed<()> {
        self.reader().read_exact(out).map_err(|error| self.failure(&error))?;
        self.position += out.len() as u64;
        Ok(())
    }

    /// The next `bytes` bytes, which take memory only as far as they exist.
    pub(super) fn take(&mut self, bytes: u64) -> Parsed<Vec<u8>> {
        self.check(bytes)?;
        let mut taken = Vec::new();
        let read = self.reader().take(bytes).read_to_end(&mut taken);
        let read = read.map_err(|error| self.failure(&error))?;
        if read as u64 != bytes {
            return Err(self.cut_off());
        }
        self.position += bytes;
        Ok(taken)
    }

    pub(super) fn skip(&mut self, bytes: u64) -> Parsed<()> {
        self.check(bytes)?;
        let skipped = match &mut self.source {
            Source::Plain(file) => {
                let bytes = i64::try_from(bytes).map_err(|_| "claims more bytes than a file can have")?;
                file.seek_relative(bytes)
            }
            Source::Deflated(inflated) => match io::copy(&mut inflated.take(bytes), &mut io::sink()) {
                Ok(copied) if copied < bytes => Err(io::ErrorKind::UnexpectedEof.into()),
                copied => copied.map(drop),
            },
        };
        skipped.map_err(|error| self.failure(&error))?;
        self.position += bytes;
        Ok(())
    }

    /// Goes back to where `position` was; only as far as a small read went.
    pub(super) fn rewind(&mut self, position: u64) -> Parsed<()> {
        let back = i64::try_from(self.position - position).map_err(|_| "cannot be read backwards")?;
        match &mut self.source {
            Source::Plain(file) => file.seek_relative(-back).map_err(|error| error.to_string())?,
            Source::Deflated(_) => return Err("cannot be read backwards".to_owned()),
        }
        self.position = position;
        Ok(())
    }

    fn check(&self, bytes: u64) -> Parsed<()> {
        if bytes > self.end.saturating_sub(self.position) { Err(self.cut_off()) } else { Ok(()) }
    }

    fn reader(&mut self) -> &mut dyn Read {
        match &mut self.source {
            Source::Plain(file) => file,
            Source::Deflated(inflated) => inflated,
        }
    }

    fn failure(&self, error: &io::Error) -> String {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => self.cut_off(),
            _ => format!("cannot be read: {error}"),
        }
    }

    fn cut_off(&self) -> String {
        format!("a data element at byte {} reaches beyond the end of the file; fetch it again", self.position)
    }
}
