use clap::Args;

use super::{ModeChoice, ShadingChoice};
use crate::parse;

/// What a picture is, and the memory that it may take, whatever draws it.
#[derive(Args, Clone, Debug)]
pub struct DrawingArgs {
    /// What a ray makes of the values that it meets
    #[arg(long, value_enum, default_value_t = ModeChoice::Dvr)]
    pub mode: ModeChoice,
    /// Light on surfaces, in mode dvr
    #[arg(long, value_enum, default_value_t = ShadingChoice::Off)]
    pub shading: ShadingChoice,
    /// Distance of samples, in voxels of the smallest spacing
    #[arg(long, value_name = "VOXELS", default_value = "1.0", allow_negative_numbers = true, value_parser = parse::positive)]
    pub step: f64,
    /// Opacity at which a ray stops; 1 never stops
    #[arg(
        long, value_name = "OPACITY", default_value = "0.998", allow_negative_numbers = true,
        value_parser = parse::opacity_cutoff
    )]
    pub opacity_cutoff: f64,
    /// Memory for decoded bricks, with KB, MB, GB, KiB, MiB or GiB; a quarter of the machine's by default
    #[arg(long, value_name = "BYTES", allow_negative_numbers = true, value_parser = parse::bytes)]
    pub memory: Option<u64>,
    /// Memory of a GPU for bricks, with KB, MB, GB, KiB, MiB or GiB; 512MiB by default
    #[arg(long, value_name = "BYTES", allow_negative_numbers = true, value_parser = parse::bytes)]
    pub gpu_memory: Option<u64>,
}
