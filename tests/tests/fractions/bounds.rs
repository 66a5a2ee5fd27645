//! needed ≤ rendered ≤ not occluded ≤ in the frustum ≤ not empty, where *needed* and *not empty* are found by brute force.

use std::sync::OnceLock;
use std::thread;

use glassbrick::{BrickCounts, BrickLayout, GpuPass, OpenSettings, Renderer, Skip};
use glassbrick_tests::drawing::{camera, request};
use glassbrick_tests::reference::{ReferenceScene, bricks_met, bricks_not_empty};
use glassbrick_tests::scenes::{Scene, Volume};

use super::phantoms::{CLOSE_UP, INSIDE, PRESETS, opened, phantoms, points, scene, views};
use super::{Executor, LAYOUTS};

const OPACITY_CUTOFF: f64 = 0.998;

/// Numbers of bricks, by brute force.
#[derive(Clone, Copy, Debug, Default)]
struct ByBruteForce {
    total: usize,
    not_empty: usize,
    /// That own a sample of a ray.
    met: usize,
    /// Those of them that are not empty.
    met_not_empty: usize,
    /// That own a sample with opacity.
    seen: usize,
    /// That own one before its ray is opaque.
    needed: usize,
    /// That own any sample before its ray is opaque, and are not empty.
    reached: usize,
}

impl ByBruteForce {
    fn new(scene: &Scene, core: usize) -> Self {
        let scene = ReferenceScene { opacity_cutoff: OPACITY_CUTOFF, ..scene.reference() };
        let (not_empty, rays) = (bricks_not_empty(&scene, core), bricks_met(&scene, core));
        let is_sound = |brick: usize| not_empty[brick] || !rays.seen[brick];
        assert!((0..not_empty.len()).all(is_sound), "an empty brick is seen");
        let count = |is_in: &dyn Fn(usize) -> bool| (0..not_empty.len()).filter(|&b| is_in(b)).count();
        Self {
            total: not_empty.len(),
            not_empty: count(&|b| not_empty[b]),
            met: count(&|b| rays.met[b]),
            met_not_empty: count(&|b| rays.met[b] && not_empty[b]),
            seen: count(&|b| rays.seen[b]),
            needed: count(&|b| rays.needed[b]),
            reached: count(&|b| rays.reached[b] && not_empty[b]),
        }
    }
}

/// A phantom with a transfer function, as it is seen from everywhere: what brute force says of each layout.
struct Case {
    phantom: &'static Volume,
    preset: &'static str,
    views: Vec<(Scene, [ByBruteForce; 2])>,
}

/// Every phantom with every preset. Brute force takes its time, so all tests share it.
fn cases() -> &'static [Case] {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    CASES.get_or_init(|| {
        let pairs = phantoms().iter().flat_map(|phantom| PRESETS.map(|preset| (phantom, preset)));
        thread::scope(|scope| {
            let cases: Vec<_> = pairs.map(|pair| scope.spawn(move || case(pair))).collect();
            cases.into_iter().map(|case| case.join().expect("brute force has an answer")).collect()
        })
    })
}

fn case((phantom, preset): (&'static Volume, &'static str)) -> Case {
    let view = |view| {
        let scene = scene(phantom, points(preset), view);
        let found = LAYOUTS.map(|layout| ByBruteForce::new(&scene, layout.core() as usize));
        (scene, found)
    };
    Case { phantom, preset, views: views(phantom).into_iter().map(view).collect() }
}

/// What is reported of a picture, and what brute force says of it.
struct Drawn {
    scene: &'static Scene,
    preset: &'static str,
    layout: BrickLayout,
    bricks: BrickCounts,
    found: ByBruteForce,
}

/// Draws every case; nothing where there is no GPU to draw on.
fn draw_all(executor: Executor, skip: Skip) -> Vec<Drawn> {
    let Some(device) = executor.device() else { return Vec::new() };
    let mut drawn = Vec::new();
    for Case { phantom, preset, views } in cases() {
        for (number, layout) in LAYOUTS.into_iter().enumerate() {
            let volume = opened(phantom, &OpenSettings { layout, ..OpenSettings::default() });
            let mut asked = executor.asked(device, request(&views[0].0));
            asked.settings.opacity_cutoff = OPACITY_CUTOFF;
            asked.settings.skip = skip;
            let renderer = Renderer::new(&volume, asked).expect("it can be drawn");
            for (scene, found) in views {
                let report = renderer.draw(&camera(scene), 1).expect("it can be drawn").report;
                assert!(report.complete && report.pass == executor.pass(), "{}: {report:?}", scene.name);
                drawn.push(Drawn { scene, preset, layout, bricks: report.bricks, found: found[number] });
            }
        }
    }
    drawn
}

/// Holds what is reported against brute force, with everything skipped that can be.
fn bounds_hold(executor: Executor) {
    for Drawn { scene, preset, layout, bricks, found } in &draw_all(executor, Skip::All) {
        let what = format!(
            "{}, {preset}, edge {}, {executor:?}: {bricks:?}, by brute force {found:?}",
            scene.name, layout.edge
        );
        assert_eq!(bricks.total, found.total, "{what}");
        assert_eq!(bricks.total - bricks.empty, found.not_empty, "{what}");
        assert_eq!(bricks.filtered_visible, found.not_empty, "nothing else is dropped: {what}");
        assert!(found.met_not_empty <= bricks.in_frustum, "{what}");
        let not_occluded = bricks.in_frustum - bricks.occluded;
        let stages =
            [1, found.needed, bricks.rendered, not_occluded, bricks.in_frustum, bricks.filtered_visible];
        assert!(stages.is_sorted(), "{stages:?}: {what}");
        // Rays stop one by one. Of slices, whole layers are drawn, and boxes that are larger than the bricks.
        let is_by_slices = executor == Executor::Gpu(GpuPass::Slices);
        assert!(is_by_slices || bricks.rendered <= found.reached, "more than rays reach: {what}");
        // Were nothing ever skipped, all this would hold too.
        if layout.core() < 30 {
            assert!(*preset != "ct-skin" || bricks.rendered < found.not_empty, "skin hides nothing: {what}");
            let is_beside = scene.name.ends_with(CLOSE_UP) || scene.name.ends_with(INSIDE);
            assert!(!is_beside || bricks.in_frustum < found.not_empty, "nothing lies beside it: {what}");
        }
    }
}

#[test]
fn bounds_hold_on_the_cpu() {
    bounds_hold(Executor::Cpu);
}

#[test]
fn bounds_hold_by_rays() {
    bounds_hold(Executor::Gpu(GpuPass::Raycast));
}

#[test]
fn bounds_hold_by_slices() {
    bounds_hold(Executor::Gpu(GpuPass::Slices));
}

/// The picture that others are compared with: each brick in the frustum is drawn, whatever it holds, and no ray stops.
#[test]
fn bounds_hold_where_nothing_is_skipped() {
    let executor = Executor::Gpu(GpuPass::Slices);
    for Drawn { scene, preset, layout, bricks, found } in &draw_all(executor, Skip::None) {
        let what = format!("{}, {preset}, edge {}: {bricks:?}, {found:?}", scene.name, layout.edge);
        assert_eq!(bricks.total, found.total, "{what}");
        assert!(found.met <= bricks.in_frustum, "{what}");
        assert_eq!(bricks.rendered, bricks.in_frustum, "{what}");
        let stages = [found.needed, found.seen, bricks.rendered, bricks.in_frustum, bricks.total];
        assert!(stages.is_sorted(), "{stages:?}: {what}");
        assert!(!scene.name.ends_with(CLOSE_UP) || bricks.in_frustum < bricks.total, "{what}");
    }
}
