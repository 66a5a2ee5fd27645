//! Every scene is drawn as the reference draws it, whatever the bricks and however few fit.

use glassbrick::{BrickLayout, Gpu, GpuPass};
use glassbrick_tests::drawing::desc;
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::reference::Mode;
use glassbrick_tests::tolerance::{GPU, assert_depths, compare};

use super::{FEW_SLOTS, Memory, ONE_SLOT, ONE_TEXTURE, draw, scenes_and_truths};

const SMALL: BrickLayout = BrickLayout { edge: 32, halo: 2 };
const USUAL: BrickLayout = BrickLayout { edge: 64, halo: 2 };

/// Draws every scene in a way; returns the number of bricks that had to go for others.
fn agrees(gpu: &Gpu, pass: GpuPass, way: (BrickLayout, Memory)) -> u64 {
    let (mut off, mut evictions) = (Vec::new(), 0);
    for (scene, truth) in scenes_and_truths() {
        let drawn = draw(gpu, pass, way, scene, |_| ());
        let residency = drawn.report.residency;
        let difference = compare(&drawn.frame.rgba, &truth.rgba);
        if !difference.is_within(GPU) {
            off.push(format!("{}, {}, {way:?}: {difference}", scene.name, pass.name()));
        }
        assert!(drawn.report.complete, "{}, {}, {way:?}", scene.name, pass.name());
        assert!(residency.peak_bytes <= residency.budget_bytes, "{}, {way:?}: {residency:?}", scene.name);
        evictions += residency.evictions;
    }
    assert!(off.is_empty(), "{}", off.join("\n"));
    evictions
}

fn agrees_in_every_way(pass: GpuPass) {
    let Some(gpu) = gpu() else { return };
    agrees(gpu, pass, (SMALL, Memory::Plenty));
    agrees(gpu, pass, (USUAL, ONE_TEXTURE));
    let with_plenty = agrees(gpu, pass, (FEW_SLOTS, Memory::Plenty));
    assert_eq!(with_plenty, 0, "every brick has a slot");
    for layout in [FEW_SLOTS, ONE_SLOT] {
        let evictions = agrees(gpu, pass, (layout, ONE_TEXTURE));
        assert!(evictions > 100, "{layout:?}: {evictions} bricks had to go: the slots are not few");
    }
}

#[test]
fn rays_draw_every_scene_as_the_reference_does() {
    agrees_in_every_way(GpuPass::Raycast);
}

#[test]
fn slices_draw_every_scene_as_the_reference_does() {
    agrees_in_every_way(GpuPass::Slices);
}

#[test]
fn depth_by_rays_is_that_of_the_reference() {
    let Some(gpu) = gpu() else { return };
    for (scene, truth) in scenes_and_truths() {
        let drawn = draw(gpu, GpuPass::Raycast, (FEW_SLOTS, ONE_TEXTURE), scene, |_| ()).frame.depth_mm;
        let plane_mm = scene.step * desc(scene).smallest_spacing_mm();
        assert_depths(&scene.name, scene.mode, plane_mm, &drawn, &truth.z);
    }
}

#[test]
fn slices_have_no_depth() {
    let Some(gpu) = gpu() else { return };
    for mode in [Mode::Dvr, Mode::Mip, Mode::Minip, Mode::Mean] {
        let (scene, _) = scenes_and_truths().find(|(scene, _)| scene.mode == mode).expect("there is one");
        let drawn = draw(gpu, GpuPass::Slices, (SMALL, Memory::Plenty), scene, |_| ());
        assert!(drawn.frame.depth_mm.iter().all(|&depth| depth == f32::INFINITY), "{}", scene.name);
    }
}
