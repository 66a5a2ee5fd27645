//! `glassbrick render`: one picture, or a turn around the volume, and the report of it.

mod files;
mod report;
mod summary;

use std::thread;
use std::time::Instant;

use anyhow::{Result, anyhow};
use glassbrick::{Backend, FrameReport, Renderer, write_text_file};

use crate::job::{RenderJob, open_backend, turned};
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
    // A GPU's driver takes its time to start: meanwhile the volume is opened.
    let choice = job.backend;
    let opening = thread::spawn(move || open_backend(choice));
    let volume = job.input.open();
    let backend = opening.join().map_err(|_| anyhow!("the GPU's driver failed while it started"))??;
    let volume = volume?;
    let progress = Progress::start("drawing");
    let transfer_function = job.transfer_function.for_volume(&volume, job.settings.mode)?;
    let camera = job.view.camera(volume.desc());
    let warnings_on_cpu: &[String] = if backend == Backend::Cpu { &job.warnings_on_cpu } else { &[] };
    let renderer = Renderer::new(&volume, job.request(transfer_function, backend.clone()))?;
    let frames = job.output.frames();
    if frames > 1 {
        renderer.pin_boundary(&camera)?;
    }
    let mut files = PictureFiles::create(job)?;
    let mut reports = Vec::new();
    for frame in 0..frames {
        if frames > 1 {
            progress.pieces(frame.into(), frames.into());
        }
        let mut drawn = renderer.draw(&turned(&camera, frame, frames), job.repeat)?;
        drawn.report.warnings.extend(job.warnings.iter().chain(warnings_on_cpu).cloned());
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
