//! `glassbrick render`: one picture, or a turn around the volume, and the report of it.

mod files;
mod report;
mod summary;

use std::time::Instant;

use anyhow::Result;
use glassbrick::{FrameReport, Renderer, write_text_file};

use crate::job::{RenderJob, turned};
use crate::progress::Progress;
use crate::terminal;
use files::PictureFiles;

/// Draws what is asked for, writes it, and prints a line about it.
///
/// # Errors
/// When the volume cannot be read, the request is impossible, or a file cannot be written.
pub fn run(job: &RenderJob, start: Instant) -> Result<()> {
    let reports = draw(job, start)?;
    if let Some(path) = &job.report {
        write_text_file(path, &serde_json::to_string_pretty(&report::whole(&reports, &job.output))?)?;
    }
    terminal::warn(&report::warnings(&reports));
    terminal::print(&summary::summary(&job.output, &reports))
}

/// Draws and writes every frame; returns their reports.
fn draw(job: &RenderJob, start: Instant) -> Result<Vec<FrameReport>> {
    let volume = job.input.open()?;
    let progress = Progress::start("drawing");
    let transfer_function = job.transfer_function.for_volume(&volume, job.settings.mode)?;
    let camera = job.view.camera(volume.desc());
    let renderer = Renderer::new(&volume, job.request(transfer_function))?;
    let frames = job.output.frames();
    let mut files = PictureFiles::create(job)?;
    let mut reports = Vec::new();
    for frame in 0..frames {
        if frames > 1 {
            progress.pieces(frame.into(), frames.into());
        }
        let mut drawn = renderer.draw(&turned(&camera, frame, frames), job.repeat)?;
        drawn.report.warnings.extend_from_slice(&job.warnings);
        let writing = Instant::now();
        files.write(&drawn)?;
        drawn.report.time_ms.encode = milliseconds(writing);
        drawn.report.time_ms.total = milliseconds(start);
        reports.push(drawn.report);
    }
    let finishing = Instant::now();
    files.finish()?;
    if let Some(last) = reports.last_mut() {
        last.time_ms.encode += milliseconds(finishing);
        last.time_ms.total = milliseconds(start);
    }
    Ok(reports)
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}
