use std::io;
use std::path::PathBuf;

use glassbrick_brick_store::{SourceError, StoreError};
use glassbrick_formats::FormatError;
use glassbrick_gpu::GpuError;
use glassbrick_volume::ReadError;

/// Why glassbrick could not do what it was asked to. Each message is one line that names the file, says what is
/// wrong, and what to do.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A file of settings cannot be read.
    #[error("{}: cannot be read: {source}", .path.display())]
    Read { path: PathBuf, source: io::Error },
    /// A file of settings says what cannot be.
    #[error("{}: {what}", .path.display())]
    Settings { path: PathBuf, what: String },
    /// A picture cannot be written; what stood there before still stands.
    #[error("{}: cannot be written: {source}; check the folder's permissions and free space", .path.display())]
    Write { path: PathBuf, source: io::Error },
    /// A picture cannot be written there, or not in this form.
    #[error("{}: {what}", .path.display())]
    Output { path: PathBuf, what: String },
    /// The input is no volume that can be read.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The volume cannot be opened as a source of bricks.
    #[error(transparent)]
    Source(#[from] SourceError),
    /// A brick store cannot be made or read.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// Voxels cannot be read.
    #[error("{0}")]
    Voxels(#[from] ReadError),
    /// A volume that must be read whole is larger than memory.
    #[error(
        "{}: cannot be read in place, and reading it whole needs {needed_bytes} bytes of memory, of which {available_bytes} are free; make a store of it by glassbrick ingest, which needs little memory",
        .path.display()
    )]
    DoesNotFit { path: PathBuf, needed_bytes: u64, available_bytes: u64 },
    /// The camera, size or step cannot give a picture.
    #[error("{0}")]
    View(&'static str),
    /// A level that the volume does not have.
    #[error("level {level} does not exist: this volume has levels 0 to {last}")]
    Level { level: u32, last: u32 },
    /// The GPU cannot draw.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The threads cannot be started.
    #[error("the threads cannot be started: {what}; ask for fewer")]
    Threads { what: String },
}
