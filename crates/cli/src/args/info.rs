use clap::Args;

use super::{InputArgs, presets_help};

#[derive(Args, Clone, Debug)]
#[command(after_help = presets_help())]
pub struct InfoArgs {
    #[command(flatten)]
    pub input: InputArgs,
    /// Prints one JSON object
    #[arg(long)]
    pub json: bool,
    /// A transfer function, of which to tell what it needs: a file, a preset, or auto
    #[arg(long, value_name = "FILE|PRESET|auto")]
    pub tf: Option<String>,
}
