use std::io;
use std::path::PathBuf;

use glassbrick_volume::ReadError;
use thiserror::Error;

/// What ends a benchmark, or one executor's part of it.
#[derive(Debug, Error)]
pub enum BenchError {
    #[error(transparent)]
    Render(#[from] glassbrick::Error),
    #[error(transparent)]
    Read(#[from] ReadError),
    #[error("{0}")]
    View(&'static str),
    #[error(
        "the whole volume, {needed_bytes} bytes in one array, does not fit into the {available_bytes} bytes of memory that are free"
    )]
    NoRoomForTheWhole { needed_bytes: u64, available_bytes: u64 },
    #[error("threads cannot be started: {0}")]
    Threads(#[from] rayon::ThreadPoolBuildError),
    #[error("{}: cannot be written: {source}; check the folder's permissions and free space", path.display())]
    File { path: PathBuf, source: io::Error },
    #[error("{}: cannot be read: {source}", path.display())]
    Unreadable { path: PathBuf, source: io::Error },
    #[error("{}: is no benchmark of glassbrick: {what}", path.display())]
    NotABenchmark { path: PathBuf, what: String },
}
