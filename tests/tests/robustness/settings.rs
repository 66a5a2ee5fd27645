use std::path::PathBuf;

use super::sound_files::{metaimage, voxels};
use super::{EXIT_FAILURE, EXIT_USAGE, Scratch, refused};
use crate::binary::glassbrick;

fn sound(scratch: &Scratch) -> PathBuf {
    scratch.file("a.mha", &[metaimage("LOCAL", "").as_bytes(), &voxels()].concat())
}

#[test]
fn wrong_flags_are_usage_errors() {
    let scratch = Scratch::new();
    let input = sound(&scratch);
    for flags in [
        "--size 0x0",
        "--size 640",
        "--size 99999x1",
        "--size -1x5",
        "--step 0",
        "--step -1",
        "--step nan",
        "--opacity-cutoff 0",
        "--opacity-cutoff 1.5",
        "--alpha 2",
        "--beta -1",
        "--mode xray",
        "--shading gouraud",
        "--skip some",
        "--backend tpu",
        "--pass splat",
        "--level -1",
        "--level fine",
        "--memory much",
        "--memory -5",
        "--threads 0",
        "--threads 9999999",
        "--brick 0",
        "--brick 7",
        "--brick 100000",
        "--background blue",
        "--view inside",
        "--zoom 0",
        "--zoom nan",
        "--fov 0 --eye 0,0,0 --target 1,0,0",
        "--fov 180 --eye 0,0,0 --target 1,0,0",
        "--eye nan,0,0 --target 0,0,0",
        "--eye 1,2 --target 0,0,0",
        "--eye 1,2,3",
        "--eye 1,2,3 --target 1,2,3",
        "--eye 0,0,9 --target 0,0,0 --up 0,0,1",
        "--eye 0,0,9 --target 0,0,0 --up 0,0,0",
        "--azimuth inf",
        "--view front --azimuth 3",
        "--repeat 0",
        "--extent 12x10x8",
        "--dtype i16",
        "--extent 0x1x1 --dtype u8",
        "--extent 1x1 --dtype u8",
        "--extent 12x10x8 --dtype u128",
        "--extent 12x10x8 --dtype i16 --spacing 0,1,1",
        "--extent 12x10x8 --dtype i16 --rescale 0,1",
        "--extent 12x10x8 --dtype i16 --offset -1",
        "--endian big",
        "--time -1",
        "--no-such-flag",
    ] {
        let message = scratch.refuses(EXIT_USAGE, &input, flags);
        assert!(message.contains("--help"), "{message}");
    }
}

#[test]
fn wrong_commands_are_usage_errors() {
    for line in ["", "paint", "render", "info", "render a.nrrd", "info a b", "--nonsense", "info --json"] {
        refused(&glassbrick(line, &[]), EXIT_USAGE);
    }
}

#[test]
fn what_this_volume_or_version_cannot_do_is_said() {
    let scratch = Scratch::new();
    let input = sound(&scratch);
    for (flags, words) in [
        ("--level 3", "level 3"),
        ("--memory 1", "memory"),
        ("--memory 10KB --threads 8", "threads"),
        ("--step 1e-9", "step"),
        ("--step 1e-300", "step"),
        ("--eye 1e30,0,0 --target 0,0,0", "eye"),
        ("--time 1", "time"),
        ("--tf no-such-preset", "no-such-preset"),
        ("--tf /no/such/file.json", "/no/such/file.json"),
        ("--camera /no/such/file.json", "/no/such/file.json"),
    ] {
        let message = scratch.refuses(EXIT_FAILURE, &input, flags);
        assert!(message.contains(words), "{message}");
    }
}

#[test]
fn malformed_transfer_functions_are_refused_with_their_file() {
    let scratch = Scratch::new();
    let input = sound(&scratch);
    let point = |value: &str| format!(r#"{{"value":{value},"color":[1,1,1],"opacity":0.5}}"#);
    for json in [
        String::new(),
        "{".to_owned(),
        "[]".to_owned(),
        "null".to_owned(),
        r#"{"points":[]}"#.to_owned(),
        r#"{"points":7}"#.to_owned(),
        r#"{"points":[{"value":1}]}"#.to_owned(),
        format!(r#"{{"points":[{}]}}"#, point("NaN")),
        format!(r#"{{"points":[{}]}}"#, point("1e999")),
        format!(r#"{{"points":[{}]}}"#, point("\"1\"")),
        format!(r#"{{"points":[{},{}]}}"#, point("2"), point("1")),
        format!(r#"{{"points":[{}],"unit":0}}"#, point("1")),
        format!(r#"{{"points":[{}],"unit":-1}}"#, point("1")),
        format!(r#"{{"points":[{}],"units":1}}"#, point("1")),
        format!(r#"{{"points":[{}]}}"#, point("1").replace("0.5", "1.5")),
        format!(r#"{{"points":[{}]}}"#, point("1").replace("[1,1,1]", "[1,1]")),
        format!(r#"{{"points":[{}]}}"#, point("1").replace("[1,1,1]", "[255,0,0]")),
        "[".repeat(200_000),
        format!(r#"{{"points":{}"#, "[".repeat(200_000)),
        " ".repeat(20 << 20),
    ] {
        let tf = scratch.file("tf.json", json.as_bytes());
        let message = scratch.refuses(EXIT_FAILURE, &input, &format!("--tf {}", tf.display()));
        assert!(message.contains("tf.json"), "{message}");
    }
    let noise = scratch.file("tf.json", &[0xff, 0xfe, 0, 1]);
    scratch.refuses(EXIT_FAILURE, &input, &format!("--tf {}", noise.display()));
    let folder = scratch.input.path().display().to_string();
    scratch.refuses(EXIT_FAILURE, &input, &format!("--tf {folder}"));
}

#[test]
fn cameras_that_see_nothing_are_refused_with_their_file() {
    let scratch = Scratch::new();
    let input = sound(&scratch);
    let camera = |eye: &str, target: &str, up: &str, lens: &str| {
        format!(r#"{{"projection":"perspective","eye":{eye},"target":{target},"up":{up},{lens}}}"#)
    };
    let (eye, target, up, lens) = ("[0,-9,0]", "[0,0,0]", "[0,0,1]", r#""fov_y_deg":30"#);
    for json in [
        camera("[NaN,0,0]", target, up, lens),
        camera("[1e999,0,0]", target, up, lens),
        camera("[null,0,0]", target, up, lens),
        camera("[0,-9]", target, up, lens),
        camera(target, target, up, lens),
        camera(eye, target, "[0,1,0]", lens),
        camera(eye, target, "[0,0,0]", lens),
        camera(eye, target, up, r#""fov_y_deg":0"#),
        camera(eye, target, up, r#""fov_y_deg":-30"#),
        camera(eye, target, up, r#""height":30"#),
        camera(eye, target, up, lens).replace("perspective", "orthographic"),
        "{}".to_owned(),
        String::new(),
    ] {
        let camera = scratch.file("camera.json", json.as_bytes());
        let message = scratch.refuses(EXIT_FAILURE, &input, &format!("--camera {}", camera.display()));
        assert!(message.contains("camera.json"), "{message}");
    }
}

/// A picture of a billion pixels takes 20 GB; one of 67 million 1.3 GB, which the machine may have, but not the process.
#[test]
fn a_picture_too_large_for_the_memory_is_refused() {
    let scratch = Scratch::new();
    let input = sound(&scratch);
    let sizes = ["--size 32768x32768", "--size 8192x8192"];
    let held_to_little = if cfg!(target_os = "linux") { sizes.len() } else { 1 };
    for size in &sizes[..held_to_little] {
        let message = scratch.refuses(EXIT_FAILURE, &input, size);
        assert!(message.contains("does not fit into the memory"), "{message}");
    }
}
