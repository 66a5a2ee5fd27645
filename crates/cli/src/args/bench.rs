use std::path::PathBuf;

use clap::Args;

use super::{DrawingArgs, ExecutorChoice, OpeningArgs, presets_help};
use crate::parse;

const COMPARING: &str = "Comparing";

#[derive(Args, Clone, Debug)]
#[command(after_help = presets_help())]
pub struct BenchArgs {
    /// Brick stores, volume files or folders of slices; bodies of 512x512x426, 512x512x512 and 512x304x1730 voxels, which
    /// are generated, where nothing is named
    #[arg(value_name = "INPUT")]
    pub inputs: Vec<PathBuf>,
    #[command(flatten)]
    pub opening: OpeningArgs,
    /// The folder for bench.json, bench.csv, report.html, plots and pictures; it is made where there is none
    #[arg(short, long, value_name = "DIR", required_unless_present = "compare")]
    pub output: Option<PathBuf>,
    /// A generated body of so many voxels, beside or in place of inputs; may be given several times
    #[arg(long, value_name = "NXxNYxNZ", value_parser = parse::extent)]
    pub phantom: Vec<[u32; 3]>,
    /// Bodies of a quarter of the size, smaller pictures, fewer views and repeats
    #[arg(long)]
    pub quick: bool,
    /// A transfer function: a file, a preset or auto; may be given several times. Where nothing is said, CTs are drawn with
    /// ct-bone, ct-skin and haze, others with auto, mr and grey, and projections with auto
    #[arg(long, value_name = "FILE|PRESET|auto")]
    pub tf: Vec<String>,
    #[command(flatten)]
    pub drawing: DrawingArgs,
    /// What draws, with commas between; everything by default
    #[arg(long, value_enum, value_delimiter = ',', value_name = "EXECUTOR,…")]
    pub executors: Vec<ExecutorChoice>,
    /// Width and height in pixels; 512x512, with --quick 256x256
    #[arg(long, value_name = "WxH", value_parser = parse::picture_size)]
    pub size: Option<[u32; 2]>,
    /// Views of the turntable; 8, with --quick 4. Three of a fly-in and one from inside are added
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=360))]
    pub views: Option<u32>,
    /// How often each picture is drawn for its times, at most; 5, with --quick 3
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub repeat: Option<u32>,
    /// Compares two earlier benchmarks and measures nothing; exits with 1 where the second is worse
    #[arg(
        long, num_args = 2, value_names = ["OLD.json", "NEW.json"], conflicts_with_all = ["inputs", "output", "phantom"],
        help_heading = COMPARING
    )]
    pub compare: Option<Vec<PathBuf>>,
    /// How much worse is not worse yet, as a share such as 0.05 or 5%; 10% by default
    #[arg(
        long, value_name = "SHARE", allow_negative_numbers = true, value_parser = parse::share, help_heading = COMPARING
    )]
    pub tolerance: Option<f64>,
    /// Does one task of a benchmark, for the process that started this one
    #[arg(long, hide = true, requires = "scratch")]
    pub task: Option<usize>,
    /// That process's folder for files that are not kept
    #[arg(long, hide = true)]
    pub scratch: Option<PathBuf>,
}
