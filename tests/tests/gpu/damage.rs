//! Damaged bricks are never drawn on the GPU: they are named, or left out and said to be.

use std::fs;
use std::thread;
use std::time::Duration;

use glassbrick::{
    Backend, Codec, Error, GpuPass, LevelChoice, OpenSettings, RenderRequest, Renderer, Volume,
};
use glassbrick_tests::drawing::{camera, request};
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::tolerance::GPU;

use super::{PASSES, difference, on};
use crate::store::damage::{EDGE, scene};
use crate::store::damage_kinds::Damage;
use crate::store::{Scratch, assert_one_line};

/// Where the bricks of a corner of the volume lie, which the picture shows a part of.
const SHARD: &str = "levels/0/bricks/c/0/0/0/0/0/0";

/// A store of which some bricks cannot be read: bytes all over a shard are not what they were.
fn damaged() -> Scratch {
    let scratch = Scratch::new();
    let path = scratch.store(&scene(), EDGE, Codec::None).join(SHARD);
    let mut bytes = fs::read(&path).expect("there");
    for at in (1000..bytes.len() * 3 / 4).step_by(bytes.len() / 12) {
        Damage::Flipped { at, bits: 0x10 }.inflict(&path, &bytes);
        bytes = fs::read(&path).expect("there");
    }
    scratch
}

fn open(scratch: &Scratch) -> Volume {
    let settings = OpenSettings { threads: Some(2), ..OpenSettings::default() };
    Volume::open(&scratch.path("v.zarr"), &settings, |_, _| ()).expect("bricks are not read yet")
}

fn request_of(allow_damaged: bool) -> RenderRequest {
    RenderRequest { allow_damaged, level: LevelChoice::Exact(0), ..request(&scene()) }
}

/// Holds that an error is one line that names a damaged brick and its file.
#[track_caller]
fn assert_named(error: &Error) {
    let message = error.to_string();
    assert_one_line(&message);
    assert!(message.contains("brick ") && message.contains(SHARD), "{message}");
}

#[test]
fn a_damaged_brick_is_named() {
    let Some(gpu) = gpu() else { return };
    let scratch = damaged();
    for pass in PASSES {
        let volume = open(&scratch);
        let renderer =
            Renderer::new(&volume, on(gpu, pass, request_of(false))).expect("bricks are not read yet");
        for _ in 0..2 {
            assert_named(&renderer.draw(&camera(&scene()), 1).expect_err("a brick is damaged"));
        }
    }
}

#[test]
fn damaged_bricks_are_left_out_where_that_is_allowed() {
    let Some(gpu) = gpu() else { return };
    let scratch = damaged();
    let draw = |request: RenderRequest| {
        open(&scratch).render(request, &camera(&scene())).expect("damaged bricks may be left out")
    };
    let on_cpu = draw(RenderRequest { backend: Backend::Cpu, ..request_of(true) });
    for pass in PASSES {
        let drawn = draw(on(gpu, pass, request_of(true)));
        let report = &drawn.report;
        assert!(!report.complete, "{}", pass.name());
        assert_eq!(report.bricks.damaged, on_cpu.report.bricks.damaged, "{}", pass.name());
        assert!(report.bricks.damaged > 2, "{:?}", report.bricks);
        let told = report.warnings.iter().filter(|told| told.contains("left out") && told.contains(SHARD));
        assert_eq!(told.count(), report.bricks.damaged, "{:?}", report.warnings);
        let off = difference(&drawn, &on_cpu);
        assert!(off.is_within(GPU), "{}: {off}", pass.name());
    }
}

/// Frames that do not wait tell of damage as soon as they know, and are never complete.
#[test]
fn frames_that_do_not_wait_tell_of_damage_too() {
    const MOST_FRAMES: usize = 3000;
    let Some(gpu) = gpu() else { return };
    let scratch = damaged();
    let pause = || thread::sleep(Duration::from_millis(2));
    for pass in PASSES {
        let volume = open(&scratch);
        let draws = |allow_damaged| {
            Renderer::new(&volume, on(gpu, pass, request_of(allow_damaged))).expect("bricks are not read yet")
        };
        let strict = draws(false);
        let told = (0..MOST_FRAMES).find_map(|_| {
            pause();
            strict.draw_resident(&camera(&scene())).err()
        });
        assert_named(&told.expect("a brick is damaged"));

        let damaged = open(&scratch)
            .render(on(gpu, GpuPass::Raycast, request_of(true)), &camera(&scene()))
            .expect("damaged bricks may be left out");
        let lenient = draws(true);
        let whole_but_for_damage = (0..MOST_FRAMES).find_map(|_| {
            pause();
            let drawn = lenient.draw_resident(&camera(&scene())).expect("damaged bricks may be left out");
            assert!(!drawn.report.complete, "{}", pass.name());
            let is_all_told = drawn.report.bricks.damaged == damaged.report.bricks.damaged;
            (is_all_told && difference(&drawn, &damaged).is_within(GPU)).then_some(drawn)
        });
        assert!(whole_but_for_damage.is_some(), "{}: the other bricks do not come", pass.name());
    }
}
