//! The report says what the GPU did, and the same of each run.

use glassbrick::{BrickLayout, GpuPass, Renderer, Volume};
use glassbrick_tests::drawing::camera;
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::scenes::scenes;

use super::{
    FEW_SLOTS, Memory, ONE_SLOT, ONE_TEXTURE, PASSES, draw, render_with, request_on, scene, texture_bytes,
    volume,
};

/// Of many bricks, and rays that go far.
const SCENE: &str = "mode dvr, step 1";

#[test]
fn a_report_adds_up() {
    let Some(gpu) = gpu() else { return };
    let scene = scene(SCENE);
    let ways = [
        (BrickLayout { edge: 64, halo: 2 }, Memory::Plenty),
        (BrickLayout { edge: 32, halo: 2 }, ONE_TEXTURE),
        (FEW_SLOTS, ONE_TEXTURE),
        (FEW_SLOTS, Memory::Textures(3)),
        (ONE_SLOT, ONE_TEXTURE),
    ];
    for pass in PASSES {
        for (layout, memory) in ways {
            let volume = volume(scene, layout);
            let request = request_on(gpu, pass, memory, scene, &volume);
            let report = render_with(&volume, request.clone(), &camera(scene)).report;
            let what = format!("{}, {layout:?}, {memory:?}: {report:?}", pass.name());
            assert_eq!((report.backend, report.pass), ("gpu", pass.name()), "{what}");
            assert_eq!(report.adapter, gpu.adapter(), "{what}");
            assert!(!report.adapter.is_empty() && report.complete && report.warnings.is_empty(), "{what}");
            assert_eq!(report.samples.is_some(), pass == GpuPass::Raycast, "{what}");
            assert!(report.samples != Some(0), "{what}");

            let bricks = report.bricks;
            assert_eq!(bricks.rendered + bricks.occluded, bricks.in_frustum, "{what}");
            assert!(bricks.rendered > 0 && bricks.damaged == 0 && bricks.boundary_pinned == 0, "{what}");

            let residency = report.residency;
            assert_eq!(residency.budget_bytes, request.gpu_memory_bytes, "{what}");
            assert!((1..=residency.budget_bytes).contains(&residency.peak_bytes), "{what}");
            assert_eq!(residency.misses, residency.uploads, "each brick that was missing came: {what}");
            assert!(residency.uploads >= bricks.rendered as u64, "{what}");
            let texel_bytes = texture_bytes(gpu, &volume) / 256_u64.pow(3);
            assert_eq!(
                residency.bytes_uploaded,
                residency.uploads * layout.voxels() as u64 * texel_bytes,
                "{what}"
            );
            let slots = slots(layout, residency.budget_bytes / texture_bytes(gpu, &volume));
            assert_eq!(residency.evictions > 0, bricks.rendered as u64 > slots, "{what}");
            assert!(residency.evictions >= residency.uploads.saturating_sub(slots), "{what}");
        }
    }
}

/// Slots of so many atlas textures of 256³, or of the next smaller power of two, as textures that grow have.
fn slots(layout: BrickLayout, textures: u64) -> u64 {
    u64::from(256 / layout.edge).pow(3) * (1 << textures.ilog2())
}

/// Rounds depend on the plan and the slots, never on when threads bring their bricks.
#[test]
fn counts_are_the_same_from_run_to_run() {
    let Some(gpu) = gpu() else { return };
    for pass in PASSES {
        // Every other scene is enough: there are several of each kind.
        for scene in scenes().iter().step_by(2) {
            let run = || {
                let drawn = draw(gpu, pass, (FEW_SLOTS, ONE_TEXTURE), scene, |request| {
                    request.settings.opacity_cutoff = 0.9;
                });
                (drawn.report.bricks, drawn.report.samples, drawn.report.residency, drawn.frame)
            };
            assert!(run() == run(), "{}, {}", scene.name, pass.name());
        }
    }
}

#[test]
fn bricks_stay_from_picture_to_picture() {
    let Some(gpu) = gpu() else { return };
    let scene = scene(SCENE);
    for pass in PASSES {
        let volume: Volume = volume(scene, BrickLayout { edge: 32, halo: 2 });
        let request = request_on(gpu, pass, ONE_TEXTURE, scene, &volume);
        let renderer = Renderer::new(&volume, request).expect("there is room");
        let [first, second] = [0, 1].map(|_| renderer.draw(&camera(scene), 1).expect("a scene can be drawn"));
        assert!(first.report.residency.uploads > 0);
        let again = second.report.residency;
        assert_eq!((again.uploads, again.bytes_uploaded, again.misses, again.evictions), (0, 0, 0, 0));
        assert!(again.hits > 0);
        assert_eq!(first.report.bricks, second.report.bricks);
        assert!(first.frame == second.frame, "{}", pass.name());
    }
}
