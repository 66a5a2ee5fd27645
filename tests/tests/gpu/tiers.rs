//! Devices that can do other things than the one at hand draw the same pictures: what a tier leaves out is not used.

use std::env;

use glassbrick::{Gpu, GpuPass};
use glassbrick_gpu::{AdapterChoice, GpuDevice, TexelFormat, Tier};
use glassbrick_tests::gpu::{ADAPTER_VARIABLE, gpu};
use glassbrick_tests::reference::Mode;
use glassbrick_tests::tolerance::{GPU, GPU_HALF_FLOAT, Tolerance, compare};

use super::{FEW_SLOTS, Memory, PASSES, draw, scenes_and_truths};

/// The GPU at hand as if it could do less, or other things.
fn as_if(change: impl FnOnce(&mut Tier)) -> Option<Gpu> {
    gpu()?;
    let mut device = opened();
    change(&mut device.tier);
    Some(Gpu::from(device))
}

/// The GPU at hand, opened once more.
pub fn opened() -> GpuDevice {
    let name = env::var(ADAPTER_VARIABLE).ok().filter(|name| !name.is_empty());
    let choice = name.as_deref().map_or(AdapterChoice::Best, AdapterChoice::Named);
    GpuDevice::open(choice).expect("it was opened before")
}

/// Draws every scene; `tolerance` tells of a pass and a mode.
fn agrees(gpu: &Gpu, tolerance: impl Fn(GpuPass, Mode) -> Tolerance) {
    let mut off = Vec::new();
    for pass in PASSES {
        for (scene, truth) in scenes_and_truths() {
            let drawn = draw(gpu, pass, (FEW_SLOTS, Memory::Plenty), scene, |_| ());
            let difference = compare(&drawn.frame.rgba, &truth.rgba);
            if !difference.is_within(tolerance(pass, scene.mode)) {
                off.push(format!("{}, {}: {difference}", scene.name, pass.name()));
            }
        }
    }
    assert!(off.is_empty(), "{}", off.join("\n"));
}

/// As hardware is mostly: texture units too coarse for pictures, and an atlas of many textures of one cube each.
#[test]
fn coarse_filters_and_many_textures_give_the_same_pictures() {
    let Some(gpu) = as_if(|tier| (tier.filtered, tier.textures) = (Vec::new(), 16)) else { return };
    agrees(&gpu, |_, _| GPU);
}

/// No 16-bit texels, and no blending of f32: slices of direct volume rendering are blended in f16, and rays draw means.
#[test]
fn the_least_device_gives_the_same_pictures() {
    let least = as_if(|tier| {
        tier.filtered = Vec::new();
        tier.formats = vec![TexelFormat::R8, TexelFormat::Rg8, TexelFormat::R32];
        tier.blends_f32 = false;
    });
    let Some(gpu) = least else { return };
    agrees(
        &gpu,
        |pass, mode| if pass == GpuPass::Slices && mode == Mode::Dvr { GPU_HALF_FLOAT } else { GPU },
    );
    let (mean, _) = scenes_and_truths().find(|(scene, _)| scene.mode == Mode::Mean).expect("there is one");
    let drawn = draw(&gpu, GpuPass::Slices, (FEW_SLOTS, Memory::Plenty), mean, |_| ());
    assert_eq!(drawn.report.pass, "raycast", "the report says what drew");
}
