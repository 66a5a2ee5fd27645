//! Real volumes on the GPU are what they are on the CPU, and what is hidden of them is not drawn.

use glassbrick::{
    Camera, Gpu, GpuPass, Mode, NamedView, RenderRequest, Rendered, Skip, TransferFunction, Volume, preset,
};
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::tolerance::GPU;

use super::{Memory, ONE_TEXTURE, PASSES, difference, on};
use crate::real_data::{data, open};

const HEAD: &str = "vhp-male-head-ct/head-245-dicom.tar.xz:Head";
const MRI: &str = "studyforrest-t1-mri-dicom/dicoms-384.tar.xz:dicoms";

fn draw(volume: &Volume, view: NamedView, request: RenderRequest) -> Rendered {
    volume.render(request, &Camera::framing(volume.desc(), view)).expect("it can be drawn")
}

fn named(volume: &Volume, name: &str) -> TransferFunction {
    preset(name, volume.value_range()).expect("a preset")
}

fn draws_as_the_cpu(gpu: &Gpu, volume: &Volume, view: NamedView, function: &str, mode: Mode) {
    let mut request = RenderRequest { size: [160, 120], ..RenderRequest::new(named(volume, function)) };
    request.settings.mode = mode;
    // Slices go on to the end of a layer where rays stop.
    request.settings.opacity_cutoff = 1.0;
    let on_cpu = draw(volume, view, request.clone());
    let seen = on_cpu.frame.rgba.iter().filter(|pixel| pixel[3] > 0.02).count();
    assert!(seen > 300, "{function}: {seen} pixels show something");
    for pass in PASSES {
        for memory in [ONE_TEXTURE, Memory::Plenty] {
            let request = RenderRequest {
                gpu_memory_bytes: memory.bytes(gpu, volume),
                ..on(gpu, pass, request.clone())
            };
            let drawn = draw(volume, view, request);
            let off = difference(&drawn, &on_cpu);
            let what = format!("{function}, {}, {}, {memory:?}", mode.name(), pass.name());
            assert!(off.is_within(GPU), "{what}: {off}");
            let [on_gpu, on_cpu] = [&drawn.report, &on_cpu.report];
            assert!(on_gpu.complete, "{what}");
            assert_eq!(on_gpu.bricks.filtered_visible, on_cpu.bricks.filtered_visible, "{what}");
            assert_eq!(on_gpu.bricks.in_frustum, on_cpu.bricks.in_frustum, "{what}");
            assert!(on_gpu.residency.peak_bytes <= on_gpu.residency.budget_bytes, "{what}");
        }
    }
}

#[test]
fn a_ct_head_is_drawn_as_on_the_cpu() {
    let (Some(data), Some(gpu)) = (data(), gpu()) else { return };
    let head = open(&data, HEAD);
    draws_as_the_cpu(gpu, &head, NamedView::Front, "haze", Mode::Dvr);
    draws_as_the_cpu(gpu, &head, NamedView::Left, "ct-bone", Mode::Dvr);
    draws_as_the_cpu(gpu, &head, NamedView::Front, "grey", Mode::Mip);
}

#[test]
fn an_oblique_mri_head_is_drawn_as_on_the_cpu() {
    let (Some(data), Some(gpu)) = (data(), gpu()) else { return };
    let head = open(&data, MRI);
    draws_as_the_cpu(gpu, &head, NamedView::Front, "mr", Mode::Dvr);
    draws_as_the_cpu(gpu, &head, NamedView::Top, "grey", Mode::Mip);
}

/// Skin hides what is behind it: that is neither drawn nor loaded.
#[test]
fn what_skin_hides_is_not_drawn() {
    let (Some(data), Some(gpu)) = (data(), gpu()) else { return };
    let head = open(&data, HEAD);
    let request = RenderRequest {
        size: [160, 160],
        gpu_memory_bytes: ONE_TEXTURE.bytes(gpu, &head),
        ..RenderRequest::new(named(&head, "ct-skin"))
    };
    for pass in PASSES {
        let [empty, all] = [Skip::Empty, Skip::All].map(|skip| {
            let mut request = on(gpu, pass, request.clone());
            request.settings.skip = skip;
            draw(&head, NamedView::Front, request)
        });
        let off = difference(&all, &empty);
        assert!(off.is_within(GPU), "{}: {off}", pass.name());
        let (bricks, residency) = (all.report.bricks, all.report.residency);
        let what = format!("{}: {bricks:?}, {residency:?}", pass.name());
        match pass {
            GpuPass::Slices => assert!(bricks.rendered < empty.report.bricks.rendered, "{what}"),
            // A ray that ends asks for nothing behind, whatever is skipped.
            GpuPass::Raycast => assert!(bricks.rendered <= empty.report.bricks.rendered, "{what}"),
        }
        assert!(bricks.occluded > bricks.in_frustum / 10, "{what}");
        assert!(residency.uploads < bricks.in_frustum as u64, "{what}");
    }
}
