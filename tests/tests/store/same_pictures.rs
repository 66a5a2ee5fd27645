//! The picture of a store at level 0 is that of its volume.

use glassbrick::{BrickLayout, Codec, Frame, LevelChoice, OpenSettings, Skip};
use glassbrick_tests::drawing::{desc, draw_with};
use glassbrick_tests::scenes::{Scene, scenes};
use glassbrick_tests::tolerance::{SAME_KERNEL, compare};

use super::{Scratch, draw_stored};

const SKIPS: [Skip; 3] = [Skip::None, Skip::Empty, Skip::All];

/// Where rays may stop early.
const CUTOFF: f64 = 0.95;

fn settings(edge: u32, threads: usize, memory_bytes: Option<u64>) -> OpenSettings {
    let layout = BrickLayout { edge, halo: 2 };
    OpenSettings { layout, threads: Some(threads), memory_bytes, ..OpenSettings::default() }
}

/// Memory that holds `bricks` bricks beside those that the threads work on: voxels, finer cells and all.
fn memory_for(scene: &Scene, edge: u32, threads: usize, bricks: u64) -> Option<u64> {
    let voxels = u64::from(edge).pow(3);
    let kept_bytes = desc(scene).stored_type.bytes().min(4) as u64;
    Some((bricks + threads as u64) * (voxels * kept_bytes * 5 / 4 + 2000))
}

#[track_caller]
fn assert_same(scene: &Scene, what: &str, stored: &Frame, flat: &Frame) {
    let exact: Vec<[f64; 4]> = flat.rgba.iter().map(|pixel| pixel.map(f64::from)).collect();
    let difference = compare(&stored.rgba, &exact);
    assert!(difference.is_within(SAME_KERNEL), "{}: {what}: {difference}", scene.name);
    let depths = stored.depth_mm.iter().zip(&flat.depth_mm);
    for (stored, flat) in depths {
        assert!(stored == flat || (stored - flat).abs() < 1e-3, "{}: {what}: {stored} {flat}", scene.name);
    }
}

/// Draws a scene of its store and of the volume. Ways are numbers of threads, and of bricks that memory holds.
fn compare_scene(scene: &Scene, edge: u32, codec: Codec, skips: &[Skip], ways: &[(usize, Option<u64>)]) {
    let scratch = Scratch::new();
    let store = scratch.store(scene, edge, codec);
    for &skip in skips {
        let flat = draw_with(scene, &settings(edge, 2, None), |request| {
            request.settings.skip = skip;
            request.settings.opacity_cutoff = CUTOFF;
        });
        for &(threads, memory) in ways {
            let memory = memory.and_then(|bricks| memory_for(scene, edge, threads, bricks));
            let what = format!("{skip:?}, {}, {threads} threads, {memory:?} bytes", codec.name());
            let drawn = draw_stored(&store, scene, &settings(64, threads, memory), |request| {
                request.settings.skip = skip;
                request.settings.opacity_cutoff = CUTOFF;
                request.level = LevelChoice::Exact(0);
            });
            let drawn = drawn.unwrap_or_else(|error| panic!("{}: {what}: {error}", scene.name));
            assert_same(scene, &what, &drawn.frame, &flat.frame);
            let [stored, flat] = [&drawn.report, &flat.report];
            assert_eq!((stored.bricks.empty, stored.level), (flat.bricks.empty, 0), "{}: {what}", scene.name);
            assert_eq!(stored.not_finite, flat.not_finite, "{}: {what}", scene.name);
            assert_eq!(stored.volume, flat.volume, "{}: {what}", scene.name);
            assert!(stored.residency.peak_bytes <= memory.unwrap_or(u64::MAX), "{}: {what}", scene.name);
            assert!(stored.complete && stored.warnings == flat.warnings, "{}: {what}", scene.name);
        }
    }
}

/// Every stored type, NaN, geometry, camera, transfer function and mode, each with one codec, layout, number of threads
/// and amount of memory of many.
#[test]
fn every_scene_is_drawn_of_its_store_as_of_its_volume() {
    for (index, scene) in scenes().iter().enumerate() {
        let codec = Codec::ALL[index % 3];
        let edge = [32, 16, 64, 24][index % 4];
        let way = [(1, Some(0)), (2, Some(6)), (5, None)][index / 2 % 3];
        compare_scene(scene, edge, codec, &[SKIPS[index / 3 % 3]], &[way]);
    }
}

/// Every codec with all the rest, in each mode.
#[test]
fn memory_threads_and_codecs_change_nothing() {
    let modes = scenes().iter().filter(|scene| scene.name.starts_with("mode ") && scene.step == 1.0);
    let ways = [(1, Some(0)), (1, Some(3)), (3, Some(3)), (2, Some(40)), (1, None), (4, None)];
    let mut count = 0;
    for scene in modes {
        for codec in Codec::ALL {
            compare_scene(scene, 32, codec, &SKIPS, &ways);
        }
        count += 1;
    }
    assert_eq!(count, 5, "dvr, dvr shaded, mip, minip and mean");
}
