//! The scenes are what the agreement table is promised for, and each of them shows something.

use std::collections::HashSet;

use glassbrick_tests::reference::{Mode, nearest_sample_to_box, render};
use glassbrick_tests::scenes::{NEAREST_SAMPLE_TO_END, STEEPEST_RAMP, Scene, scenes};

/// The scene in which there must be nothing to see.
const SHOWS_NOTHING: &str = "view volume behind the eye";

#[test]
fn every_scene_has_a_name_of_its_own() {
    let names: HashSet<&str> = scenes().iter().map(|scene| scene.name.as_str()).collect();
    assert_eq!(names.len(), scenes().len());
    assert!(names.contains(SHOWS_NOTHING));
}

#[test]
fn every_stored_type_and_mode_is_drawn_and_its_values_survive_storing() {
    let types: HashSet<&str> = scenes().iter().map(|scene| scene.volume.stored_type).collect();
    assert_eq!(types.len(), 8);
    for mode in [Mode::Dvr, Mode::Mip, Mode::Minip, Mode::Mean] {
        assert!(scenes().iter().any(|scene| scene.mode == mode));
    }
    for Scene { name, volume, .. } in scenes() {
        let stored = stored_values(volume.stored_type, &volume.stored_bytes());
        let same = |(a, b): (&f64, &f64)| a == b || (a.is_nan() && b.is_nan());
        assert_eq!(stored.len(), volume.voxels.len(), "{name}");
        assert!(stored.iter().zip(volume.voxels.iter()).all(same), "{name}");
    }
}

fn stored_values(stored_type: &str, bytes: &[u8]) -> Vec<f64> {
    fn values<const N: usize>(bytes: &[u8], value: impl Fn([u8; N]) -> f64) -> Vec<f64> {
        bytes.as_chunks().0.iter().map(|&voxel| value(voxel)).collect()
    }
    match stored_type {
        "u8" => values(bytes, |v| u8::from_le_bytes(v).into()),
        "i8" => values(bytes, |v| i8::from_le_bytes(v).into()),
        "u16" => values(bytes, |v| u16::from_le_bytes(v).into()),
        "i16" => values(bytes, |v| i16::from_le_bytes(v).into()),
        "u32" => values(bytes, |v| u32::from_le_bytes(v).into()),
        "i32" => values(bytes, |v| i32::from_le_bytes(v).into()),
        "f32" => values(bytes, |v| f32::from_le_bytes(v).into()),
        "f64" => values(bytes, f64::from_le_bytes),
        other => panic!("{other} is not a stored type"),
    }
}

#[test]
fn no_ramp_is_steeper_than_the_agreement_table_allows() {
    for Scene { name, points, volume, .. } in scenes() {
        let shortest = STEEPEST_RAMP * (volume.value_range[1] - volume.value_range[0]);
        for pair in points.windows(2) {
            assert!(pair[1].value - pair[0].value >= 0.999_999 * shortest, "{name}: {pair:?}");
        }
    }
}

#[test]
fn no_sample_lies_on_the_very_end_of_a_volume() {
    for scene in scenes() {
        let nearest = nearest_sample_to_box(&scene.reference());
        assert!(
            nearest >= NEAREST_SAMPLE_TO_END,
            "{}: {nearest:.1e} voxels from the volume's end",
            scene.name
        );
    }
}

#[test]
fn every_scene_shows_something() {
    for scene in scenes() {
        let frame = render(&scene.reference());
        let covered = frame.rgba.iter().filter(|pixel| pixel[3] > 0.01).count();
        let enough = scene.width * scene.height / 10;
        assert_eq!(covered > enough, scene.name != SHOWS_NOTHING, "{}: {covered} pixels", scene.name);
        assert!(frame.rgba.iter().flatten().all(|channel| channel.is_finite()), "{}", scene.name);
    }
}
