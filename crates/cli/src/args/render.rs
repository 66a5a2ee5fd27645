use std::path::PathBuf;

use clap::Args;
use glassbrick::{Background, LevelChoice};

use super::{BackendChoice, DrawingArgs, InputArgs, PassChoice, SkipChoice, ViewArgs, presets_help};
use crate::parse;

#[derive(Args, Clone, Debug)]
#[command(after_help = presets_help())]
pub struct RenderArgs {
    #[command(flatten)]
    pub input: InputArgs,
    /// The picture to write: .png or .exr, with --frames also .gif, .apng or .avi
    #[arg(short, long, value_name = "OUT")]
    pub output: PathBuf,
    /// Width and height in pixels
    #[arg(long, value_name = "WxH", default_value = "512x512", value_parser = parse::picture_size)]
    pub size: [u32; 2],
    /// The transfer function: a file, a preset, or auto, which makes one from the histogram
    #[arg(long, value_name = "FILE|PRESET|auto", default_value = "auto")]
    pub tf: String,
    #[command(flatten)]
    pub drawing: DrawingArgs,
    /// Drops bricks of which no more than this fraction lies in or below a band; 0 drops none
    #[arg(long, value_name = "FRACTION", default_value = "0", allow_negative_numbers = true, value_parser = parse::fraction)]
    pub alpha: f64,
    /// Drops bricks of which at least this fraction lies below a band; 1 drops none
    #[arg(long, value_name = "FRACTION", default_value = "1", allow_negative_numbers = true, value_parser = parse::fraction)]
    pub beta: f64,
    /// What draws
    #[arg(long, value_enum, default_value_t = BackendChoice::Auto)]
    pub backend: BackendChoice,
    /// How a GPU draws; raycast by default
    #[arg(long, value_enum)]
    pub pass: Option<PassChoice>,
    /// What may be left out without changing the picture
    #[arg(long, value_enum, default_value_t = SkipChoice::All)]
    pub skip: SkipChoice,
    /// Level of the volume to draw, 0 the finest; auto takes the coarsest whose voxels are no larger than a pixel
    #[arg(long, value_name = "auto|N", default_value = "auto", allow_negative_numbers = true, value_parser = parse::level)]
    pub level: LevelChoice,
    /// Leaves out bricks of a store that are damaged, and says so in the report
    #[arg(long)]
    pub allow_damaged: bool,
    /// What stands behind the picture: #rrggbb or transparent; black by default. EXR keeps its alpha
    #[arg(long, value_name = "COLOR", value_parser = parse::background)]
    pub background: Option<Background>,
    #[command(flatten)]
    pub view: ViewArgs,
    /// Writes the report there as JSON
    #[arg(long, value_name = "FILE")]
    pub report: Option<PathBuf>,
    /// Draws a turn around the volume in N views; OUT holds {frame} or is a .gif, .apng or .avi
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub frames: Option<u32>,
    /// Draws each picture N times, for measuring; the report gives the median and all times
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub repeat: u32,
}
