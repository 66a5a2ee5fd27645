//! Real volumes, held to what other programs read of them.
//!
//! They lie in the folder that `GLASSBRICK_DATA` names, or in `../shared/data` beside this workspace. Where there is
//! none, these tests say so and do nothing, except in CI, which must have it.

mod axis_orders;
mod files;
mod heads;
mod refusals;
mod surfaces;

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;

use glassbrick::{OpenSettings, Volume};
use glassbrick_tests::skipped::skipped;

/// The folder of real volumes.
pub fn data() -> Option<PathBuf> {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/data");
    let folder = env::var_os("GLASSBRICK_DATA").map_or_else(beside, PathBuf::from);
    if let Ok(folder) = folder.canonicalize() {
        return Some(folder);
    }
    skipped(&format!("there is no folder {}: name one by GLASSBRICK_DATA", folder.display()));
    None
}

/// The path that a name means: a file of the data folder, or `ARCHIVE.tar.xz:FOLDER`, unpacked.
fn path(data: &Path, name: &str) -> PathBuf {
    match name.split_once(':') {
        Some((archive, folder)) => unpacked(&data.join(archive)).join(folder),
        None => data.join(name),
    }
}

/// The folder that an archive is unpacked in, once, and kept for the next run.
fn unpacked(archive: &Path) -> PathBuf {
    static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
    let _guard = ONE_AT_A_TIME.lock().unwrap_or_else(|poisoned| poisoned.into_inner());
    let name = archive.file_name().expect("archives have names").to_string_lossy();
    let bytes = archive.metadata().unwrap_or_else(|error| panic!("{}: {error}", archive.display())).len();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{bytes}"));
    if folder.exists() {
        return folder;
    }
    let aside = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a scratch folder");
    let status = Command::new("tar").arg("xJf").arg(archive).arg("-C").arg(aside.path()).status();
    assert!(status.expect("tar can be run").success(), "{} is not unpacked", archive.display());
    // Another run of the tests may have been faster.
    if let Err(error) = fs::rename(aside.path(), &folder) {
        assert!(folder.exists(), "{}: {error}", folder.display());
    }
    folder
}

pub fn open(data: &Path, name: &str) -> Volume {
    let path = path(data, name);
    Volume::open(&path, &OpenSettings::default(), |_, _| ()).unwrap_or_else(|error| panic!("{error}"))
}
