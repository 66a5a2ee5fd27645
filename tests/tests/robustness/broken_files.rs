use std::fs;
use std::path::Path;

use super::sound_files::{self, SoundFile, dicom_slice};
use super::{EXIT_FAILURE, Scratch};
use crate::binary::{glassbrick, glassbrick_in_little_memory};

/// Where to cut a file: all over its header, its middle, and just before its end.
fn cuts(len: usize) -> Vec<usize> {
    let mut cuts: Vec<usize> = [0, 1, 3, 4, 10, 40, 131, 132, 133, 200, 347, 348, 351, 352, 353].to_vec();
    cuts.extend((1..12).map(|part| part * len / 12));
    cuts.extend([len.saturating_sub(9), len.saturating_sub(4), len - 2, len - 1]);
    cuts.sort_unstable();
    cuts.dedup();
    cuts.retain(|&cut| cut < len);
    cuts
}

#[test]
fn the_files_to_be_broken_are_sound() {
    let scratch = Scratch::new();
    for file in sound_files::all(scratch.input.path()) {
        let told = glassbrick_in_little_memory(&format!("info --json {}", file.flags), &[&file.path])
            .succeeded()
            .json();
        let slices = if file.path.ends_with("slice.dcm") { 1 } else { 8 };
        assert_eq!(told["volume"]["extent"], serde_json::json!([12, 10, slices]), "{}", file.path.display());
        assert_eq!(told["volume"]["dtype"], "i16");
    }
}

#[test]
fn a_file_that_was_cut_off_is_refused_wherever_it_was_cut() {
    let scratch = Scratch::new();
    for file in sound_files::all(scratch.input.path()) {
        refused_wherever_it_is_cut(&scratch, &file);
    }
    // A text header that lost only its last line break still says all that it said.
    for file in sound_files::headers(scratch.input.path()) {
        let whole = fs::read(&file.breakable).expect("there");
        for cut in cuts(whole.len() - 2) {
            fs::write(&file.breakable, &whole[..cut]).expect("a scratch file");
            scratch.refuses(EXIT_FAILURE, &file.path, file.flags);
        }
        fs::write(&file.breakable, whole).expect("a scratch file");
    }
}

fn refused_wherever_it_is_cut(scratch: &Scratch, file: &SoundFile) {
    let whole = fs::read(&file.breakable).expect("there");
    // Behind the last voxel there may be a mark of the end, and a sum.
    let behind = if file.is_compressed { 10 } else { 0 };
    for cut in cuts(whole.len() - behind) {
        fs::write(&file.breakable, &whole[..cut]).expect("a scratch file");
        let message = scratch.refuses(EXIT_FAILURE, &file.path, file.flags);
        let name = file.breakable.file_stem().expect("a name").to_string_lossy();
        assert!(message.contains(&*name), "cut at {cut}: {message}");
    }
    fs::write(&file.breakable, whole).expect("a scratch file");
}

#[test]
fn compressed_voxels_that_are_not_those_that_were_written_are_refused() {
    let scratch = Scratch::new();
    for file in sound_files::all(scratch.input.path()).iter().filter(|file| file.is_compressed) {
        let whole = fs::read(&file.path).expect("there");
        for from_end in [1, 4] {
            assert_damage_is_refused(&scratch, file, whole.len() - from_end);
        }
    }
}

#[test]
fn damage_in_the_middle_of_compressed_voxels_is_refused() {
    let scratch = Scratch::new();
    for file in sound_files::all(scratch.input.path()).iter().filter(|file| file.is_compressed) {
        let whole = fs::read(&file.path).expect("there");
        for from_end in (10..whole.len() - 400).step_by(40) {
            assert_damage_is_refused(&scratch, file, whole.len() - from_end);
        }
    }
}

#[track_caller]
fn assert_damage_is_refused(scratch: &Scratch, file: &SoundFile, at: usize) {
    let whole = fs::read(&file.path).expect("there");
    let mut damaged = whole.clone();
    damaged[at] ^= 0x55;
    fs::write(&file.path, damaged).expect("a scratch file");
    scratch.refuses(EXIT_FAILURE, &file.path, "");
    fs::write(&file.path, whole).expect("a scratch file");
}

#[test]
fn a_slice_of_a_series_that_was_cut_off_is_told() {
    let scratch = Scratch::new();
    for number in 0..8 {
        scratch.file(&format!("{number}.dcm"), &dicom_slice(number));
    }
    let slice = dicom_slice(5);
    for cut in [slice.len() - 1, slice.len() / 2] {
        scratch.file("5.dcm", &slice[..cut]);
        let outcome = glassbrick("render --size 16x16 -o", &[&scratch.picture(), scratch.input.path()]);
        assert!(
            outcome.stderr.contains("5.dcm"),
            "the slice is named, whether it is refused or left out: {outcome:?}"
        );
        assert!(outcome.stderr.lines().count() <= 2, "{outcome:?}");
    }
}

#[test]
fn noise_behind_every_magic_is_refused() {
    let scratch = Scratch::new();
    let noise: Vec<u8> =
        (0..4000u64).map(|at| (at.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 56) as u8).collect();
    let dicom = [&[0; 128][..], b"DICM"].concat();
    let nifti = sound_files::nifti("n+1\0", 352.0);
    for (name, magic) in [
        ("a.nrrd", &b"NRRD0004\n"[..]),
        ("a.mha", b"ObjectType = Image\nNDims = 3\n"),
        ("a.nii", &nifti[..4]),
        ("a.dcm", &dicom),
        ("a.nii.gz", &[0x1f, 0x8b, 8, 0]),
        ("a.tif", b"II*\0"),
        ("a.png", b"\x89PNG\r\n\x1a\n"),
        ("a.zip", b"PK\x03\x04"),
    ] {
        let path = scratch.file(name, &[magic, &noise].concat());
        let message = scratch.refuses(EXIT_FAILURE, Path::new(&path), "");
        assert!(message.contains(name), "{message}");
    }
}
