use std::path::PathBuf;

use clap::Args;

#[derive(Args, Clone, Debug)]
pub struct VerifyArgs {
    /// The brick store to check
    #[arg(value_name = "STORE")]
    pub store: PathBuf,
    /// Threads to work with; as many as there are processors by default
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub threads: Option<u32>,
}
