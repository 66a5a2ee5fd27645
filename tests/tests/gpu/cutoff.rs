//! Where pixels are opaque, rays and layers end, and the picture hardly changes.

use glassbrick::{BrickLayout, GpuPass};
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::reference::{Mode, ReferenceScene, render};
use glassbrick_tests::scenes::{Scene, scenes};

use super::{Memory, ONE_TEXTURE, PASSES, draw};

const WAY: (BrickLayout, Memory) = (BrickLayout { edge: 32, halo: 2 }, ONE_TEXTURE);

fn dvr_scenes() -> impl Iterator<Item = &'static Scene> {
    scenes().iter().filter(|scene| scene.mode == Mode::Dvr)
}

/// A cutoff c adds at most 1 − c to a pixel, times 1 + specular with shading, where a ray ends and where a layer does.
#[test]
fn the_cutoff_changes_a_pixel_by_no_more_than_it_may() {
    let Some(gpu) = gpu() else { return };
    for pass in PASSES {
        let mut changed = 0;
        for scene in dvr_scenes() {
            let exact = draw(gpu, pass, WAY, scene, |_| ());
            let cutoff = 0.9;
            let cut = draw(gpu, pass, WAY, scene, |request| request.settings.opacity_cutoff = cutoff);
            let specular = scene.phong.map_or(0.0, |phong| phong.specular);
            let most = (1.0 - cutoff) * (1.0 + specular) + 1e-5;
            for (a, b) in cut.frame.rgba.iter().flatten().zip(exact.frame.rgba.iter().flatten()) {
                assert!(f64::from((a - b).abs()) <= most, "{}, {}: {a} and {b}", scene.name, pass.name());
                changed += usize::from(a != b);
            }
            assert!(cut.report.samples <= exact.report.samples, "{}", scene.name);
            assert!(cut.report.bricks.rendered <= exact.report.bricks.rendered, "{}", scene.name);
        }
        assert!(changed > 1000, "{}: the cutoff changes only {changed} pixels", pass.name());
    }
}

#[test]
fn a_ray_stops_after_exactly_the_first_sample_at_the_cutoff() {
    let Some(gpu) = gpu() else { return };
    for scene in dvr_scenes() {
        let truth = render(&ReferenceScene { opacity_cutoff: 0.7, ..scene.reference() });
        let drawn = draw(gpu, GpuPass::Raycast, WAY, scene, |request| request.settings.opacity_cutoff = 0.7);
        // A ray whose opacity is at the cutoff but for rounding may go one sample further.
        let off = drawn.frame.rgba.iter().zip(&truth.rgba);
        let off = off.filter(|(a, b)| (0..4).any(|c| (f64::from(a[c]) - b[c]).abs() > 4e-3)).count();
        assert!(off <= 1 + truth.rgba.len() / 500, "{}: {off} pixels", scene.name);
    }
}
