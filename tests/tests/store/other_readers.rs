//! Another Zarr library reads from a store what the volume holds.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use glassbrick::Codec;
use glassbrick_tests::scenes::{Scene, level_scenes};

use super::Scratch;

/// A Python that has zarr: the one of this machine, or else one in the target folder, into which it is installed once.
fn python() -> Option<PathBuf> {
    let has_zarr = |python: &Path| {
        let import = "import zarr; assert int(zarr.__version__[0]) >= 3";
        Command::new(python).args(["-c", import]).output().is_ok_and(|output| output.status.success())
    };
    let own = PathBuf::from("python3");
    if has_zarr(&own) {
        return Some(own);
    }
    let test = env::current_exe().expect("a test knows where it is");
    let profile_folder = test.parent().and_then(Path::parent).expect("tests lie in PROFILE/deps");
    let folder = profile_folder.join("python-with-zarr");
    let python = folder.join("bin/python");
    if !has_zarr(&python) {
        Command::new(own).args(["-m", "venv"]).arg(&folder).output().ok()?;
        Command::new(&python).args(["-m", "pip", "install", "--quiet", "zarr>=3", "numpy"]).output().ok()?;
    }
    has_zarr(&python).then_some(python)
}

#[test]
fn zarr_python_reads_what_the_volume_holds() {
    let Some(python) = python() else {
        eprintln!("SKIPPED: there is no python3 with zarr, and none can be installed");
        assert!(env::var_os("CI").is_none(), "CI has Python and zarr");
        return;
    };
    let tool = concat!(env!("CARGO_MANIFEST_DIR"), "/../tools/check-store");
    let check = |store: &Path, raw: &Path| {
        Command::new(&python).arg(tool).args([store, raw]).output().expect("Python can be run")
    };
    for (stored_type, codec) in [("u8", Codec::None), ("i16", Codec::Lz4), ("f32", Codec::Zstd)] {
        let scenes = level_scenes().into_iter();
        let scene: Scene =
            scenes.rev().find(|scene| scene.volume.stored_type == stored_type).expect("there is one");
        let scratch = Scratch::new();
        let raw = scratch.file("v.raw", &scene.volume.stored_bytes());
        let store = scratch.store(&scene, 12, codec);
        let checked = check(&store, &raw);
        let told = String::from_utf8_lossy(&checked.stderr);
        assert!(checked.status.success(), "{stored_type}: {told}");
        // A tool that finds nothing wrong with anything would prove nothing.
        let mut other = scene.volume.stored_bytes();
        let middle = other.len() / 2;
        other[middle] ^= 0x40;
        fs::write(&raw, other).expect("a scratch file");
        let checked = check(&store, &raw);
        let told = String::from_utf8_lossy(&checked.stderr);
        assert!(!checked.status.success() && told.contains("of level 0"), "{stored_type}: {told}");
    }
}
