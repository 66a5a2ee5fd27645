//! `ingest`, `verify`, `info` and `render` with sound input, as users run them.

use std::fs;

use glassbrick_tests::drawing::{desc, native_bytes};
use glassbrick_tests::scenes::{Scene, scenes};
use serde_json::{Value, json};

use super::Scratch;
use crate::command_line::pictures::exr;

const TF: &str = r#"{"points":[{"value":0,"color":[0.2,0.4,1],"opacity":0},
                               {"value":700,"color":[1,0.8,0.6],"opacity":0.4}],"unit":1}"#;

fn scene(stored_type: &str) -> &'static Scene {
    scenes().iter().find(|scene| scene.volume.stored_type == stored_type).expect("there is one of each type")
}

/// Writes a scene's voxels as `v.raw`, and returns the flags that say what it is.
fn raw(scratch: &Scratch, scene: &Scene, endian: &str) -> String {
    let mut voxels = native_bytes(scene);
    if (endian == "big") != cfg!(target_endian = "big") {
        voxels.chunks_exact_mut(desc(scene).stored_type.bytes()).for_each(<[u8]>::reverse);
    }
    scratch.file("v.raw", &[&[7; 5], voxels.as_slice()].concat());
    scratch.file("tf.json", TF.as_bytes());
    let [x, y, z] = scene.volume.extent;
    let (slope, intercept) = (scene.volume.slope, scene.volume.intercept);
    format!(
        "{{}}/v.raw --extent {x}x{y}x{z} --dtype {} --endian {endian} --offset 5 --spacing 0.5,1,1.25 \
         --rescale={slope},{intercept}",
        scene.volume.stored_type
    )
}

fn render(scratch: &Scratch, input: &str, flags: &str) -> (Vec<Vec<f32>>, Value) {
    scratch.run(&format!(
        "render {input} --level 0 --size 48x40 --azimuth 30 --elevation 20 -o {{}}/a.exr --report {{}}/r.json {flags}"
    ));
    let report = fs::read(scratch.path("r.json")).expect("it was written");
    (exr(&scratch.path("a.exr")).channels.to_vec(), serde_json::from_slice(&report).expect("JSON"))
}

#[test]
fn the_command_draws_a_store_as_the_file_that_it_was_made_of() {
    let cases = [
        ("u8", "little", "none", "--memory 16MiB"),
        ("i16", "big", "zstd", "--memory 1MiB --threads 1"),
        ("u32", "big", "lz4", "--memory 2MiB --threads 3"),
        ("f32", "little", "zstd", "--threads 1"),
        ("f64", "big", "none", ""),
    ];
    let modes = ["dvr --shading phong", "mip", "minip", "mean", "dvr --skip none"];
    for ((dtype, endian, codec, memory), mode) in cases.into_iter().zip(modes) {
        let scratch = Scratch::new();
        let input = raw(&scratch, scene(dtype), endian);
        scratch.run(&format!("ingest {input} -o {{}}/v.zarr --codec {codec} --brick 32"));
        assert!(scratch.run("verify {}/v.zarr").stdout.contains("sound"));
        for tf in ["{}/tf.json", "auto"] {
            let (flat, told) = render(&scratch, &input, &format!("--mode {mode} --tf {tf} --brick 32"));
            let (stored, report) =
                render(&scratch, "{}/v.zarr", &format!("--mode {mode} --tf {tf} {memory}"));
            let most = flat.iter().flatten().zip(stored.iter().flatten());
            let most = most.filter(|(a, b)| a != b).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
            assert!(most <= 1e-6, "{dtype} {endian} {mode} --tf {tf}: {most}");
            assert_eq!(report["volume"], told["volume"]);
            assert_eq!((&report["complete"], &report["bricks"]["damaged"]), (&json!(true), &json!(0)));
        }
    }
}

#[test]
fn info_tells_what_a_store_holds() {
    let scratch = Scratch::new();
    let input = raw(&scratch, scene("i16"), "big");
    let [x, y, z] = scene("i16").volume.extent;
    let of_file = scratch.run(&format!("info {input} --json --brick 24 --tf {{}}/tf.json")).json();
    scratch.run(&format!("ingest {input} -o {{}}/v.zarr --codec lz4 --brick 24"));
    let told = scratch.run("info {}/v.zarr --json --tf {}/tf.json").json();
    assert_eq!(told["volume"], of_file["volume"]);
    assert_eq!(told["bricks"], of_file["bricks"]);
    assert_eq!((&told["format"], &of_file["store"]), (&json!("brick store"), &Value::Null));
    let mut levels = Vec::new();
    let mut extent = [x, y, z];
    loop {
        let bricks: usize = extent.iter().map(|n| n.div_ceil(20)).product();
        levels.push(json!({ "extent": extent, "bricks": bricks }));
        if bricks == 1 {
            break;
        }
        extent = extent.map(|n| n.div_ceil(2));
    }
    assert_eq!(told["levels"], levels.len());
    assert_eq!(told["store"], json!({ "codec": "lz4", "source_format": "raw", "levels": levels }));
    let [of_store, of_file] = [&told, &of_file].map(|told| &told["transfer_function"]);
    assert_eq!(of_store["bands"], of_file["bands"]);
    assert_eq!(of_store["visible_voxel_fraction"], of_file["visible_voxel_fraction"]);
    let needed = of_store["file_bytes"].as_u64().expect("a count");
    assert!(needed > 0 && needed < told["bricks"]["bytes_needed"].as_u64().expect("a count"));
    let text = scratch.run("info {}/v.zarr --tf {}/tf.json").stdout;
    for words in ["brick store", "levels", "codec lz4"] {
        assert!(text.contains(words), "{words} is not in: {text}");
    }
}

#[test]
fn a_store_is_not_made_over_what_is_there() {
    let scratch = Scratch::new();
    let input = raw(&scratch, scene("u8"), "little");
    let ingest = format!("ingest {input} -o {{}}/v.zarr --brick 32");
    scratch.run(&ingest);
    let before = super::files(&scratch.path("v.zarr"));
    let message = super::failed(&scratch.glassbrick(&ingest));
    assert!(message.contains("v.zarr") && message.contains("--force"), "{message}");
    assert!(super::files(&scratch.path("v.zarr")) == before);
    scratch.run(&format!("{ingest} --force --codec none"));
    assert!(super::files(&scratch.path("v.zarr")) != before);
    fs::create_dir(scratch.path("mine")).expect("a folder");
    fs::write(scratch.path("mine/letter.txt"), "dear").expect("a file");
    for target in ["{}/mine", "{}/v.raw", "{}/none/v.zarr", "/"] {
        let refused = scratch.glassbrick(&format!("ingest {input} -o {target} --force"));
        super::failed(&refused);
    }
    assert_eq!(scratch.names(), ["mine", "tf.json", "v.raw", "v.zarr"]);
    assert_eq!(super::names_in(&scratch.path("mine")), ["letter.txt"]);
}

/// The volume alone is more than the command may take.
#[test]
fn a_deep_volume_is_stored_in_little_memory() {
    let scratch = Scratch::new();
    let file = scratch.file("deep.raw", &[1; 120 * 120]);
    let length = 120 * 120 * 21_000;
    fs::OpenOptions::new().write(true).open(file).and_then(|file| file.set_len(length)).expect("a hole");
    let flags = "--extent 120x120x21000 --dtype u8 --threads 2 --codec lz4";
    let line = scratch.line(&format!("ingest {{}}/deep.raw -o {{}}/v.zarr {flags}"));
    crate::binary::glassbrick_in_little_memory(&line, &[]).succeeded();
}
