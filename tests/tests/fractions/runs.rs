//! What is reported depends on what was asked for, not on chance, nor on the order in which threads come by.

use std::path::Path;

use glassbrick::{
    BrickCounts, BrickLayout, Codec, Frame, GpuPass, LevelChoice, OpenSettings, RenderRequest, Renderer,
    ResidencyCounts, Volume,
};
use glassbrick_tests::drawing::{camera, request};
use glassbrick_tests::scenes::Scene;

use super::Executor;
use super::phantoms::{opened, phantoms, points, scene, views};
use crate::gpu::texture_bytes;
use crate::store::Scratch;

/// How bricks are kept.
#[derive(Clone, Copy, Debug)]
struct Way {
    edge: u32,
    /// Memory for decoded bricks, and one atlas texture; more than enough of both where nothing is said.
    memory_bytes: Option<u64>,
}

/// The body has 48 bricks of edge 64, of which a texture has 64 slots, and 12 of edge 90, of which it has 8. Memory holds
/// a few of either.
const WAYS: [Way; 3] = [
    Way { edge: 64, memory_bytes: None },
    Way { edge: 64, memory_bytes: Some(4 << 20) },
    Way { edge: 90, memory_bytes: Some(8 << 20) },
];

/// What is said of a picture.
type Told = (BrickCounts, Option<u64>, ResidencyCounts, Frame);

/// A fresh volume, of a store or of an array, drawn by a fresh renderer from three sides.
fn run(executor: Executor, way: Way, threads: usize, store: Option<&Path>, scenes: &[Scene]) -> Vec<Told> {
    let device = executor.device().expect("it was there before");
    let layout = BrickLayout { edge: way.edge, halo: 2 };
    let memory_bytes = way.memory_bytes;
    let settings = OpenSettings { layout, memory_bytes, threads: Some(threads), ..OpenSettings::default() };
    let volume = match store {
        Some(path) => Volume::open(path, &settings, |_, _| ()).expect("the store is sound"),
        None => opened(&phantoms()[2], &settings),
    };
    let asked = executor.asked(device, request(&scenes[0]));
    let mut asked = RenderRequest { level: LevelChoice::Exact(0), ..asked };
    asked.settings.opacity_cutoff = 0.998;
    if let (Some(gpu), Some(_)) = (device, memory_bytes) {
        asked.gpu_memory_bytes = texture_bytes(gpu, &volume);
    }
    let renderer = Renderer::new(&volume, asked).expect("there is room");
    let draw = |scene| {
        let drawn = renderer.draw(&camera(scene), 1).expect("it can be drawn");
        (drawn.report.bricks, drawn.report.samples, drawn.report.residency, drawn.frame)
    };
    scenes.iter().map(draw).collect()
}

/// Counters without those that tell how several threads met.
///
/// The CPU asks for bricks in the plan's order, and a GPU's slots are filled in the order of its rounds, whatever threads do.
/// Only what the loaders of a GPU's bricks find in memory for few bricks depends on which of them was faster.
fn without_meetings(
    executor: Executor,
    way: Way,
    threads: usize,
    counts: ResidencyCounts,
) -> ResidencyCounts {
    match executor {
        Executor::Gpu(_) if threads > 1 && way.memory_bytes.is_some() => {
            ResidencyCounts { bytes_read: 0, ..counts }
        }
        Executor::Cpu | Executor::Gpu(_) => counts,
    }
}

fn runs_are_the_same(executor: Executor) {
    if executor.device().is_none() {
        return;
    }
    let phantom = &phantoms()[2];
    let mut evictions = 0;
    for preset in ["ct-skin", "haze"] {
        let [front, turned, inside, _] = views(phantom);
        let scenes = [front, turned, inside].map(|view| scene(phantom, points(preset), view));
        for way in WAYS {
            let scratch = Scratch::new();
            let store = scratch.store(&scenes[0], way.edge, Codec::Lz4);
            for (store, threads) in [None, Some(store.as_path())].into_iter().flat_map(|s| [(s, 1), (s, 2)]) {
                let [first, second] = [0, 1].map(|_| run(executor, way, threads, store, &scenes));
                for (scene, (first, second)) in scenes.iter().zip(first.iter().zip(&second)) {
                    let from = if store.is_some() { "a store" } else { "an array" };
                    let what = format!(
                        "{} from {from}, {preset}, {executor:?}, {way:?}, {threads} threads",
                        scene.name
                    );
                    assert_eq!((first.0, first.1), (second.0, second.1), "{what}");
                    let [a, b] = [first, second].map(|told| without_meetings(executor, way, threads, told.2));
                    assert_eq!(a, b, "{what}");
                    assert!(first.3 == second.3, "another picture: {what}");
                    assert!(first.2.bytes_read == 0 || store.is_some(), "{what}");
                    evictions += first.2.evictions;
                }
            }
        }
    }
    assert!(evictions > 0, "memory is never short");
}

#[test]
fn runs_on_the_cpu_are_the_same() {
    runs_are_the_same(Executor::Cpu);
}

#[test]
fn runs_by_rays_are_the_same() {
    runs_are_the_same(Executor::Gpu(GpuPass::Raycast));
}

#[test]
fn runs_by_slices_are_the_same() {
    runs_are_the_same(Executor::Gpu(GpuPass::Slices));
}
