//! No more is read of a store than its picture needs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::damage_kinds::INDEX_BYTES;
use super::{Scratch, files};
use crate::command_line::pictures::exr;

/// 10 bricks of 12 core voxels along each axis.
const N: usize = 120;
const EDGE: usize = 16;

/// A transfer function that shows bone.
const BONE: &str = r#"{"points":[{"value":150,"color":[1,1,0.9],"opacity":0},
                                 {"value":180,"color":[1,1,0.9],"opacity":0.9}],"unit":1}"#;

/// Stores voxels as u8.
fn stored(codec: &str, voxel: impl Fn([f64; 3]) -> u8) -> Scratch {
    let scratch = Scratch::new();
    let at = |index: usize| [index % N, index / N % N, index / (N * N)].map(|i| i as f64);
    scratch.file("v.raw", &(0..N * N * N).map(|index| voxel(at(index))).collect::<Vec<u8>>());
    scratch.file("tf.json", BONE.as_bytes());
    scratch.run(&format!(
        "ingest {{}}/v.raw --extent {N}x{N}x{N} --dtype u8 --brick {EDGE} --codec {codec} -o {{}}/v.zarr"
    ));
    scratch
}

fn radius(p: [f64; 3], centre: f64) -> f64 {
    p.map(|x| (x - centre).powi(2)).iter().sum::<f64>().sqrt()
}

/// The report of a fresh process that draws `a.exr`.
fn draw(scratch: &Scratch, flags: &str) -> Value {
    let line = "render {}/v.zarr --level 0 --tf {}/tf.json --size 96x96 --azimuth 25 --elevation 15 \
                -o {}/a.exr --report {}/r.json ";
    scratch.run(&format!("{line} {flags}"));
    serde_json::from_slice(&fs::read(scratch.path("r.json")).expect("it was written")).expect("JSON")
}

fn count(report: &Value, field: &str) -> u64 {
    report.pointer(field).and_then(Value::as_u64).unwrap_or_else(|| panic!("{field} is no count"))
}

/// What must be read before any brick: metadata and ranges. The group's own metadata is read twice, to learn what the
/// store is and to see that it is all there.
fn opening_bytes(files: &BTreeMap<PathBuf, Vec<u8>>) -> u64 {
    let is_read = |path: &Path| path.ends_with("zarr.json") || path.to_string_lossy().contains("range/c/");
    let of_group = files[Path::new("zarr.json")].len() as u64;
    of_group
        + files.iter().filter(|(path, _)| is_read(path)).map(|(_, bytes)| bytes.len() as u64).sum::<u64>()
}

/// Bytes of every index of level 0, and the lengths of its bricks, largest first.
fn bricks(files: &BTreeMap<PathBuf, Vec<u8>>) -> (u64, Vec<u64>) {
    let shards = files.iter().filter(|(path, _)| path.starts_with("levels/0/bricks/c"));
    let (mut index_bytes, mut lengths) = (0, Vec::new());
    for (_, bytes) in shards {
        let index = &bytes[bytes.len() - INDEX_BYTES..bytes.len() - 4];
        let numbers = index.as_chunks::<8>().0.iter().map(|number| u64::from_le_bytes(*number));
        lengths.extend(numbers.skip(1).step_by(2).filter(|&length| length != u64::MAX));
        index_bytes += INDEX_BYTES as u64;
    }
    lengths.sort_unstable_by(|a, b| b.cmp(a));
    (index_bytes, lengths)
}

/// Bone, a twentieth of the volume, in soft tissue that the transfer function does not show.
#[test]
fn a_mostly_empty_volume_is_mostly_not_read() {
    for codec in ["none", "lz4", "zstd"] {
        let scratch = stored(codec, |p| {
            let bone = radius(p, 40.0) < 18.0 || radius(p, 90.0) < 9.0;
            if bone { 200 } else { (p[0] as u8).wrapping_mul(7) % 100 }
        });
        let files = files(&scratch.path("v.zarr"));
        let (index_bytes, lengths) = bricks(&files);
        for flags in ["", "--memory 200KB --threads 1", "--memory 16MiB --threads 3", "--mode mip"] {
            let report = draw(&scratch, &format!("--skip all {flags}"));
            let loaded = count(&report, "/bricks/in_frustum") - count(&report, "/bricks/occluded");
            let of_bricks: u64 = lengths.iter().take(loaded as usize).sum();
            let most = opening_bytes(&files) + index_bytes + of_bricks;
            let read = count(&report, "/residency/bytes_read");
            assert!(read <= most, "{codec} {flags}: {read} bytes are read, {most} are needed");
            assert!(read > opening_bytes(&files), "{codec} {flags}");
            assert!(count(&report, "/residency/misses") >= count(&report, "/bricks/rendered"));
            if !flags.contains("mip") {
                assert!(count(&report, "/bricks/filtered_visible") < 1000 / 8);
                assert!(loaded * 8 < lengths.len() as u64);
            }
        }
    }
}

/// A shell of bone with more bone inside, which cannot be seen. The bricks inside are destroyed, and it is drawn as
/// before.
#[test]
fn bricks_that_are_hidden_are_not_read() {
    let scratch = stored("lz4", |p| {
        let from_centre = radius(p, 59.5);
        if (40.0..58.0).contains(&from_centre) || from_centre < 30.0 { 220 } else { 10 }
    });
    let store = scratch.path("v.zarr");
    let whole = draw(&scratch, "");
    assert!(count(&whole, "/bricks/occluded") > 100, "{}", whole["bricks"]);
    let expected = exr(&scratch.path("a.exr")).channels;
    destroy(&store, |brick| brick.iter().all(|place| (4..6).contains(place)));
    for flags in ["", "--memory 100KB --threads 1", "--memory 2MiB --threads 2"] {
        let report = draw(&scratch, flags);
        assert!(exr(&scratch.path("a.exr")).channels == expected, "{flags}");
        assert!(count(&report, "/bricks/occluded") > 100, "{flags}: {}", report["bricks"]);
    }
    let all = "render {}/v.zarr --level 0 --tf {}/tf.json --size 96x96 --skip empty -o {}/b.exr";
    let message = super::failed(&scratch.glassbrick(all));
    assert!(message.contains("brick "), "{message}");
}

/// Overwrites the bricks of level 0 whose places are chosen.
fn destroy(store: &Path, is_chosen: impl Fn([usize; 3]) -> bool) {
    let all: Vec<[usize; 3]> = (0..1000)
        .map(|brick| [brick % 10, brick / 10 % 10, brick / 100])
        .filter(|&at| is_chosen(at))
        .collect();
    assert!(!all.is_empty());
    for [x, y, z] in all {
        let path = store.join(format!("levels/0/bricks/c/{}/{}/{}/0/0/0", z / 4, y / 4, x / 4));
        let mut bytes = fs::read(&path).expect("there");
        let place = bytes.len() - INDEX_BYTES + 16 * ((z % 4 * 4 + y % 4) * 4 + x % 4);
        let number = |at: usize| u64::from_le_bytes(bytes[at..at + 8].try_into().expect("8 bytes")) as usize;
        let (offset, length) = (number(place), number(place + 8));
        bytes[offset..offset + length].fill(0xa5);
        fs::write(&path, bytes).expect("a scratch file");
    }
}
