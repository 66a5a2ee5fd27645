use std::fs;
use std::path::Path;

use super::sound_files::{metaimage, nifti, nrrd, voxels};
use super::{EXIT_FAILURE, Scratch};
use crate::binary::glassbrick;

/// Headers that name a companion: their names, and their text for a name.
fn headers(companion: &str) -> [(&'static str, String); 4] {
    [
        ("a.nhdr", nrrd("raw", &format!("data file: {companion}\n"))),
        ("b.nhdr", nrrd("raw", &format!("data file: LIST\n{companion}\n"))),
        ("a.mhd", metaimage(companion, "")),
        ("b.mhd", metaimage(&format!("LIST\n{companion}"), "")),
    ]
}

#[test]
fn a_companion_beside_its_header_or_in_a_folder_there_is_read() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.input.path().join("sub")).expect("a scratch folder");
    scratch.file("voxels.raw", &voxels());
    scratch.file("sub/voxels.raw", &voxels());
    for companion in ["voxels.raw", "./voxels.raw", "sub/voxels.raw"] {
        for (name, header) in headers(companion).into_iter().filter(|(name, _)| name.starts_with('a')) {
            let path = scratch.file(name, header.as_bytes());
            glassbrick("info", &[&path]).succeeded();
        }
    }
}

#[test]
fn a_companion_that_is_missing_or_no_file_is_named() {
    let scratch = Scratch::new();
    fs::create_dir(scratch.input.path().join("folder.raw")).expect("a scratch folder");
    for companion in ["missing.raw", "folder.raw"] {
        for (name, header) in headers(companion) {
            let path = scratch.file(name, header.as_bytes());
            let message = scratch.refuses(EXIT_FAILURE, &path, "");
            // A list that is too short is told for what it is.
            assert!(message.contains(companion) || name.starts_with('b'), "{message}");
        }
    }
    let pair = scratch.file("pair.hdr", &nifti("ni1\0", 0.0));
    assert!(scratch.refuses(EXIT_FAILURE, &pair, "").contains("pair"));
}

/// The voxels are there and sound: only where they are is wrong.
#[test]
fn a_companion_outside_the_headers_folder_is_not_read() {
    let scratch = Scratch::new();
    let inner = scratch.input.path().join("inner");
    fs::create_dir_all(inner.join("sub")).expect("a scratch folder");
    let outside = scratch.file("outside.raw", &voxels());
    let absolute = outside.to_str().expect("scratch folders have plain names");
    for companion in ["../outside.raw", "sub/../../outside.raw", "./../outside.raw", absolute] {
        for (name, header) in headers(companion) {
            let path = inner.join(name);
            fs::write(&path, header).expect("a scratch file");
            scratch.refuses(EXIT_FAILURE, &path, "");
        }
    }
    let up = inner.join("numbered.nhdr");
    fs::write(&up, nrrd("raw", "data file: ../outside%d.raw 1 1 1\n")).expect("a scratch file");
    scratch.refuses(EXIT_FAILURE, &up, "");
}

#[test]
fn a_header_that_names_itself_or_nothing_is_refused() {
    let scratch = Scratch::new();
    for companion in ["", ".", "/", "a.nhdr", "a.mhd"] {
        for (name, header) in headers(companion).into_iter().filter(|(name, _)| name.starts_with('a')) {
            // Without a data file of its own, an NRRD's voxels are looked for behind its header.
            scratch.refuses(EXIT_FAILURE, Path::new(&scratch.file(name, header.as_bytes())), "");
        }
    }
}
