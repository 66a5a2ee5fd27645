//! Writes a phantom to a file.

use std::io::{self, IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::{Context, bail};
use clap::Parser;
use glassbrick_phantom::Phantom;

/// Generates a CT of a human body in Hounsfield units, of any size.
#[derive(Debug, Parser)]
#[command(name = "glassbrick-phantom", version)]
struct Arguments {
    /// Voxels along x, y and z.
    #[arg(long, value_name = "XxYxZ", value_parser = parse_extent, default_value = "512x304x1730")]
    extent: [u32; 3],
    /// Decides the noise and the course of small vessels.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Makes the same body with this many times the voxels on each axis.
    #[arg(long, value_name = "FACTOR", default_value_t = 1)]
    upsample: u32,
    /// Stores unsigned 16-bit integers, HU + 1024; for .raw only.
    #[arg(long)]
    unsigned: bool,
    /// The file to write: .nrrd, or .raw for the voxels alone.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

fn parse_extent(text: &str) -> Result<[u32; 3], String> {
    let axes: Option<Vec<u32>> = text.split('x').map(|n| n.parse().ok().filter(|&n| n > 0)).collect();
    let wrong = || format!("'{text}' is no extent; give three numbers from 1 on, such as 512x304x1730");
    axes.and_then(|axes| axes.try_into().ok()).ok_or_else(wrong)
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> anyhow::Result<()> {
    let phantom = Phantom::new(arguments.extent, arguments.seed)
        .upsampled(arguments.upsample)
        .context("--upsample makes no extent; give a smaller factor, from 1 on")?;
    let output = &arguments.output;
    let terminal = io::stderr().is_terminal();
    let progress = |share: f32| {
        if terminal {
            eprint!("\r{:3.0} %{}", 100.0 * share, if share < 1.0 { "" } else { "\n" });
            // A progress line that cannot be shown is no reason to stop.
            let _ = io::stderr().flush();
        }
    };
    let is_raw = match output.extension().and_then(|extension| extension.to_str()) {
        Some("nrrd") => false,
        Some("raw") => true,
        _ => bail!("{}: the name must end in .nrrd or .raw", output.display()),
    };
    match (is_raw, arguments.unsigned) {
        (false, false) => phantom.write_nrrd(output, progress),
        (true, false) => phantom.write_raw(output, progress),
        (true, true) => phantom.write_raw_u16(output, progress),
        (false, true) => bail!("--unsigned goes with .raw only; name the output so, or leave it out"),
    }
    .with_context(|| format!("{}: cannot be written; check the folder and its free space", output.display()))
}
