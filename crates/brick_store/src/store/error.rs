use std::io;
use std::path::{Path, PathBuf};

use glassbrick_volume::{ReadError, io_advice};

/// Why a brick store cannot be written or read.
#[derive(Debug, thiserror::Error)]
pub enum StoreError {
    #[error("{}: cannot be read: {source}; {}", .path.display(), io_advice(.source))]
    Read { path: PathBuf, source: io::Error },
    #[error(
        "{}: cannot be written: {source}; check the folder's permissions and free space",
        .path.display()
    )]
    Write { path: PathBuf, source: io::Error },
    #[error("{}: is no brick store: {what}", .path.display())]
    NotAStore { path: PathBuf, what: String },
    #[error(
        "{}: is a brick store of format version {version}, which this version of glassbrick cannot read; use a later one",
        .path.display()
    )]
    Version { path: PathBuf, version: u64 },
    #[error("{}: {what}; make the store again from its volume", .path.display())]
    Damaged { path: PathBuf, what: String },
    #[error(
        "{brick} is damaged: {} {what}; make the store again from its volume, or draw without the brick by --allow-damaged",
        .path.display()
    )]
    DamagedBrick { brick: String, path: PathBuf, what: String },
    #[error("{}: was replaced while it was being read; open it again", .path.display())]
    Replaced { path: PathBuf },
    #[error("{}: is there already; give --force to replace it, or another name", .path.display())]
    Exists { path: PathBuf },
    #[error("{}: {what}", .path.display())]
    Target { path: PathBuf, what: &'static str },
    #[error("{}: another ingest is writing it; wait for it to end", .path.display())]
    Busy { path: PathBuf },
    #[error(
        "{}: the run that was stopped had another input or other options; leave out --resume to begin anew",
        .path.display()
    )]
    OtherRun { path: PathBuf },
    #[error("a volume cannot be stored so: {what}")]
    Unstorable { what: String },
    #[error("{0}")]
    Input(ReadError),
}

impl StoreError {
    /// A file that cannot be read; one that is not there is damage, for each file of a store must be.
    pub fn reading(path: &Path, source: io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            io::ErrorKind::NotFound => Self::Damaged { path, what: "is missing".to_owned() },
            io::ErrorKind::UnexpectedEof => Self::Damaged { path, what: "was cut off".to_owned() },
            _ => Self::Read { path, source },
        }
    }
}
