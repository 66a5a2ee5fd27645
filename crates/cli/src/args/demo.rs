use std::path::PathBuf;

use clap::Args;

use super::DemoSize;

#[derive(Args, Clone, Debug)]
pub struct DemoArgs {
    /// The folder to write to; it is made where there is none
    #[arg(short, long, value_name = "DIR", default_value = "glassbrick-demo")]
    pub output: PathBuf,
    /// How large a body to make
    #[arg(long, value_enum, default_value_t = DemoSize::Small)]
    pub size: DemoSize,
}
