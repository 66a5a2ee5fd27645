//! The `glassbrick` command: tells what volumes are, stores and draws them, and reports what it drew.
//!
//! A command line is understood in two stages: [`args`] holds what was typed, [`job`] what it means, as plain data that
//! has been checked. [`info`], [`ingest`],
//! [`verify`], [`render`] and [`demo`] then do the work by the `glassbrick` library alone, [`bench`] by the harness in
//! `benches`.

mod args;
mod bench;
mod demo;
mod figures;
mod info;
mod ingest;
mod job;
mod parse;
mod progress;
mod render;
mod terminal;
mod usage;
mod verify;

use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;

use args::{Cli, Command};
use job::{BenchJob, InfoJob, IngestJob, RenderJob};
use usage::UsageError;

const EXIT_FAILURE: u8 = 1;
const EXIT_USAGE: u8 = 2;

fn main() -> ExitCode {
    let start = Instant::now();
    quieten_drivers();
    let words: Vec<OsString> = std::env::args_os().collect();
    let cli = match Cli::try_parse_from(&words) {
        Ok(cli) => cli,
        Err(error) if error.use_stderr() => {
            return usage_failure(&usage::condensed(&error.render().to_string()), &words);
        }
        Err(help_or_version) => {
            return match terminal::print(help_or_version.render().to_string().trim_end()) {
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => failure(&error),
            };
        }
    };
    match run(&cli.command, &words, start) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.is::<UsageError>() => usage_failure(&error.to_string(), &words),
        Err(error) => failure(&error),
    }
}

/// Mesa's layer that orders devices prints a complaint where there is no desktop; nobody needs it there, since the best
/// adapter is found by its kind.
fn quieten_drivers() {
    const LAYER_OFF: &str = "NODEVICE_SELECT";
    let is_set = |name| std::env::var_os(name).is_some();
    if cfg!(target_os = "linux")
        && !is_set("XDG_RUNTIME_DIR")
        && !is_set("MESA_VK_DEVICE_SELECT")
        && !is_set(LAYER_OFF)
    {
        // SAFETY: no other thread has been started, so none reads the environment meanwhile.
        unsafe { std::env::set_var(LAYER_OFF, "1") };
    }
}

fn run(command: &Command, words: &[OsString], start: Instant) -> anyhow::Result<()> {
    match command {
        Command::Info(args) => info::run(&InfoJob::new(args)?, start),
        Command::Ingest(args) => ingest::run(&IngestJob::new(args), start),
        Command::Verify(args) => verify::run(args),
        Command::Render(args) => render::run(&RenderJob::new(args)?, start),
        Command::Bench(args) => bench::run(&BenchJob::new(args)?, words, start),
        Command::Demo(args) => demo::run(args, start),
    }
}

fn failure(error: &anyhow::Error) -> ExitCode {
    terminal::tell_error(&terminal::with_causes(error));
    ExitCode::from(EXIT_FAILURE)
}

fn usage_failure(message: &str, words: &[OsString]) -> ExitCode {
    terminal::tell_error(&format!("{message}; {}", usage::see_help(words)));
    ExitCode::from(EXIT_USAGE)
}
