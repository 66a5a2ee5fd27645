use glassbrick::{InstructionSet, OpenSettings, RenderRequest, Volume};
use glassbrick_volume::{ControlPoint, Frame, Mode, Phong, Skip, StoredType, TransferFunction, VolumeDesc};
use proptest::prelude::*;
use proptest::sample::select;

use super::any::wide_view;
use super::cases;
use super::stored::hash;

/// Both are within 1e-3 of the truth.
const APART: f32 = 2e-3;

fn see_through() -> TransferFunction {
    let point = |value, opacity| ControlPoint { value, color: [1.0, value / 255.0, 0.3], opacity };
    TransferFunction { points: vec![point(0.0, 0.0), point(90.0, 0.0), point(255.0, 0.4)], unit_mm: None }
}

fn farthest_apart(a: &Frame, b: &Frame) -> f32 {
    let pairs = a.rgba.as_flattened().iter().zip(b.rgba.as_flattened());
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
}

/// Voxels that change slowly here and wildly there, with whole bricks of nothing.
fn voxels(desc: &VolumeDesc, seed: u64) -> Vec<u8> {
    let [width, height] = [desc.extent.x, desc.extent.y].map(u64::from);
    let value = |voxel: u64| {
        let [x, y, z] = [voxel % width, voxel / width % height, voxel / width / height];
        match hash(seed, (x / 14) ^ (y / 12) << 8 ^ (z / 13) << 16) % 4 {
            0 => 0,
            1 => (hash(seed, voxel) % 256) as u16,
            _ => ((x * 9 + y * 5 + z * 7) % 256) as u16,
        }
    };
    (0..desc.voxels())
        .flat_map(|voxel| match desc.stored_type {
            StoredType::U8 => vec![value(voxel) as u8],
            _ => value(voxel).to_ne_bytes().to_vec(),
        })
        .collect()
}

proptest! {
    #![proptest_config(cases(250))]

    #[test]
    fn every_instruction_set_draws_views_along_axes_as_plain_code_does(
        mut view in wide_view(60), seed in any::<u64>(), mode in select(Mode::ALL.to_vec()), shaded in any::<bool>(),
        skip in select(vec![Skip::None, Skip::Empty, Skip::All]), stored_type in select(vec![StoredType::U8, StoredType::U16]),
    ) {
        view.desc.stored_type = stored_type;
        let settings = OpenSettings { layout: view.layout, threads: Some(2), ..OpenSettings::default() };
        let volume = Volume::from_array(view.desc.clone(), voxels(&view.desc, seed), &settings).expect("a sound array");
        let draw = |set| {
            let mut request = RenderRequest::new(see_through());
            (request.size, request.step_voxels) = (view.size.to_array(), view.step_voxels);
            (request.settings.mode, request.settings.skip) = (mode, skip);
            request.settings.shading = shaded.then(Phong::default);
            request.settings.opacity_cutoff = 1.0;
            request.instruction_set = Some(set);
            volume.render(request, &view.camera).expect("it can be drawn")
        };
        let plain = draw(InstructionSet::Scalar);
        for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
            let drawn = draw(set);
            let apart = farthest_apart(&drawn.frame, &plain.frame);
            prop_assert!(apart <= APART, "{}: {apart}", set.name());
            if skip == Skip::None {
                prop_assert_eq!(drawn.report.samples, plain.report.samples);
            }
        }
    }
}
