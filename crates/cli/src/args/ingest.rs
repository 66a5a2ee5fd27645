use std::path::PathBuf;

use clap::Args;

use super::{CodecChoice, InputArgs};

#[derive(Args, Clone, Debug)]
pub struct IngestArgs {
    #[command(flatten)]
    pub input: InputArgs,
    /// The store to make, a folder: NAME.zarr
    #[arg(short, long, value_name = "STORE")]
    pub output: PathBuf,
    /// How bricks are compressed: zstd is smallest, lz4 is read fastest, none is written fastest
    #[arg(long, value_enum, default_value_t = CodecChoice::Zstd)]
    pub codec: CodecChoice,
    /// Voxels on each side of a brick that repeat its neighbours'
    #[arg(long, value_name = "VOXELS", default_value_t = 2, value_parser = clap::value_parser!(u32).range(2..=64))]
    pub halo: u32,
    /// Replaces a store that is there already, once the new one is whole
    #[arg(long)]
    pub force: bool,
    /// Goes on where a run of the same was stopped, and keeps what is done if this one fails
    #[arg(long)]
    pub resume: bool,
}
