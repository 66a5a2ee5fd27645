//! Damaged stores on the command line: one line on stderr, exit 1, and nothing written.

use std::fs;

use serde_json::{Value, json};

use super::damage::prepared;
use super::damage_kinds::{Damage, KINDS};
use super::{Scratch, failed};
use crate::binary::glassbrick_in_little_memory;
use crate::robustness::{EXIT_FAILURE, refused};

const RENDER: &str =
    "render {}/v.zarr --tf {}/tf.json --level 0 --skip empty --size 16x16 --threads 2 -o {}/a.png";

#[test]
fn damage_is_told_in_one_line() {
    let scratch = prepared();
    for kind in KINDS {
        let path = scratch.path("v.zarr").join(kind.file);
        let bytes = fs::read(&path).expect("there");
        let in_the_middle = if kind.is_bricks() { bytes.len() - 600 } else { bytes.len() / 2 };
        for damage in [
            Damage::Flipped { at: in_the_middle, bits: 0x50 },
            Damage::CutTo(bytes.len() / 3),
            Damage::Missing,
            Damage::Trailing(b"x"),
        ] {
            damage.inflict(&path, &bytes);
            let checked = scratch.glassbrick("verify {}/v.zarr --threads 2");
            let message = failed(&checked);
            assert!(message.contains("v.zarr"), "{message}");
            let named = if kind.file == "zarr.json" { "v.zarr" } else { kind.file };
            assert!(checked.stdout.contains(named) || message.contains(named), "{checked:?}");
            if kind.needed {
                let drawn = glassbrick_in_little_memory(&scratch.line(RENDER), &[]);
                assert!(refused(&drawn, EXIT_FAILURE).contains(named), "{drawn:?}");
                assert_eq!(scratch.names(), ["tf.json", "v.zarr"]);
            }
            damage.undo(&path, &bytes);
        }
    }
    assert!(scratch.run("verify {}/v.zarr").stdout.contains("are sound"));
}

#[test]
fn damaged_bricks_are_left_out_by_a_flag_alone() {
    let scratch = prepared();
    let path = scratch.path("v.zarr/levels/0/bricks/c/0/0/0/0/0/0");
    let bytes = fs::read(&path).expect("there");
    Damage::Flipped { at: bytes.len() - 30, bits: 1 }.inflict(&path, &bytes);
    let message = failed(&scratch.glassbrick(RENDER));
    assert!(message.contains("brick ") && message.contains("--allow-damaged"), "{message}");
    let told = scratch.run(&format!("{RENDER} --allow-damaged --report {{}}/r.json")).stderr;
    assert!(told.contains("left out"), "{told}");
    let report = fs::read(scratch.path("r.json")).expect("it was written");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!(report["complete"], json!(false));
    assert!(report["bricks"]["damaged"].as_u64() > Some(0));
    let warnings = report["warnings"].as_array().expect("a list");
    assert!(warnings.iter().any(|warning| warning.as_str().is_some_and(|told| told.contains("brick "))));
    fs::write(&path, bytes).expect("a scratch file");
    scratch.run(&format!("{RENDER} --allow-damaged --report {{}}/r.json"));
    let report = fs::read(scratch.path("r.json")).expect("it was written");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    assert_eq!((&report["complete"], &report["bricks"]["damaged"]), (&json!(true), &json!(0)));
}

/// Metadata alone is missing or another's: what is there is not taken for a store, nor for a folder of slices.
#[test]
fn what_is_no_store_is_refused() {
    let scratch = Scratch::new();
    for (name, text) in [
        ("other.zarr", r#"{"zarr_format":3,"node_type":"group","attributes":{}}"#),
        ("array.zarr", r#"{"zarr_format":3,"node_type":"array","shape":[9],"data_type":"uint8"}"#),
        ("list.zarr", "[]"),
        ("null.zarr", "null"),
        ("deep.zarr", &"[".repeat(100_000)),
        ("empty.zarr", ""),
    ] {
        fs::create_dir(scratch.path(name)).expect("a folder");
        scratch.file(&format!("{name}/zarr.json"), text.as_bytes());
        for command in ["info", "verify", "render --size 9x9 -o {}/a.png"] {
            let line = scratch.line(&format!("{command} {{}}/{name}"));
            let outcome = glassbrick_in_little_memory(&line, &[]);
            assert!(refused(&outcome, EXIT_FAILURE).contains(name), "{outcome:?}");
        }
        let line = format!("ingest {{}}/{name} -o {{}}/new.zarr");
        failed(&scratch.glassbrick(&line));
    }
    for command in ["verify {}/none.zarr", "info {}/none.zarr", "verify {}"] {
        failed(&scratch.glassbrick(command));
    }
    assert!(!scratch.path("a.png").exists() && !scratch.path("new.zarr").exists());
}
