//! What was typed: flags and their values one by one, in clap's terms. What they mean together is in [`job`](crate::job).

mod bench;
mod choices;
mod demo;
mod drawing;
mod info;
mod ingest;
mod input;
mod render;
mod verify;
mod view;

use clap::{Parser, Subcommand};

pub use bench::BenchArgs;
pub use choices::{
    BackendChoice, CodecChoice, DemoSize, EndianChoice, ExecutorChoice, ModeChoice, PassChoice,
    ShadingChoice, SkipChoice, ViewChoice,
};
pub use demo::DemoArgs;
pub use drawing::DrawingArgs;
pub use info::InfoArgs;
pub use ingest::IngestArgs;
pub use input::{InputArgs, OpeningArgs, RawArgs};
pub use render::RenderArgs;
pub use verify::VerifyArgs;
pub use view::ViewArgs;

/// Renders volumes that do not fit into memory, and tells with every picture what it drew and what it skipped.
#[derive(Parser)]
#[command(name = "glassbrick", version, arg_required_else_help = false)]
pub struct Cli {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Subcommand)]
pub enum Command {
    /// Tells what a volume is and, with a transfer function, what that needs of it
    Info(InfoArgs),
    /// Makes a brick store of a volume, from which any part of it is read at once
    Ingest(IngestArgs),
    /// Checks every brick and table of a store, and names those that are damaged
    Verify(VerifyArgs),
    /// Draws a picture of a volume, or a turn around it
    Render(Box<RenderArgs>),
    /// Measures every executor on volumes: frames per second, bricks at each stage, bytes, memory, as tables and plots
    Bench(Box<BenchArgs>),
    /// Makes a body, stores and draws it and shows the report: a first look that needs no data
    Demo(DemoArgs),
}

/// What `render --help` and `info --help` tell of presets.
fn presets_help() -> String {
    let line = |preset: &glassbrick::Preset| format!("  {:<10} {}\n", preset.name, preset.summary);
    format!("Presets for --tf:\n{}", glassbrick::PRESETS.iter().map(line).collect::<String>())
}
