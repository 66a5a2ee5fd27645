//! Every executor gives the picture that the reference gives, bricked or whole, whatever it skips.

use std::path::Path;

use glassbrick::{
    BrickLayout, Endian, Frame, InstructionSet, NearlyEmpty, OpenOptions, OpenSettings, RawLayout,
    RenderRequest, Skip, Volume,
};
use glassbrick_tests::drawing::{camera, desc, draw, draw_with, native_bytes, request};
use glassbrick_tests::reference::{self, Mode, render};
use glassbrick_tests::scenes::{Scene, scenes};
use glassbrick_tests::tolerance::{CPU, SAME_KERNEL, assert_depths, compare};

/// A brick that holds any of the scenes' volumes whole.
const UNBRICKED: u32 = 256;

fn same_picture(name: &str, what: &str, a: &Frame, b: &Frame) {
    let exact: Vec<[f64; 4]> = b.rgba.iter().map(|pixel| pixel.map(f64::from)).collect();
    let difference = compare(&a.rgba, &exact);
    assert!(difference.is_within(SAME_KERNEL), "{name}: {what}: {difference}");
    for (a, b) in a.depth_mm.iter().zip(&b.depth_mm) {
        assert!(a == b || (a - b).abs() < 1e-3, "{name}: {what}: depth {a} and {b}");
    }
}

/// What this processor can draw with.
fn instruction_sets() -> impl Iterator<Item = InstructionSet> {
    InstructionSet::ALL.into_iter().filter(|set| set.is_available())
}

fn with(layout: BrickLayout) -> OpenSettings {
    OpenSettings { layout, ..OpenSettings::default() }
}

#[test]
fn the_cpu_draws_every_scene_as_the_reference_does() {
    let mut off = Vec::new();
    for scene in scenes() {
        let truth = render(&scene.reference());
        for set in instruction_sets() {
            for edge in [32, 64] {
                let drawn = draw_with(scene, &with(BrickLayout { edge, halo: 2 }), |request| {
                    request.instruction_set = Some(set);
                });
                let difference = compare(&drawn.frame.rgba, &truth.rgba);
                if !difference.is_within(CPU) {
                    off.push(format!("{}, {}, bricks of {edge}: {difference}", scene.name, set.name()));
                }
            }
        }
    }
    assert!(off.is_empty(), "{}", off.join("\n"));
}

#[test]
fn depth_is_that_of_the_reference() {
    for scene in scenes() {
        let truth = render(&scene.reference());
        let drawn = draw(scene, 32).frame.depth_mm;
        let plane_mm = scene.step * desc(scene).smallest_spacing_mm();
        assert_depths(&scene.name, scene.mode, plane_mm, &drawn, &truth.z);
    }
}

#[test]
fn bricked_is_unbricked() {
    for scene in scenes() {
        let whole = draw(scene, UNBRICKED);
        for layout in
            [BrickLayout { edge: 16, halo: 2 }, BrickLayout { edge: 32, halo: 3 }, BrickLayout::default()]
        {
            let bricked = draw_with(scene, &with(layout), |_| ());
            same_picture(&scene.name, &format!("{layout:?}"), &bricked.frame, &whole.frame);
        }
    }
}

#[test]
fn threads_memory_and_skipping_change_nothing() {
    for scene in scenes() {
        let layout = BrickLayout { edge: 32, halo: 2 };
        let plain = draw_with(scene, &with(layout), |request| request.settings.skip = Skip::None);
        for (threads, memory_bytes) in [(1, 300_000), (5, 1_000_000), (2, 1 << 30)] {
            let settings =
                OpenSettings { threads: Some(threads), memory_bytes: Some(memory_bytes), ..with(layout) };
            for skip in [Skip::Empty, Skip::All] {
                let drawn = draw_with(scene, &settings, |request| request.settings.skip = skip);
                let what = format!("{skip:?}, {threads} threads, {memory_bytes} bytes");
                same_picture(&scene.name, &what, &drawn.frame, &plain.frame);
                assert!(drawn.report.residency.peak_bytes <= memory_bytes, "{}: {what}", scene.name);
            }
        }
    }
}

#[test]
fn counts_are_the_same_on_any_number_of_threads() {
    for scene in scenes() {
        let counts = |threads| {
            let settings = OpenSettings { threads: Some(threads), ..with(BrickLayout { edge: 24, halo: 2 }) };
            let drawn = draw_with(scene, &settings, |request| request.settings.opacity_cutoff = 0.9);
            (drawn.report.bricks, drawn.report.samples, drawn.frame)
        };
        assert!(counts(1) == counts(4), "{}", scene.name);
    }
}

#[test]
fn a_file_in_either_byte_order_is_the_array() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let mut seen = Vec::new();
    for scene in scenes() {
        if seen.contains(&scene.volume.stored_type) {
            continue;
        }
        seen.push(scene.volume.stored_type);
        let scene = &along_the_axes(scene);
        let array = draw(scene, 32);
        assert!(array.report.bricks.rendered > 0);
        for endian in [Endian::Little, Endian::Big] {
            let path = folder.path().join(format!("{}-{endian:?}.raw", scene.volume.stored_type));
            std::fs::write(&path, in_file(scene, endian)).expect("a scratch file");
            let drawn = draw_file(scene, &path, endian);
            same_picture(&scene.name, &format!("{endian:?} file"), &drawn, &array.frame);
        }
    }
    assert_eq!(seen.len(), 8);
}

/// The scene with its volume where raw files lie, seen by the default framing.
fn along_the_axes(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.volume.geometry.origin = [0.0; 3];
    scene.volume.geometry.direction = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let camera = glassbrick::Camera::framing_around(&desc(&scene), 30.0, 20.0);
    scene.camera = reference::Camera {
        projection: reference::Projection::Perspective { fov_y_deg: 30.0 },
        eye: camera.eye_mm.to_array(),
        target: camera.target_mm.to_array(),
        up: camera.up.to_array(),
    };
    scene
}

/// A scene's voxels behind a header of odd length.
fn in_file(scene: &Scene, endian: Endian) -> Vec<u8> {
    let mut voxels = native_bytes(scene);
    if endian != Endian::NATIVE {
        voxels.chunks_exact_mut(desc(scene).stored_type.bytes()).for_each(<[u8]>::reverse);
    }
    [&[7; 13], voxels.as_slice()].concat()
}

fn draw_file(scene: &Scene, path: &Path, endian: Endian) -> Frame {
    let desc = desc(scene);
    let raw = RawLayout {
        extent: desc.extent,
        stored_type: desc.stored_type,
        endian,
        spacing_mm: desc.spacing_mm,
        offset_bytes: 13,
        rescale: desc.rescale,
    };
    let format = OpenOptions { raw: Some(raw), time: None };
    let settings = OpenSettings { format, ..with(BrickLayout { edge: 32, halo: 2 }) };
    let volume = Volume::open(path, &settings, |_, _| ()).expect("the file is sound");
    volume.render(request(scene), &camera(scene)).expect("it can be drawn").frame
}

/// A cutoff c adds at most 1 − c to a pixel, times 1 + specular with shading.
#[test]
fn the_cutoff_changes_a_pixel_by_no_more_than_it_may() {
    for scene in scenes().iter().filter(|scene| scene.mode == Mode::Dvr) {
        let exact = draw(scene, 32);
        for cutoff in [0.5, 0.9, 0.998] {
            let cut = draw_with(scene, &with(BrickLayout { edge: 32, halo: 2 }), |request| {
                request.settings.opacity_cutoff = cutoff;
            });
            let specular = scene.phong.map_or(0.0, |phong| phong.specular);
            let most = (1.0 - cutoff) * (1.0 + specular) + 1e-5;
            for (a, b) in cut.frame.rgba.iter().flatten().zip(exact.frame.rgba.iter().flatten()) {
                assert!(f64::from((a - b).abs()) <= most, "{} at {cutoff}: {a} and {b}", scene.name);
            }
            assert!(cut.report.samples <= exact.report.samples);
        }
    }
}

#[test]
fn a_ray_stops_after_exactly_the_first_sample_at_the_cutoff() {
    for scene in scenes().iter().filter(|scene| scene.mode == Mode::Dvr) {
        let truth = render(&reference::ReferenceScene { opacity_cutoff: 0.7, ..scene.reference() });
        let drawn = draw_with(scene, &with(BrickLayout { edge: 32, halo: 2 }), |request| {
            request.settings.opacity_cutoff = 0.7;
        });
        // A ray whose opacity is at the cutoff but for rounding may go one sample further.
        let off = drawn.frame.rgba.iter().zip(&truth.rgba);
        let off = off.filter(|(a, b)| (0..4).any(|c| (f64::from(a[c]) - b[c]).abs() > 1e-3)).count();
        assert!(off <= 1 + truth.rgba.len() / 1000, "{}: {off} pixels", scene.name);
    }
}

#[test]
fn dropping_nearly_empty_bricks_is_said_to_be_lossy() {
    let scene = scenes().iter().find(|scene| scene.mode == Mode::Dvr).expect("there is one");
    let drop = |alpha, beta| {
        draw_with(scene, &with(BrickLayout { edge: 16, halo: 2 }), |request: &mut RenderRequest| {
            request.nearly_empty = NearlyEmpty { alpha, beta };
        })
        .report
    };
    let (exact, lossy) = (drop(0.0, 1.0), drop(0.9, 0.5));
    assert!(lossy.bricks.filtered_visible < exact.bricks.filtered_visible);
    assert_eq!(lossy.bricks.empty, exact.bricks.empty);
    assert!(lossy.warnings.iter().any(|warning| warning.contains("not exact")));
    assert!(exact.warnings.is_empty(), "{:?}", exact.warnings);
}

#[test]
fn a_picture_reports_its_own_residency_and_not_that_of_the_pictures_before() {
    let scene = scenes().iter().find(|scene| scene.mode == Mode::Dvr).expect("there is one");
    let settings = with(BrickLayout { edge: 16, halo: 2 });
    let volume =
        Volume::from_array(desc(scene), native_bytes(scene), &settings).expect("a scene's array is sound");
    let draw =
        || volume.render(request(scene), &camera(scene)).expect("a scene can be drawn").report.residency;
    let (first, second) = (draw(), draw());
    assert!(first.misses > 0);
    assert_eq!(second.misses, 0, "the bricks are there already");
}
