use super::sound_files::{gzip, metaimage, nrrd, voxels};
use super::{EXIT_FAILURE, Scratch};

/// Extents that no file has, that no number holds, or that are none.
const EXTENTS: [&str; 9] = [
    "100000 100000 100000",
    "4294967296 10 8",
    "99999999999999999999 10 8",
    "18446744073709551615 2 2",
    "2147483648 2147483648 2147483648",
    "0 10 8",
    "-12 10 8",
    "12.5 10 8",
    "twelve 10 8",
];

/// Refuses a header with sound voxels behind it; the message names the file.
pub fn refuse(scratch: &Scratch, name: &str, header: &[u8]) -> String {
    let path = scratch.file(name, &[header, &voxels()].concat());
    let message = scratch.refuses(EXIT_FAILURE, &path, "");
    assert!(message.contains(name), "{message}");
    message
}

/// The header with one line in place of another of the same key.
fn with_line(header: &str, line: &str) -> String {
    let separator = if line.contains(" = ") { '=' } else { ':' };
    let key = |line: &str| line.split(separator).next().expect("a key").trim().to_owned();
    let mut found = false;
    let mut replaced = String::new();
    for old in header.split_inclusive('\n') {
        if key(old) == key(line) {
            found = true;
            replaced.push_str(line);
            replaced.push('\n');
        } else {
            replaced.push_str(old);
        }
    }
    if found { replaced } else { format!("{line}\n{header}") }
}

#[test]
fn nrrd_headers_that_claim_too_much_or_nonsense() {
    let scratch = Scratch::new();
    for extent in EXTENTS {
        refuse(&scratch, "a.nrrd", with_line(&nrrd("raw", ""), &format!("sizes: {extent}")).as_bytes());
        refuse(&scratch, "z.nrrd", with_line(&nrrd("gzip", ""), &format!("sizes: {extent}")).as_bytes());
    }
    for line in [
        "sizes: 12 10",
        "sizes: 12 10 8 1",
        "sizes: 24 10 8",
        "dimension: 0",
        "dimension: -3",
        "dimension: 2000000000",
        "type: block",
        "type: quaternion",
        "endian: middle",
        "encoding: brotli",
        "encoding: gzip",
        "spacings: 0 1 1",
        "spacings: one two three",
    ] {
        refuse(&scratch, "a.nrrd", with_line(&nrrd("raw", ""), line).as_bytes());
    }
    for more in ["byte skip: 99999999999999999999\n", "line skip: 4000000000\n", "byte skip: -7\n"] {
        refuse(&scratch, "a.nrrd", nrrd("raw", more).as_bytes());
    }
    refuse(&scratch, "a.nhdr", nrrd("raw", "data file: LIST\n").as_bytes());
    refuse(&scratch, "a.nhdr", nrrd("raw", "data file: slice.%d 1 2000000000 1\n").as_bytes());
    refuse(&scratch, "a.nrrd", &[b"NRRD0004\n", "type: ".repeat(100_000).as_bytes()].concat());
}

#[test]
fn metaimage_headers_that_claim_too_much_or_nonsense() {
    let scratch = Scratch::new();
    let sound = metaimage("LOCAL", "");
    for extent in EXTENTS {
        let line = format!("DimSize = {extent}");
        refuse(&scratch, "a.mha", with_line(&sound, &line).as_bytes());
        let compressed = metaimage("LOCAL", "CompressedData = True\n");
        refuse(&scratch, "z.mha", with_line(&compressed, &line).as_bytes());
    }
    for line in [
        "DimSize = 12 10",
        "DimSize = 24 10 8",
        "NDims = 0",
        "NDims = -3",
        "NDims = 2000000000",
        "ElementType = MET_STRING",
        "ElementNumberOfChannels = 3",
        "ElementSpacing = 0 0 0",
        "ElementSpacing = nan 1 1",
        "HeaderSize = 99999999999",
        "CompressedData = True",
        "ElementDataFile = LIST",
    ] {
        refuse(&scratch, "a.mha", with_line(&sound, line).as_bytes());
    }
    refuse(&scratch, "a.mhd", metaimage("slice%d.raw 1 2000000000 1", "").as_bytes());
}

/// A gigabyte that a file of a few kilobytes cannot hold is not even asked of the system.
#[test]
fn a_compressed_file_is_not_believed_to_hold_what_no_compression_reaches() {
    let scratch = Scratch::new();
    let header = with_line(&nrrd("gzip", ""), "sizes: 1024 1024 512");
    let path = scratch.file("a.nrrd", &[header.as_bytes(), &gzip(&voxels())].concat());
    let message = scratch.refuses(EXIT_FAILURE, &path, "");
    assert!(!message.contains("memory"), "{message}");
}
