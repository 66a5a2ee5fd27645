//! `glassbrick info`: what a volume is and, with a transfer function, what that needs of it.

mod directions;
mod json;
mod needs;
mod text;

use std::time::{Duration, Instant};

use anyhow::Result;
use glassbrick::{Mode, Volume};

use crate::job::InfoJob;
use crate::terminal;
use needs::Needs;

/// What is told.
pub struct Info<'a> {
    pub job: &'a InfoJob,
    pub volume: &'a Volume,
    pub needs: Option<Needs>,
    pub times: Times,
}

/// How long the stages took.
pub struct Times {
    /// Until the voxels were at hand, without the scan.
    pub open: Duration,
    /// The scan for ranges and, with a transfer function, the tables.
    pub tables: Duration,
    pub total: Duration,
}

/// Why `--backend auto` draws as it does.
const BACKEND_AUTO: (&str, &str) = ("cpu", "this version has no GPU renderer");

/// Opens the volume and prints what it is.
///
/// # Errors
/// When it cannot be opened or read, or stdout cannot be written.
pub fn run(job: &InfoJob, start: Instant) -> Result<()> {
    let opening = Instant::now();
    let volume = job.input.open()?;
    let open = opening.elapsed().saturating_sub(volume.scan_time());
    let measuring = Instant::now();
    let needs = match &job.transfer_function {
        Some(choice) => Some(Needs::measure(&volume, &choice.for_volume(&volume, Mode::Dvr)?)?),
        None => None,
    };
    let tables = volume.scan_time() + measuring.elapsed();
    let times = Times { open, tables, total: start.elapsed() };
    let info = Info { job, volume: &volume, needs, times };
    let told = if job.json { serde_json::to_string_pretty(&json::json(&info))? } else { text::text(&info) };
    terminal::print(&told)
}
