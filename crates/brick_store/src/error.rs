use std::io;
use std::path::PathBuf;

use glassbrick_volume::{ReadError, io_advice};

/// Why a source of bricks cannot be opened or read.
#[derive(Debug, thiserror::Error)]
pub enum SourceError {
    #[error("{}: cannot be read: {source}; {}", .path.display(), io_advice(.source))]
    Io { path: PathBuf, source: io::Error },
    #[error(
        "{}: the voxels need {needed} bytes from byte {offset} on, and the file has {len}; it was cut off",
        .path.display()
    )]
    TooShort { path: PathBuf, offset: u64, needed: u64, len: u64 },
    #[error("the array holds {len} bytes, and its extent and type need {needed}")]
    WrongArrayLength { needed: u64, len: u64 },
    #[error("the volume needs {needed} bytes of memory to be read whole, which this machine does not give")]
    OutOfMemory { needed: u64 },
    #[error("a volume needs at least one voxel on each axis")]
    NoVoxels,
    #[error(
        "bricks of {edge} voxels with a halo of {halo} are not possible: choose an edge from {least} to 512"
    )]
    BadLayout { edge: u32, halo: u32, least: u32 },
    #[error("the rescale slope {slope} and intercept {intercept} give no values; the slope must not be zero")]
    BadRescale { slope: f64, intercept: f64 },
    #[error(
        "{budget} bytes of memory for bricks are too few: {threads} threads need {needed} at least; give more memory or fewer threads"
    )]
    BudgetTooSmall { budget: u64, threads: usize, needed: u64 },
    #[error(transparent)]
    Read(#[from] ReadError),
}
