//! A store that is replaced while it is read gives the old picture, the new one or an error, and no mixture.

use std::process::{Child, Command, Stdio};

use glassbrick::{LevelChoice, OpenSettings};
use glassbrick_brick_store::Codec;
use glassbrick_tests::scenes::{Scene, scenes};

use super::{Scratch, assert_one_line, draw_stored};
use crate::binary::binary;

/// Of the same extent, bricks and stored type, so that nothing but their voxels tells them apart.
fn two_scenes() -> [Scene; 2] {
    let scene = scenes().iter().find(|scene| scene.name == "mode mip, step 1").expect("a scene");
    let one = Scene { width: 24, height: 18, ..scene.clone() };
    let mut other = one.clone();
    other.volume.voxels = one.volume.voxels.iter().map(|voxel| 255.0 - voxel).collect();
    [one, other]
}

/// Another process that stores one volume, then the other, again and again.
fn replacing(scratch: &Scratch, extent: [usize; 3], times: usize) -> Child {
    let [x, y, z] = extent;
    let ingest = |name: &str| {
        let binary = binary().display();
        format!(
            "'{binary}' ingest {{}}/{name} --extent {x}x{y}x{z} --dtype u8 --brick 16 --codec none --threads 1 \
             --force -o {{}}/v.zarr || exit 1; "
        )
    };
    let script = (ingest("b.raw") + &ingest("a.raw")).repeat(times);
    let mut shell = Command::new("sh");
    shell.arg("-c").arg(scratch.line(&script)).stdin(Stdio::null()).stdout(Stdio::null());
    shell.spawn().expect("a shell can be run")
}

#[test]
#[cfg(unix)]
fn a_store_that_is_replaced_is_never_mixed() {
    let scratch = Scratch::new();
    let scenes = two_scenes();
    let pictures = scenes.each_ref().map(|scene| {
        let mut here = scene.clone();
        // Where raw files lie.
        here.volume.geometry = raw_geometry();
        let store = scratch.store(&here, 16, Codec::None);
        draw(&store, scene).expect("sound")
    });
    assert!(pictures[0] != pictures[1]);
    scratch.file("a.raw", &scenes[0].volume.stored_bytes());
    scratch.file("b.raw", &scenes[1].volume.stored_bytes());
    let store = scratch.path("v.zarr");
    let mut writer = replacing(&scratch, scenes[0].volume.extent, 5);
    let (mut seen, mut refused) = ([0, 0], 0);
    while writer.try_wait().expect("it was started").is_none() {
        match draw(&store, &scenes[0]) {
            Ok(picture) => {
                let which = pictures.iter().position(|known| *known == picture);
                seen[which.expect("a picture of one volume, and not a mixture")] += 1;
            }
            Err(error) => {
                assert_one_line(&error);
                refused += 1;
            }
        }
    }
    assert!(writer.wait().expect("it was started").success());
    assert!(seen[0] > 0 && seen[1] > 0, "{seen:?} pictures, {refused} refusals");
    let names = scratch.names();
    assert_eq!(names, ["a.raw", "b.raw", "v.zarr"]);
}

fn raw_geometry() -> glassbrick_tests::scenes::Geometry {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    glassbrick_tests::scenes::Geometry { spacing: [1.0; 3], origin: [0.0; 3], direction: axes }
}

type Picture = Vec<[f32; 4]>;

/// In so little memory that bricks are read while the picture is drawn.
fn draw(store: &std::path::Path, scene: &Scene) -> Result<Picture, String> {
    let mut scene = scene.clone();
    scene.volume.geometry = raw_geometry();
    let eye = glassbrick_tests::drawing::desc(&scene);
    let camera = glassbrick::Camera::framing_around(&eye, 30.0, 20.0);
    scene.camera.eye = camera.eye_mm.to_array();
    scene.camera.target = camera.target_mm.to_array();
    scene.camera.up = camera.up.to_array();
    let settings = OpenSettings { threads: Some(1), memory_bytes: Some(20_000), ..OpenSettings::default() };
    let drawn = draw_stored(store, &scene, &settings, |request| request.level = LevelChoice::Exact(0));
    drawn.map(|drawn| drawn.frame.rgba).map_err(|error| error.to_string())
}
