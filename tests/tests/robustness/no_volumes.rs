use std::fs;
use std::path::Path;
use std::process::Command;

use super::{EXIT_FAILURE, Scratch, folder};

#[test]
fn files_that_are_no_volumes_are_refused_under_any_name() {
    let scratch = Scratch::new();
    let noise: Vec<u8> = (1..5000u64).map(|at| ((at * at * 0x9e37_79b9) >> 13) as u8).collect();
    let text = "It was a dark and stormy night.\n".repeat(40);
    let extensions =
        ["nrrd", "nhdr", "mha", "mhd", "nii", "nii.gz", "hdr", "img", "dcm", "raw", "txt", "zarr", ""];
    for extension in extensions {
        for (stem, bytes) in
            [("noise", &noise[..]), ("text", text.as_bytes()), ("empty", b""), ("zeros", &[0; 4096])]
        {
            let name = format!("{stem}.{extension}");
            let path = scratch.file(name.trim_end_matches('.'), bytes);
            let message = scratch.refuses(EXIT_FAILURE, &path, "");
            assert!(message.contains(stem), "{message}");
        }
    }
}

#[test]
fn folders_without_a_volume_are_refused() {
    let (scratch, empty) = (Scratch::new(), folder());
    assert!(scratch.refuses(EXIT_FAILURE, empty.path(), "").contains("DICOM"));
    scratch.file("readme.txt", b"nothing to see");
    scratch.file("picture.png", b"\x89PNG\r\n\x1a\n");
    fs::create_dir(scratch.input.path().join("more")).expect("a scratch folder");
    assert!(scratch.refuses(EXIT_FAILURE, scratch.input.path(), "").contains("DICOM"));
}

#[test]
fn what_is_not_there_is_named() {
    let scratch = Scratch::new();
    let message = scratch.refuses(EXIT_FAILURE, Path::new("no/such/volume.nrrd"), "");
    assert!(message.contains("no/such/volume.nrrd"), "{message}");
}

/// Reading a pipe that nobody writes to would wait for ever.
#[cfg(unix)]
#[test]
fn devices_and_pipes_are_refused() {
    let scratch = Scratch::new();
    let pipe = scratch.input.path().join("pipe.nrrd");
    assert!(Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    for path in [&pipe, Path::new("/dev/null"), Path::new("/dev/zero")] {
        scratch.refuses(EXIT_FAILURE, path, "");
        scratch.refuses(EXIT_FAILURE, path, "--extent 4x4x4 --dtype u8");
    }
    scratch.refuses(EXIT_FAILURE, scratch.input.path(), "");
}
