use std::path::PathBuf;

use clap::Args;
use glassbrick::StoredType;

use super::EndianChoice;
use crate::parse;

/// Which volume, and how it is opened.
#[derive(Args, Clone, Debug)]
pub struct InputArgs {
    /// A brick store, a volume file (NRRD, MetaImage, NIfTI, DICOM, raw) or a folder of DICOM slices
    #[arg(value_name = "INPUT")]
    pub path: PathBuf,
    #[command(flatten)]
    pub opening: OpeningArgs,
}

/// How a volume is opened, whichever it is.
#[derive(Args, Clone, Debug)]
pub struct OpeningArgs {
    /// The time step to read where there are several, from 0
    #[arg(long, value_name = "N")]
    pub time: Option<u32>,
    /// Voxels along an edge of a brick, halo included; a store keeps its own
    #[arg(long, value_name = "VOXELS", default_value_t = 64, value_parser = clap::value_parser!(u32).range(8..=512))]
    pub brick: u32,
    /// Threads to work with; as many as there are processors by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
    #[command(flatten)]
    pub raw: RawArgs,
}

/// What a raw file does not say of itself.
#[derive(Args, Clone, Debug)]
pub struct RawArgs {
    /// Voxels along x (fastest in the file), y and z; reads the input as raw voxels
    #[arg(long, value_name = "NXxNYxNZ", requires = "dtype", value_parser = parse::extent, help_heading = "Raw input")]
    pub extent: Option<[u32; 3]>,
    /// Type of a voxel: u8, i8, u16, i16, u32, i32, f32 or f64
    #[arg(long, value_name = "TYPE", requires = "extent", value_parser = parse::dtype, help_heading = "Raw input")]
    pub dtype: Option<StoredType>,
    /// Byte order
    #[arg(long, value_enum, default_value_t = EndianChoice::Little, requires = "extent", help_heading = "Raw input")]
    pub endian: EndianChoice,
    /// Distance of voxel centres in mm
    #[arg(
        long, value_name = "X,Y,Z", default_value = "1,1,1", requires = "extent", allow_hyphen_values = true,
        value_parser = parse::spacing, help_heading = "Raw input"
    )]
    pub spacing: [f64; 3],
    /// Where the first voxel stands in the file
    #[arg(
        long, value_name = "BYTES", default_value = "0", requires = "extent", allow_negative_numbers = true,
        value_parser = parse::bytes, help_heading = "Raw input"
    )]
    pub offset: u64,
    /// Slope and intercept: value = slope * stored + intercept
    #[arg(
        long, value_name = "SLOPE,INTERCEPT", default_value = "1,0", requires = "extent", allow_hyphen_values = true,
        value_parser = parse::rescale, help_heading = "Raw input"
    )]
    pub rescale: [f64; 2],
}
