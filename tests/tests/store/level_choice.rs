//! Which level is drawn: what is asked for or, by `auto`, what a pixel can show.

use std::fs;

use serde_json::Value;

use super::{Scratch, failed};

const EXTENT: [f64; 3] = [90.0, 70.0, 60.0];
const SPACING: [f64; 3] = [1.0, 0.5, 1.25];
const LARGEST_SPACING: f64 = 1.25;

/// Levels of 90, 45, 23 and 12 voxels along x.
const LEVELS: u32 = 4;

/// A volume `v.raw` and its store `v.zarr`.
fn stored() -> Scratch {
    let scratch = Scratch::new();
    scratch.file("v.raw", &(0..90 * 70 * 60u32).map(|i| (i % 251) as u8).collect::<Vec<u8>>());
    scratch.run(&format!("ingest {RAW} -o {{}}/v.zarr --brick 16 --codec lz4"));
    scratch
}

const RAW: &str = "{}/v.raw --extent 90x70x60 --dtype u8 --spacing 1,0.5,1.25";

fn level_of(scratch: &Scratch, flags: &str) -> u32 {
    scratch.run(&format!("render {{}}/v.zarr --tf grey -o {{}}/a.png --report {{}}/r.json {flags}"));
    let report = fs::read(scratch.path("r.json")).expect("it was written");
    let report: Value = serde_json::from_slice(&report).expect("JSON");
    report["level"].as_u64().expect("a level") as u32
}

/// The coarsest level whose voxels are no larger than a pixel.
fn coarsest(pixel_mm: f64) -> u32 {
    (0..LEVELS).rev().find(|&level| f64::from(1 << level) * LARGEST_SPACING <= pixel_mm).unwrap_or(0)
}

fn corners() -> impl Iterator<Item = [f64; 3]> {
    (0..8).map(|corner: u32| {
        std::array::from_fn(|axis| {
            let high = corner >> axis & 1 == 1;
            SPACING[axis] * if high { EXTENT[axis] - 0.5 } else { -0.5 }
        })
    })
}

/// Distance of the nearest corner of the box along the view from an eye to a target.
fn nearest_depth(eye: [f64; 3], target: [f64; 3]) -> f64 {
    let forward: [f64; 3] = std::array::from_fn(|axis| target[axis] - eye[axis]);
    let length = forward.iter().map(|d| d * d).sum::<f64>().sqrt();
    let depth = |p: [f64; 3]| (0..3).map(|axis| (p[axis] - eye[axis]) * forward[axis]).sum::<f64>() / length;
    corners().map(depth).fold(f64::INFINITY, f64::min)
}

#[test]
fn auto_takes_the_coarsest_level_that_a_pixel_can_show_in_perspective() {
    let scratch = stored();
    let target = [44.5, 17.25, 36.875];
    let mut seen = Vec::new();
    for (eye, fov_deg, height) in [
        ([44.5, -200.0, 36.875], 30.0f64, 300),
        ([44.5, -200.0, 36.875], 30.0, 60),
        ([44.5, -200.0, 36.875], 30.0, 40),
        ([-150.0, -180.0, 90.0], 30.0, 50),
        ([-150.0, -180.0, 90.0], 60.0, 40),
        ([300.0, 20.0, 36.0], 50.0, 33),
        ([44.5, 17.0, -3000.0], 30.0, 64),
        ([100.0, 100.0, 100.0], 20.0, 16),
    ] {
        let pixel = 2.0 * nearest_depth(eye, target) * (fov_deg.to_radians() / 2.0).tan() / f64::from(height);
        let list = |p: [f64; 3]| p.map(|number| number.to_string()).join(",");
        let flags = format!(
            "--size 20x{height} --fov {fov_deg} --up 0,0.1,1 --eye {} --target {}",
            list(eye),
            list(target)
        );
        let level = level_of(&scratch, &flags);
        assert_eq!(level, coarsest(pixel), "{flags}: a pixel is {pixel} mm");
        assert_eq!(level, level_of(&scratch, &format!("{flags} --level auto")));
        seen.push(level);
    }
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen, [0, 1, 2, 3], "every level was taken");
}

#[test]
fn auto_takes_the_coarsest_level_that_a_pixel_can_show_in_orthographic() {
    let scratch = stored();
    for (height_mm, level) in
        [(49.0, 0), (99.9, 0), (100.0, 1), (199.9, 1), (200.0, 2), (399.9, 2), (400.0, 3), (5000.0, 3)]
    {
        let camera = format!(
            r#"{{"projection":"orthographic","eye":[40,-300,40],"target":[40,0,40],"up":[0,0,1],"height":{height_mm}}}"#
        );
        scratch.file("camera.json", camera.as_bytes());
        let found = level_of(&scratch, "--size 30x40 --camera {}/camera.json");
        assert_eq!(found, level, "{height_mm} mm over 40 pixels");
    }
}

#[test]
fn auto_takes_the_finest_level_inside() {
    let scratch = stored();
    for eye in ["40,10,30", "-0.4,-0.2,-0.6", "89.4,34.7,74.3"] {
        let flags = format!("--size 1x1 --eye {eye} --target 44.5,17.25,36 --fov 120");
        assert_eq!(level_of(&scratch, &flags), 0, "{eye}");
    }
}

#[test]
fn a_level_that_is_not_there_is_refused_with_those_that_are() {
    let scratch = stored();
    for level in 0..LEVELS {
        assert_eq!(level_of(&scratch, &format!("--size 20x20 --level {level}")), level);
    }
    for (input, level, last) in [("{}/v.zarr", 4, 3), ("{}/v.zarr", 4_000_000_000u32, 3), (RAW, 1, 0)] {
        let line = format!("render {input} --tf grey --size 20x20 -o {{}}/b.png --level {level}");
        let message = failed(&scratch.glassbrick(&line));
        assert!(message.contains(&format!("levels 0 to {last}")), "{message}");
        assert!(!scratch.path("b.png").exists());
    }
    scratch.run(&format!("render {RAW} --tf grey --size 20x20 -o {{}}/b.png --level auto"));
}
