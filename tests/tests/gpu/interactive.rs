//! A frame that waits for nothing says what it lacks, and those that follow lack less until nothing is missing.

use std::thread;
use std::time::Duration;

use glassbrick::{BrickLayout, Camera, Rendered, Renderer};
use glassbrick_tests::drawing::camera;
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::scenes::Scene;
use glassbrick_tests::tolerance::GPU;

use super::{
    FEW_SLOTS, Memory, ONE_SLOT, ONE_TEXTURE, PASSES, difference, render_with, request_on, scene, volume,
};

/// Scenes of several bricks, in modes of either kind.
const SCENES: [&str; 3] = ["mode dvr shaded, step 1", "mode mip, step 1", "view inside"];

/// More frames than any scene takes on a busy machine.
const MOST_FRAMES: usize = 3000;
const PAUSE: Duration = Duration::from_millis(2);

/// Draws frames that do not wait, until `is_enough` says so of one; returns it.
#[track_caller]
fn draw_until(
    renderer: &Renderer,
    camera: &Camera,
    mut is_enough: impl FnMut(&Rendered) -> bool,
) -> Rendered {
    for _ in 0..MOST_FRAMES {
        let drawn = renderer.draw_resident(camera).expect("a scene can be drawn");
        if is_enough(&drawn) {
            return drawn;
        }
        thread::sleep(PAUSE);
    }
    panic!("{MOST_FRAMES} frames are not enough");
}

/// The scene's picture from another side.
fn from_the_other_side(scene: &Scene) -> Camera {
    let camera = camera(scene);
    Camera { eye_mm: 2.0 * camera.target_mm - camera.eye_mm, ..camera }
}

#[test]
fn frames_that_do_not_wait_converge_to_the_whole_picture() {
    let Some(gpu) = gpu() else { return };
    for pass in PASSES {
        for scene in SCENES.map(scene) {
            for layout in [BrickLayout { edge: 24, halo: 2 }, FEW_SLOTS] {
                let what = format!("{}, {}, {layout:?}", scene.name, pass.name());
                let volume = volume(scene, layout);
                let request = request_on(gpu, pass, Memory::Plenty, scene, &volume);
                let whole = render_with(&volume, request.clone(), &camera(scene));
                let renderer = Renderer::new(&volume, request.clone()).expect("there is room");
                let first = renderer.draw_resident(&camera(scene)).expect("a scene can be drawn");
                let is_whole = difference(&first, &whole).is_within(GPU);
                assert!(!first.report.complete || is_whole, "{what}: complete at once, and is not");
                let last = draw_until(&renderer, &camera(scene), |drawn| drawn.report.complete);
                let off = difference(&last, &whole);
                assert!(off.is_within(GPU), "{what}: {off}");

                // Another view begins with what is there.
                let other = from_the_other_side(scene);
                let whole = render_with(&volume, request, &other);
                let last = draw_until(&renderer, &other, |drawn| drawn.report.complete);
                let off = difference(&last, &whole);
                assert!(off.is_within(GPU), "{what}, other side: {off}");
            }
        }
    }
}

/// Where not all bricks of a frame have slots, it may never be complete without waiting. It never says that it is when it
/// is not, and drawing it with waiting is not disturbed.
#[test]
fn with_too_few_slots_no_frame_says_that_it_is_complete_and_is_not() {
    let Some(gpu) = gpu() else { return };
    for pass in PASSES {
        for (scene, layout) in [(scene(SCENES[0]), FEW_SLOTS), (scene(SCENES[1]), ONE_SLOT)] {
            let volume = volume(scene, layout);
            let request = request_on(gpu, pass, ONE_TEXTURE, scene, &volume);
            let whole = render_with(&volume, request.clone(), &camera(scene));
            let renderer = Renderer::new(&volume, request.clone()).expect("there is room");
            let what = format!("{}, {}", scene.name, pass.name());
            for _ in 0..20 {
                let drawn = renderer.draw_resident(&camera(scene)).expect("a scene can be drawn");
                let residency = drawn.report.residency;
                assert!(residency.peak_bytes <= request.gpu_memory_bytes, "{what}: {residency:?}");
                let off = difference(&drawn, &whole);
                assert!(!drawn.report.complete || off.is_within(GPU), "{what}: {off}");
                thread::sleep(PAUSE);
            }
            let waited = renderer.draw(&camera(scene), 1).expect("a scene can be drawn");
            let off = difference(&waited, &whole);
            assert!(waited.report.complete && off.is_within(GPU), "{what}: {off}");
        }
    }
}

/// Boundary bricks come before they are needed, and take half the slots at most.
#[test]
fn boundary_bricks_are_prefetched_and_pinned() {
    let Some(gpu) = gpu() else { return };
    let scene = scene("mode dvr, step 1");
    let ways = [
        (BrickLayout { edge: 64, halo: 2 }, Memory::Plenty),
        (BrickLayout { edge: 24, halo: 2 }, ONE_TEXTURE),
        (FEW_SLOTS, Memory::Plenty),
        (FEW_SLOTS, ONE_TEXTURE),
        (ONE_SLOT, ONE_TEXTURE),
    ];
    for pass in PASSES {
        for (layout, memory) in ways {
            let what = format!("{}, {layout:?}, {memory:?}", pass.name());
            let volume = volume(scene, layout);
            let request = request_on(gpu, pass, memory, scene, &volume);
            let whole = render_with(&volume, request.clone(), &camera(scene));
            let renderer = Renderer::new(&volume, request).expect("there is room");
            let pinned = renderer.pin_boundary(&camera(scene)).expect("a scene has boundary bricks");
            let visible = whole.report.bricks.filtered_visible;
            if memory == ONE_TEXTURE {
                let slots = (256 / layout.edge as usize).pow(3);
                assert_eq!(pinned, visible.min(slots / 2), "{what}");
            } else {
                assert_eq!(pinned, visible, "{what}");
            }

            let away = looking_away(scene);
            let mut uploads = 0;
            draw_until(&renderer, &away, |drawn| {
                uploads += drawn.report.residency.uploads;
                uploads >= pinned as u64
            });
            assert_eq!(uploads, pinned as u64, "{what}: no other brick came");

            let drawn = renderer.draw(&camera(scene), 1).expect("a scene can be drawn");
            assert_eq!(drawn.report.bricks.boundary_pinned, pinned, "{what}");
            let off = difference(&drawn, &whole);
            assert!(off.is_within(GPU) && drawn.report.complete, "{what}: {off}");
            if pinned == visible {
                assert_eq!(drawn.report.residency.uploads, 0, "{what}: all were there");
            }
        }
    }
}

/// What is pinned stays, whatever else has to come and go: pinning it once more loads nothing.
#[test]
fn pinned_bricks_stay() {
    let Some(gpu) = gpu() else { return };
    let scene = scene("mode dvr, step 1");
    let many_bricks = BrickLayout { edge: 100, halo: 40 };
    for pass in PASSES {
        for (layout, textures) in [(FEW_SLOTS, 1), (many_bricks, 2)] {
            let what = format!("{}, {layout:?}, {textures} textures", pass.name());
            let volume = volume(scene, layout);
            let request = request_on(gpu, pass, Memory::Textures(textures), scene, &volume);
            let renderer = Renderer::new(&volume, request).expect("there is room");
            let pin = || renderer.pin_boundary(&camera(scene)).expect("a scene has boundary bricks");
            let pinned = pin();
            assert_eq!(pinned as u64, 8 * textures / 2, "{what}: half the slots");
            let mut uploads = 0;
            draw_until(&renderer, &looking_away(scene), |drawn| {
                uploads += drawn.report.residency.uploads;
                uploads >= pinned as u64
            });
            for _ in 0..2 {
                let report = renderer.draw(&camera(scene), 1).expect("a scene can be drawn").report;
                assert!(report.residency.evictions > 0, "{what}: there are more bricks than slots");
                assert_eq!(report.bricks.boundary_pinned, pinned, "{what}");
            }
            assert_eq!(pin(), pinned, "{what}");
            for _ in 0..20 {
                let away = renderer.draw_resident(&looking_away(scene)).expect("a scene can be drawn");
                assert_eq!(away.report.residency.uploads, 0, "{what}: a pinned brick had to come again");
                thread::sleep(PAUSE);
            }
        }
    }
}

fn looking_away(scene: &Scene) -> Camera {
    let camera = camera(scene);
    Camera { target_mm: 2.0 * camera.eye_mm - camera.target_mm, ..camera }
}
