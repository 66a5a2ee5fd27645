//! The reference, and executors on their own, give what can be worked out with pen and paper.

mod absorption;
mod cameras;
mod executors;
mod shading;
mod values;

use glassbrick_tests::reference::{Camera, ControlPoint, Mode, Projection, ReferenceFrame, ReferenceScene};

const WHITE: [f64; 3] = [1.0; 3];
const LINEAR_RAMP: [ControlPoint; 2] = [point(0.0, 0.0), point(1.0, 1.0)];

const fn point(value: f64, opacity: f64) -> ControlPoint {
    ControlPoint { value, color: WHITE, opacity }
}

fn colored(value: f64, color: [f64; 3], opacity: f64) -> ControlPoint {
    ControlPoint { value, color, opacity }
}

fn orthographic(eye: [f64; 3], target: [f64; 3], height: f64) -> Camera {
    let up = if eye[0] == target[0] && eye[1] == target[1] { [0.0, -1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    Camera { projection: Projection::Orthographic { height }, eye, target, up }
}

/// One pixel of DVR with steps of 1 mm through voxels of 1 mm at the world's origin.
fn scene<'a>(
    extent: [usize; 3],
    voxels: &'a [f64],
    points: &[ControlPoint],
    camera: Camera,
) -> ReferenceScene<'a> {
    ReferenceScene {
        extent,
        box_end: None,
        voxels,
        spacing: [1.0; 3],
        origin: [0.0; 3],
        direction: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        slope: 1.0,
        intercept: 0.0,
        points: points.to_vec(),
        unit: None,
        camera,
        width: 1,
        height: 1,
        step: 1.0,
        mode: Mode::Dvr,
        phong: None,
        opacity_cutoff: 1.0,
    }
}

fn voxels(extent: [usize; 3], value: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
    let place =
        |index: usize| [index % extent[0], index / extent[0] % extent[1], index / (extent[0] * extent[1])];
    (0..extent.iter().product()).map(|index| value(place(index).map(|i| i as f64))).collect()
}

fn assert_near(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a} is not {b} within {tolerance}");
}

fn assert_same_picture(a: &ReferenceFrame, b: &ReferenceFrame, tolerance: f64) {
    for (a, b) in a.rgba.iter().flatten().zip(b.rgba.iter().flatten()) {
        assert_near(*a, *b, tolerance);
    }
}
