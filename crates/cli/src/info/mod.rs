//! `glassbrick info`: what a volume is and, with a transfer function, what that needs of it.

mod directions;
mod json;
mod needs;
mod text;

use std::time::{Duration, Instant};

use anyhow::Result;
use glassbrick::{Mode, Volume};

use crate::job::{InfoJob, auto_backend};
use crate::terminal;
use needs::Needs;

/// What is told.
pub struct Info<'a> {
    pub job: &'a InfoJob,
    pub volume: &'a Volume,
    pub needs: Option<Needs>,
    /// What `--backend auto` draws on, and why.
    pub backend_auto: (&'static str, String),
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
    let backend_auto = auto_backend();
    let times = Times { open, tables, total: start.elapsed() };
    let info = Info { job, volume: &volume, needs, backend_auto, times };
    let told = if job.json { serde_json::to_string_pretty(&json::json(&info))? } else { text::text(&info) };
    terminal::print(&told)
}
