//! `glassbrick ingest`: makes a brick store of a volume.

use std::time::Instant;

use anyhow::Result;
use glassbrick::{Ingested, ingest, memory_peaks, stored_bytes};

use crate::figures::{bytes, time};
use crate::job::IngestJob;
use crate::progress::Progress;
use crate::terminal;

/// Makes the store and prints a line about it.
///
/// # Errors
/// When the volume cannot be read or the store not be written.
pub fn run(job: &IngestJob, start: Instant) -> Result<()> {
    let progress = Progress::start("storing");
    let made = ingest(&job.input, &job.output, &job.settings, |done, total| progress.rate(done, total))?;
    drop(progress);
    terminal::warn(&made.store.notes);
    terminal::print(&summary(job, &made, start))
}

fn summary(job: &IngestJob, made: &Ingested, start: Instant) -> String {
    let volume_bytes = made.store.volume.bytes();
    let seconds = start.elapsed().as_secs_f64();
    let size = stored_bytes(&job.output).map_or(String::new(), |stored| format!(" ({})", bytes(stored)));
    let peak = memory_peaks().anon_bytes.map_or(String::new(), |peak| format!(", {} of memory", bytes(peak)));
    let pace = if made.resumed_bytes == 0 {
        format!(", {}/s of voxels", bytes((volume_bytes as f64 / seconds) as u64))
    } else {
        format!(", of which {} had been done before", bytes(made.resumed_bytes))
    };
    format!(
        "{}{size}: {} of voxels in {} levels, {}; {}{pace}{peak}",
        terminal::one_line(&job.output.to_string_lossy()),
        bytes(volume_bytes),
        made.store.levels(),
        made.store.codec.name(),
        time(seconds * 1e3),
    )
}
