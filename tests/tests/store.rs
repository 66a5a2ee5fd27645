//! The brick store: its pictures are the volume's at every level, it is there whole or not at all, and damage is
//! found, named and never drawn.

mod array_reader;
mod command;
pub mod damage;
mod damage_by_command;
pub mod damage_kinds;
mod full_disk;
mod killed;
mod level_choice;
mod level_pictures;
mod lies;
mod other_readers;
mod reads;
mod replaced;
mod same_pictures;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use glassbrick::{BrickLayout, Codec, OpenSettings, RenderRequest, Rendered, Volume};
use glassbrick_brick_store::{IngestSettings, ingest};
use glassbrick_tests::drawing::{camera, request};
use glassbrick_tests::scenes::Scene;
use tempfile::TempDir;

use crate::binary::{Outcome, glassbrick};
use crate::robustness::names_in;
use array_reader::ArrayReader;

/// A folder for volumes and stores.
pub struct Scratch {
    folder: TempDir,
}

impl Scratch {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a scratch folder") }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.path(name);
        fs::write(&path, bytes).expect("a scratch file");
        path
    }

    /// The store `v.zarr` of a scene's volume.
    pub fn store(&self, scene: &Scene, edge: u32, codec: Codec) -> PathBuf {
        let path = self.path("v.zarr");
        let settings = IngestSettings {
            layout: BrickLayout { edge, halo: 2 },
            codec,
            replace: true,
            resume: false,
            input: scene.name.clone(),
        };
        ingest(&mut ArrayReader::of(scene), &path, &settings, &mut |_, _| ()).expect("a scene can be stored");
        path
    }

    /// `line` with this folder in the place of `{}`.
    pub fn line(&self, line: &str) -> String {
        line.replace("{}", self.folder.path().to_str().expect("scratch folders have plain names"))
    }

    /// `glassbrick` with `{}` in the line standing for this folder.
    pub fn glassbrick(&self, line: &str) -> Outcome {
        glassbrick(&self.line(line), &[])
    }

    #[track_caller]
    fn run(&self, line: &str) -> Outcome {
        self.glassbrick(line).succeeded()
    }

    /// The names in the folder, hidden ones included.
    pub fn names(&self) -> Vec<String> {
        names_in(self.folder.path())
    }
}

/// Every file below a folder, by its path there, with its bytes.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(&next).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).expect("it is below").to_owned();
                found.insert(name, fs::read(&path).expect("a file"));
            }
        }
    }
    found
}

/// Voxels of 16 bits, little-endian, that no codec makes shorter.
fn noise(voxels: usize) -> Vec<u8> {
    let mut number = 1u32;
    let next = std::iter::repeat_with(|| {
        number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (number >> 16) as u16
    });
    next.take(voxels).flat_map(u16::to_le_bytes).collect()
}

/// Opens a store, or what else is there, and draws a scene's picture of it.
fn draw_stored(
    path: &Path,
    scene: &Scene,
    settings: &OpenSettings,
    change: impl Fn(&mut RenderRequest),
) -> Result<Rendered, glassbrick::Error> {
    let mut request = request(scene);
    request.level = glassbrick::LevelChoice::Exact(0);
    change(&mut request);
    Volume::open(path, settings, |_, _| ())?.render(request, &camera(scene))
}

/// Holds that a message is one line that says something.
#[track_caller]
pub fn assert_one_line(message: &str) {
    assert!((20..900).contains(&message.len()) && !message.contains('\n'), "{message}");
    let is_panic = ["panicked", "unwrap", ".rs:", "Err("].iter().any(|word| message.contains(word));
    assert!(!is_panic, "{message}");
}

/// Holds that a command failed with one line on stderr; returns that line. What it printed before may stand.
#[track_caller]
pub fn failed(outcome: &Outcome) -> String {
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    let message = outcome.stderr.strip_suffix('\n').unwrap_or_else(|| panic!("no line: {outcome:?}"));
    assert!(message.starts_with("error: "), "{outcome:?}");
    assert_one_line(message);
    message.to_owned()
}
