use std::fs;
use std::path::{Path, PathBuf};

use super::sound_files::{metaimage, voxels};
use super::{EXIT_FAILURE, EXIT_USAGE, Scratch, names_in, refused};
use crate::binary::glassbrick_in_little_memory;

fn sound(scratch: &Scratch) -> PathBuf {
    scratch.file("a.mha", &[metaimage("LOCAL", "").as_bytes(), &voxels()].concat())
}

/// Holds that rendering to `out` is refused, and that the folder of outputs is as it was.
#[track_caller]
fn refuses_output(scratch: &Scratch, code: i32, out: &Path, flags: &str) -> String {
    let before = names_in(scratch.output.path());
    let line = format!("render --size 16x16 {flags}");
    let message =
        refused(&glassbrick_in_little_memory(&line, &[&sound(scratch), Path::new("-o"), out]), code);
    assert_eq!(names_in(scratch.output.path()), before);
    message
}

#[test]
fn places_that_take_no_picture_are_refused_before_the_work() {
    let scratch = Scratch::new();
    let folder = scratch.output.path();
    fs::create_dir(folder.join("folder.png")).expect("a scratch folder");
    for out in [
        folder.to_owned(),
        folder.join("folder.png"),
        folder.join("missing/out.png"),
        folder.join("out.png/out.png"),
        folder.join("out"),
        folder.join("out.jpg"),
        folder.join(".png"),
        "/dev/null".into(),
        "/dev/full".into(),
        "/".into(),
    ] {
        refuses_output(&scratch, EXIT_FAILURE, &out, "");
    }
}

#[test]
fn a_write_protected_picture_stays() {
    let scratch = Scratch::new();
    let mut permissions = fs::metadata(scratch.picture()).expect("there").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(scratch.picture(), permissions).expect("ours");
    let message = scratch.refuses(EXIT_FAILURE, &sound(&scratch), "");
    assert!(message.contains("write-protected"), "{message}");
}

#[test]
fn what_is_read_is_not_written_over() {
    let scratch = Scratch::new();
    // A volume may have any name.
    let input = scratch.output.path().join("volume.png");
    fs::write(&input, [metaimage("LOCAL", "").as_bytes(), &voxels()].concat()).expect("a scratch file");
    let outcome = glassbrick_in_little_memory("render", &[&input, Path::new("-o"), &input]);
    assert!(refused(&outcome, EXIT_FAILURE).contains("written over"), "{outcome:?}");
    assert!(fs::read(&input).expect("there").ends_with(&voxels()));
}

#[test]
fn a_report_that_cannot_be_written_is_told_before_the_picture_is_drawn() {
    let scratch = Scratch::new();
    let input = sound(&scratch);
    for report in ["/no/such/folder/r.json", "/dev/null", "/"] {
        scratch.refuses(EXIT_FAILURE, &input, &format!("--report {report}"));
    }
    let same = format!("--report {}", scratch.picture().display());
    scratch.refuses(EXIT_USAGE, &input, &same);
}

#[test]
fn turns_need_names_for_their_frames() {
    let scratch = Scratch::new();
    for (name, flags) in [
        ("turn.png", "--frames 3"),
        ("turn-{frame}.png", ""),
        ("turn.gif", ""),
        ("turn.avi", "--frames 3 --background transparent"),
        ("turn.gif", "--frames 0"),
    ] {
        let out = scratch.output.path().join(name);
        refuses_output(&scratch, EXIT_USAGE, &out, flags);
    }
    for name in ["missing/turn-{frame}.png", "missing/turn.gif", "turn.mp4"] {
        let out = scratch.output.path().join(name);
        refuses_output(&scratch, EXIT_FAILURE, &out, "--frames 3");
    }
}
