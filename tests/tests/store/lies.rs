//! Metadata that says what is not so, with checksums that fit: refused, in little memory.

use std::fs;
use std::path::{Path, PathBuf};

use glassbrick::Codec;
use serde_json::{Value, json};

use super::damage::{EDGE, scene};
use super::{Scratch, failed, files};
use crate::binary::glassbrick_in_little_memory;
use crate::robustness::{EXIT_FAILURE, refused};

const RENDER: &str = "render {}/v.zarr --tf grey --size 16x16 --threads 2 -o {}/a.png";

/// Changes a store's attributes, and makes their checksum fit.
fn forge(store: &Path, change: impl Fn(&mut Value)) {
    edit(&store.join("zarr.json"), |group| {
        let attributes = &mut group["attributes"]["glassbrick"];
        attributes.as_object_mut().expect("an object").remove("checksum");
        change(attributes);
        attributes["checksum"] = crc32c::crc32c(attributes.to_string().as_bytes()).into();
    });
}

fn edit(path: &Path, change: impl Fn(&mut Value)) {
    let mut value = serde_json::from_slice(&fs::read(path).expect("there")).expect("JSON");
    change(&mut value);
    fs::write(path, value.to_string()).expect("a scratch file");
}

fn assert_refused(scratch: &Scratch, what: &str) {
    for line in ["info {}/v.zarr", RENDER] {
        let outcome = glassbrick_in_little_memory(&scratch.line(line), &[]);
        assert!(refused(&outcome, EXIT_FAILURE).contains("v.zarr"), "{what}: {outcome:?}");
    }
    let outcome = glassbrick_in_little_memory(&scratch.line("verify {}/v.zarr --threads 2"), &[]);
    assert!(failed(&outcome).contains("v.zarr"), "{what}: {outcome:?}");
    assert!(!scratch.path("a.png").exists());
}

fn stored() -> (Scratch, PathBuf) {
    let scratch = Scratch::new();
    let store = scratch.store(&scene(), EDGE, Codec::Zstd);
    (scratch, store)
}

#[test]
fn a_forged_store_that_tells_the_truth_is_drawn() {
    let (scratch, store) = stored();
    forge(&store, |_| ());
    scratch.run("verify {}/v.zarr");
    scratch.run(RENDER);
}

#[test]
fn attributes_that_lie_are_refused() {
    let (scratch, store) = stored();
    let truth = files(&store)[Path::new("zarr.json")].clone();
    let huge = u32::MAX;
    for (key, lie) in [
        ("extent", json!([huge, huge, huge])),
        ("extent", json!([huge, 60, 60])),
        ("extent", json!([60, 61, 2_000_000_000])),
        ("extent", json!([0, 61, 119])),
        ("extent", json!([60, 61])),
        ("extent", json!([60, 61, -119])),
        ("extent", json!([60, 61, 1e300])),
        ("dtype", json!("u16")),
        ("dtype", json!("f64")),
        ("dtype", json!("u8")),
        ("dtype", json!("complex")),
        ("brick", json!({ "edge": 32, "halo": 2 })),
        ("brick", json!({ "edge": 16, "halo": 3 })),
        ("brick", json!({ "edge": 16, "halo": 8 })),
        ("brick", json!({ "edge": 0, "halo": 2 })),
        ("brick", json!({ "edge": huge, "halo": huge })),
        ("levels", json!(1)),
        ("levels", json!(6)),
        ("levels", json!(huge)),
        ("codec", json!("none")),
        ("codec", json!("lz4")),
        ("codec", json!("rle")),
        ("spacing", json!([0.0, 1.0, 1.0])),
        ("spacing", json!([1.0, -1.0, 1.0])),
        ("direction", json!([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])),
        ("slope", json!(0.0)),
        ("notes", json!(7)),
        ("format_version", json!(2)),
        ("format_version", json!("1")),
    ] {
        fs::write(store.join("zarr.json"), &truth).expect("a scratch file");
        forge(&store, |attributes| attributes[key] = lie.clone());
        assert_refused(&scratch, &format!("{key}: {lie}"));
    }
    for key in ["extent", "dtype", "brick", "levels", "codec", "format_version", "not_finite"] {
        fs::write(store.join("zarr.json"), &truth).expect("a scratch file");
        forge(&store, |attributes| {
            attributes.as_object_mut().expect("an object").remove(key);
        });
        assert_refused(&scratch, &format!("without {key}"));
    }
}

/// A lie that asks for the same files is found by verifying alone: the tables count other voxels.
#[test]
fn a_lie_that_changes_no_array_is_found_by_verifying() {
    let (scratch, store) = stored();
    forge(&store, |attributes| attributes["extent"] = json!([60, 61, 120]));
    let outcome = scratch.glassbrick("verify {}/v.zarr");
    assert!(failed(&outcome).contains("v.zarr") && outcome.stdout.contains("does not tell"), "{outcome:?}");
}

#[test]
fn arrays_that_are_not_what_the_attributes_ask_for_are_refused() {
    let (scratch, store) = stored();
    let truth = files(&store);
    for (name, pointer, lie) in [
        ("levels/0/bricks/zarr.json", "/shape", json!([999, 999, 999, 16, 16, 16])),
        ("levels/0/bricks/zarr.json", "/data_type", json!("float64")),
        ("levels/0/bricks/zarr.json", "/codecs/0/configuration/chunk_shape", json!([1, 1, 1, 64, 64, 64])),
        ("levels/1/bricks/zarr.json", "/codecs/0/configuration/index_location", json!("start")),
        ("levels/0/range/zarr.json", "/shape", json!([1, 1, 1, 4])),
        ("levels/0/range/zarr.json", "/fill_value", json!(1)),
        ("levels/0/vct/zarr.json", "/data_type", json!("uint64")),
        ("levels/1/zarr.json", "/node_type", json!("array")),
        ("zarr.json", "/zarr_format", json!(2)),
    ] {
        edit(&store.join(name), |value| *value.pointer_mut(pointer).expect("it is there") = lie.clone());
        assert_refused(&scratch, &format!("{name} {pointer}"));
        fs::write(store.join(name), &truth[Path::new(name)]).expect("a scratch file");
    }
    scratch.run("verify {}/v.zarr");
}

/// Every file says the same lie: a volume of more bricks than any disk holds. What a table claims is not taken from
/// memory before the files of the table are there.
#[test]
fn a_whole_store_that_lies_about_its_extent_is_refused() {
    let scratch = Scratch::new();
    let store = scratch.store(&scene(), EDGE, Codec::None);
    let extent = [300_000u32, 300_000, 48];
    let grid = |level: u32| extent.map(|n| n.div_ceil(1 << level).div_ceil(12));
    let levels = (0..).find(|&level| grid(level) == [1; 3]).expect("extents are halved to one") + 1;
    forge(&store, |attributes| {
        attributes["extent"] = json!(extent);
        attributes["levels"] = json!(levels);
    });
    for level in 0..levels {
        let folder = store.join(format!("levels/{level}"));
        let [x, y, z] = grid(level);
        for (array, columns) in [("bricks", None), ("range", Some(4)), ("vct", Some(256))] {
            fs::create_dir_all(folder.join(array)).expect("a scratch folder");
            let told = folder.join(array).join("zarr.json");
            if level > 0 {
                fs::copy(store.join("levels/0").join(array).join("zarr.json"), &told).expect("there");
            }
            edit(&told, |value| match columns {
                None => value["shape"] = json!([z, y, x, EDGE, EDGE, EDGE]),
                Some(columns) => {
                    value["shape"] = json!([z, y, x, columns]);
                    let chunk = json!([z.min(4), y.min(64), x.min(64), columns]);
                    value["chunk_grid"]["configuration"]["chunk_shape"] = chunk;
                }
            });
        }
        fs::copy(store.join("levels/zarr.json"), folder.join("zarr.json")).expect("a scratch file");
    }
    let mut ranges = vec![0; 64 * 64 * 4 * 4 * 2];
    ranges.extend(crc32c::crc32c(&ranges).to_le_bytes());
    fs::write(store.join("levels/0/range/c/0/0/0/0"), ranges).expect("a scratch file");
    let message = refused(&glassbrick_in_little_memory(&scratch.line(RENDER), &[]), EXIT_FAILURE);
    assert!(message.contains("levels/0/range/c/0/0/1/0") && message.contains("missing"), "{message}");
}
