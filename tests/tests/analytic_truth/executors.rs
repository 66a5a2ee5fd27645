//! The executors give it too, with every set of instructions that this processor has.

use glam::{DVec3, UVec3};
use glassbrick::{
    Camera, ControlPoint, InstructionSet, Mode, OpenSettings, Projection, RenderRequest, Rendered,
    StoredType, TransferFunction, Volume, VolumeDesc,
};

const EDGE: u32 = 96;

fn opacities(points: &[(f64, f64)]) -> TransferFunction {
    let point = |&(value, opacity)| ControlPoint { value, color: [1.0; 3], opacity };
    TransferFunction { points: points.iter().map(point).collect(), unit_mm: None }
}

/// One pixel of a volume of voxels from `value`, along +y from `eye`, with each set of instructions.
fn pixels(
    value: impl Fn(DVec3) -> f64,
    eye_mm: DVec3,
    request: RenderRequest,
    check: impl Fn(&Rendered, InstructionSet),
) {
    let desc = VolumeDesc::new(UVec3::splat(EDGE), StoredType::U8);
    let place = |index: u32| UVec3::new(index % EDGE, index / EDGE % EDGE, index / (EDGE * EDGE)).as_dvec3();
    let voxels = (0..EDGE.pow(3)).map(|index| value(place(index)).clamp(0.0, 255.0).round() as u8).collect();
    let volume = Volume::from_array(desc, voxels, &OpenSettings::default()).expect("the array is sound");
    let camera = Camera {
        projection: Projection::Orthographic { height_mm: 1.0 },
        eye_mm,
        target_mm: eye_mm + DVec3::Y,
        up: DVec3::Z,
    };
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        let request = RenderRequest { size: [1, 1], instruction_set: Some(set), ..request.clone() };
        check(&volume.render(request, &camera).expect("it can be drawn"), set);
    }
}

#[test]
fn executors_find_the_optical_depth_of_a_ball_through_its_centre() {
    let (centre, radius, opacity) = (DVec3::splat(47.5), 30.0, 0.02);
    let (threshold, per_voxel) = (100.0, 20.0);
    let ball = |voxel: DVec3| threshold + per_voxel * (radius - voxel.distance(centre));
    let shown = opacities(&[(0.0, 0.0), (threshold, 0.0), (threshold, opacity), (255.0, opacity)]);
    let mut request = RenderRequest { step_voxels: 0.25, ..RenderRequest::new(shown) };
    request.settings.opacity_cutoff = 1.0;
    let exact = 1.0 - (1.0 - opacity).powf(2.0 * radius);
    pixels(ball, DVec3::new(47.5, -20.1, 47.5), request, |drawn, set| {
        let alpha = f64::from(drawn.frame.rgba[0][3]);
        assert!((alpha - exact).abs() < 2e-3, "{}: {alpha}, not {exact}", set.name());
    });
}

#[test]
fn executors_find_the_value_between_the_voxels_of_a_ramp() {
    let grey = opacities(&[(0.0, 0.0), (255.0, 1.0)]);
    for mode in [Mode::Mip, Mode::Minip, Mode::Mean] {
        let mut request = RenderRequest::new(grey.clone());
        request.settings.mode = mode;
        pixels(
            |voxel| 2.0 * voxel.x,
            DVec3::new(20.3, -5.0, 33.8),
            request,
            |drawn, set| {
                let value = f64::from(drawn.frame.rgba[0][3]) * 255.0;
                assert!((value - 40.6).abs() < 1e-4, "{} {mode:?}: {value}", set.name());
            },
        );
    }
}

#[test]
fn executors_find_a_known_maximum_and_how_deep_it_lies() {
    let peak = DVec3::new(61.0, 59.0, 40.0);
    let mut request = RenderRequest::new(opacities(&[(0.0, 0.0), (255.0, 1.0)]));
    request.settings.mode = Mode::Mip;
    let value = |voxel: DVec3| if voxel == peak { 250.0 } else { 10.0 };
    // Sample planes lie half a step behind whole numbers of steps, so this ray meets the voxel's centre.
    pixels(value, DVec3::new(61.0, -10.5, 40.0), request, |drawn, set| {
        let found = f64::from(drawn.frame.rgba[0][3]) * 255.0;
        assert!((found - 250.0).abs() < 1e-4, "{}: {found}", set.name());
        assert_eq!(drawn.frame.depth_mm[0], 69.5, "{}", set.name());
    });
}
