//! A GPU that goes away while pictures are drawn is said to be lost, in one line; a GPU that is opened anew draws on.

use glassbrick::{Gpu, Renderer};
use glassbrick_tests::drawing::{camera, request};
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::scenes::scenes;

use super::tiers::opened;
use super::{FEW_SLOTS, PASSES, on, volume};
use crate::store::assert_one_line;

#[test]
fn a_lost_device_is_said_and_another_draws_on() {
    if gpu().is_none() {
        return;
    }
    let scene = &scenes()[0];
    let volume = volume(scene, FEW_SLOTS);
    for pass in PASSES {
        for pictures_before in [0, 1] {
            let device = opened();
            let lost = device.device.clone();
            let request = on(&Gpu::from(device), pass, request(scene));
            let renderer = Renderer::new(&volume, request).expect("a scene is sound");
            for _ in 0..pictures_before {
                renderer.draw(&camera(scene), 1).expect("the device is there");
            }
            lost.destroy();
            let draw = || renderer.draw(&camera(scene), 1).map(|_| ());
            let draw_resident = || renderer.draw_resident(&camera(scene)).map(|_| ());
            for ended in [draw(), draw(), draw_resident()] {
                let error = ended.expect_err("there is no device").to_string();
                assert_one_line(&error);
                assert!(error.contains("lost") && error.contains("--backend cpu"), "{error}");
            }
        }
        let request = on(&Gpu::from(opened()), pass, request(scene));
        assert!(volume.render(request, &camera(scene)).expect("another device").report.complete);
    }
}
