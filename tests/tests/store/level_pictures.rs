//! Coarser levels are drawn as the reference draws the box average of the volume.

use std::sync::Arc;

use glassbrick::{Codec, LevelChoice, OpenSettings};
use glassbrick_tests::reference::{Mode, Projection, ReferenceScene, nearest_sample_to_box, render};
use glassbrick_tests::scenes::{NEAREST_SAMPLE_TO_END, Scene, Volume, level_scenes};
use glassbrick_tests::tolerance::{CPU, compare};

use super::{Scratch, draw_stored};

/// Half the volume: each voxel the average of those of 2×2×2 that exist.
fn halved(volume: &Volume) -> Volume {
    let [nx, ny, nz] = volume.extent;
    let extent = volume.extent.map(|n| n.div_ceil(2));
    let average = |index: usize| {
        let [x, y, z] = [index % extent[0], index / extent[0] % extent[1], index / (extent[0] * extent[1])];
        let mut covered = Vec::new();
        for k in 2 * z..(2 * z + 2).min(nz) {
            for j in 2 * y..(2 * y + 2).min(ny) {
                for i in 2 * x..(2 * x + 2).min(nx) {
                    let voxel = volume.voxels[(k * ny + j) * nx + i];
                    covered.push(if (voxel as f32).is_finite() { voxel } else { 0.0 });
                }
            }
        }
        let mean = covered.iter().sum::<f64>() / covered.len() as f64;
        match volume.stored_type {
            "f64" => mean,
            "f32" => f64::from(mean as f32),
            _ => (mean + 0.5).floor(),
        }
    };
    let voxels: Arc<[f64]> = (0..extent.iter().product()).map(average).collect();
    let mut geometry = volume.geometry;
    geometry.origin = geometry.world_from_voxel([0.5; 3]);
    geometry.spacing = geometry.spacing.map(|mm| 2.0 * mm);
    Volume { extent, voxels, geometry, ..volume.clone() }
}

/// A scene at a level: as the reference draws it, and where its box ends.
fn at_level(scene: &Scene, level: u32) -> (Scene, [f64; 3]) {
    let mut coarse = scene.clone();
    // Opacities are of the length that they are of at level 0.
    let finest = scene.volume.geometry.spacing.into_iter().fold(f64::INFINITY, f64::min);
    coarse.unit = Some(scene.unit.unwrap_or(finest));
    for _ in 0..level {
        coarse.volume = halved(&coarse.volume);
    }
    let box_end = scene.volume.extent.map(|n| n as f64 / f64::from(1 << level) - 0.5);
    (coarse, box_end)
}

fn reference(coarse: &Scene, box_end: [f64; 3]) -> ReferenceScene<'_> {
    ReferenceScene { box_end: Some(box_end), ..coarse.reference() }
}

#[test]
fn a_level_is_drawn_as_the_reference_draws_the_average() {
    let modes = assert_levels_agree(|scene| scene.phong.is_none());
    for expected in [Mode::Dvr, Mode::Mip, Mode::Minip, Mode::Mean] {
        assert!(modes.contains(&expected), "{expected:?}");
    }
}

#[test]
fn a_level_is_shaded_as_the_reference_shades_the_average() {
    let modes = assert_levels_agree(|scene| scene.phong.is_some());
    assert_eq!(modes, [Mode::Dvr; 2]);
}

/// Holds that levels 1 and 2 of the scenes that are chosen agree with the reference; returns the scenes' modes.
fn assert_levels_agree(is_chosen: impl Fn(&Scene) -> bool) -> Vec<Mode> {
    let (mut off, mut modes) = (Vec::new(), Vec::new());
    for (index, scene) in level_scenes().into_iter().enumerate().filter(|(_, scene)| is_chosen(scene)) {
        let scratch = Scratch::new();
        let store = scratch.store(&scene, [12, 16][index % 2], Codec::ALL[index % 3]);
        modes.push(scene.mode);
        for level in [1, 2] {
            let (mut coarse, box_end) = at_level(&scene, level);
            // A sample on the very end of the box is inside for one executor and outside for another.
            while nearest_sample_to_box(&reference(&coarse, box_end)) < NEAREST_SAMPLE_TO_END {
                match &mut coarse.camera.projection {
                    Projection::Perspective { fov_y_deg } => *fov_y_deg *= 0.999,
                    Projection::Orthographic { height } => *height *= 0.999,
                }
            }
            let truth = render(&reference(&coarse, box_end));
            let same_view = Scene { camera: coarse.camera, ..scene.clone() };
            let drawn = draw_stored(&store, &same_view, &OpenSettings::default(), |request| {
                request.level = LevelChoice::Exact(level);
            })
            .expect("the store is sound");
            assert_eq!(drawn.report.level, level);
            assert!(truth.rgba.iter().any(|pixel| pixel[3] > 0.2), "{} shows something", scene.name);
            let difference = compare(&drawn.frame.rgba, &truth.rgba);
            if !difference.is_within(CPU) {
                off.push(format!("{}, level {level}: {difference}", scene.name));
            }
        }
    }
    assert!(off.is_empty(), "{}", off.join("\n"));
    modes
}

/// What ends at the box of level 0 must not end at the last voxel's face: the pictures differ where that is seen.
#[test]
fn the_end_of_a_level_is_seen() {
    let scene = level_scenes().into_iter().find(|scene| scene.mode == Mode::Dvr).expect("there is one");
    let (coarse, box_end) = at_level(&scene, 2);
    let right = render(&reference(&coarse, box_end));
    let wrong: Vec<[f32; 4]> =
        render(&coarse.reference()).rgba.iter().map(|pixel| pixel.map(|channel| channel as f32)).collect();
    assert!(!compare(&wrong, &right.rgba).is_within(CPU));
}
