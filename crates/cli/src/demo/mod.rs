//! `glassbrick demo`: makes a body, stores it, draws it in several ways, and shows what each picture took.

mod pictures;
mod table;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result, bail};
use glassbrick::{
    Background, Camera, FrameReport, IngestSettings, OpenSettings, Renderer, Volume, check_output,
    check_text_file, ingest, report_json, write_picture, write_text_file,
};
use glassbrick_phantom::Phantom;
use serde_json::{Value, json};

use crate::args::{DemoArgs, DemoSize};
use crate::figures::time;
use crate::progress::Progress;
use crate::terminal;
use pictures::{DemoPicture, pictures};

/// Half of the Visible Human on each axis: a whole body.
const SMALL: [u32; 3] = [256, 152, 865];
const SEED: u64 = 1;

/// The names that a demo writes in its folder; it touches no others.
const VOLUME_FILE: &str = "phantom.nrrd";
const STORE_FOLDER: &str = "phantom.zarr";
const REPORT_FILE: &str = "report.json";

/// Makes the body, its store, the pictures and the report, and prints a table of them.
///
/// # Errors
/// When a file cannot be written.
pub fn run(args: &DemoArgs, start: Instant) -> Result<()> {
    let folder = &args.output;
    let pictures = pictures();
    prepare(folder, &pictures)?;
    let phantom = match args.size {
        DemoSize::Small => Phantom::new(SMALL, SEED),
        DemoSize::VisibleHuman => Phantom::new(Phantom::VISIBLE_HUMAN, SEED),
    };
    let volume_path = folder.join(VOLUME_FILE);
    make(&phantom, &volume_path)?;
    let store_path = folder.join(STORE_FOLDER);
    store(&volume_path, &store_path)?;
    let volume = Volume::open(&store_path, &OpenSettings::default(), |_, _| ())?;
    let drawn = draw(&volume, folder, &pictures)?;

    let report_path = folder.join(REPORT_FILE);
    write_text_file(&report_path, &serde_json::to_string_pretty(&report(&phantom, &drawn, start))?)?;
    let [x, y, z] = phantom.extent;
    let files = pictures.iter().map(|picture| picture.file).chain([VOLUME_FILE, STORE_FOLDER, REPORT_FILE]);
    let files: Vec<String> = files.map(|file| folder.join(file).display().to_string()).collect();
    let (body, table) = (format!("A body of {x}×{y}×{z} voxels:"), table::table(&drawn));
    let files = format!("Wrote {}\nin {}.", files.join("\n      "), time(milliseconds(start)));
    terminal::print(&[body, table, files].join("\n"))
}

/// Finds out whether everything can be written, and makes the folder.
fn prepare(folder: &Path, pictures: &[DemoPicture]) -> Result<()> {
    if folder.exists() && !folder.is_dir() {
        bail!("{}: is not a folder; give another as -o", folder.display());
    }
    fs::create_dir_all(folder)
        .with_context(|| format!("{}: the folder cannot be made; give another as -o", folder.display()))?;
    for picture in pictures {
        check_output(&folder.join(picture.file))?;
    }
    for file in [VOLUME_FILE, REPORT_FILE] {
        check_text_file(&folder.join(file))?;
    }
    Ok(())
}

fn make(phantom: &Phantom, path: &Path) -> Result<()> {
    let progress = Progress::start("making a body");
    phantom.write_nrrd(path, |share| progress.share(share)).with_context(|| {
        format!("{}: cannot be written; check the folder's permissions and free space", path.display())
    })
}

/// Makes a brick store of the body; one of an earlier demo is replaced.
fn store(volume_path: &Path, store_path: &Path) -> Result<()> {
    let progress = Progress::start("storing the body");
    let settings = IngestSettings { replace: true, ..IngestSettings::default() };
    ingest(volume_path, store_path, &settings, |done, total| progress.rate(done, total))?;
    Ok(())
}

/// Draws and writes every picture.
fn draw(volume: &Volume, folder: &Path, pictures: &[DemoPicture]) -> Result<Vec<(DemoPicture, FrameReport)>> {
    let progress = Progress::start("drawing");
    let mut reports = Vec::with_capacity(pictures.len());
    for (index, picture) in pictures.iter().enumerate() {
        progress.pieces(index as u64, pictures.len() as u64);
        let path: PathBuf = folder.join(picture.file);
        let camera = Camera::framing(volume.desc(), picture.view);
        let mut drawn = Renderer::new(volume, picture.request(volume.value_range()))?.draw(&camera, 1)?;
        let writing = Instant::now();
        write_picture(&path, &drawn.frame, Background::default(), &report_json(&drawn.report).to_string())?;
        drawn.report.time_ms.encode = milliseconds(writing);
        reports.push((*picture, drawn.report));
    }
    Ok(reports)
}

fn report(phantom: &Phantom, drawn: &[(DemoPicture, FrameReport)], start: Instant) -> Value {
    let pictures: Vec<Value> = drawn
        .iter()
        .map(|(picture, report)| json!({ "file": picture.file, "shows": picture.shows, "report": report_json(report) }))
        .collect();
    json!({
        "phantom": { "file": VOLUME_FILE, "store": STORE_FOLDER, "extent": phantom.extent, "seed": phantom.seed },
        "pictures": pictures,
        "time_ms": { "total": milliseconds(start) },
        "version": env!("CARGO_PKG_VERSION"),
    })
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}
