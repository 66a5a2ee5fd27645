use std::io;
use std::path::{Path, PathBuf};

use glassbrick_volume::io_advice;

/// Why a file cannot be opened or read as a volume. Each message names the file, says what is wrong, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum FormatError {
    #[error("{}: cannot be read: {source}; {}", .path.display(), io_advice(.source))]
    Io { path: PathBuf, source: io::Error },
    /// The file contradicts itself or its format.
    #[error("{}: {what}", .path.display())]
    Malformed { path: PathBuf, what: String },
    /// The file is sound, but holds what glassbrick does not read.
    #[error("{}: {what}", .path.display())]
    Unsupported { path: PathBuf, what: String },
    /// The file or folder is of no format that glassbrick reads.
    #[error("{}: {what}", .path.display())]
    Unknown { path: PathBuf, what: String },
}

impl FormatError {
    pub(crate) fn io(path: &Path, source: io::Error) -> Self {
        Self::Io { path: path.to_owned(), source }
    }

    pub(crate) fn malformed(path: &Path, what: impl Into<String>) -> Self {
        Self::Malformed { path: path.to_owned(), what: what.into() }
    }

    pub(crate) fn unsupported(path: &Path, what: impl Into<String>) -> Self {
        Self::Unsupported { path: path.to_owned(), what: what.into() }
    }

    pub(crate) fn unknown(path: &Path, what: impl Into<String>) -> Self {
        Self::Unknown { path: path.to_owned(), what: what.into() }
    }
}
