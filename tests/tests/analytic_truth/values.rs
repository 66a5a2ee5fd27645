//! Values at samples, and the modes that show one of them.

use glassbrick_tests::reference::{Mode, ReferenceScene, render};
use glassbrick_tests::srgb;

use super::{LINEAR_RAMP, assert_near, orthographic, point, scene, voxels};

#[test]
fn values_between_voxels_are_trilinear_and_clamped_beyond_the_outermost() {
    let (extent, value) =
        ([4, 3, 5], |p: [f64; 3]| 0.05 * p[0] + 0.11 * p[1] + 0.07 * p[2] + 0.01 * p[0] * p[1] * p[2]);
    let voxels = voxels(extent, value);
    for (q, clamped) in [
        ([1.3, 0.6, 2.2], [1.3, 0.6, 2.2]),
        ([2.9, 1.9, 3.9], [2.9, 1.9, 3.9]),
        ([-0.4, 1.2, 4.4], [0.0, 1.2, 4.0]),
        ([3.45, 2.45, -0.3], [3.0, 2.0, 0.0]),
    ] {
        // The eye is half a step before q, so that the first sample is at q; values grow from there on.
        let one = ReferenceScene {
            step: 0.01,
            mode: Mode::Mip,
            ..scene(extent, &voxels, &LINEAR_RAMP, orthographic([q[0], q[1] - 0.005, q[2]], q, 1.0))
        };
        let along_y: Vec<f64> =
            (0..).map(|k| q[1] + 0.01 * f64::from(k)).take_while(|y| *y < 2.5 + 1.0 / 1024.0).collect();
        let highest =
            along_y.iter().map(|y| value([clamped[0], y.clamp(0.0, 2.0), clamped[2]])).fold(0.0, f64::max);
        assert_near(render(&one).rgba[0][3], highest, 1e-7);
        let lowest = ReferenceScene { mode: Mode::Minip, ..one };
        assert_near(render(&lowest).rgba[0][3], value(clamped), 1e-7);
    }
}

#[test]
fn mip_shows_the_known_maximum_and_where_it_is() {
    let mut voxels = voxels([5, 20, 5], |p| 0.3 + 0.001 * p[1]);
    voxels[2 + 5 * 13 + 100 * 2] = 0.75;
    voxels[2 + 5 * 17 + 100 * 2] = 0.75;
    voxels[2 + 5 * 4 + 100 * 2] = 0.1;
    voxels[2 + 5 * 8 + 100 * 2] = 0.1;
    let camera = orthographic([2.0, -10.5, 2.0], [2.0; 3], 1.0);
    let mip = ReferenceScene { mode: Mode::Mip, ..scene([5, 20, 5], &voxels, &LINEAR_RAMP, camera) };
    let frame = render(&mip);
    assert_near(frame.rgba[0][3], 0.75, 1e-7);
    assert_near(frame.rgba[0][0], 0.75, 1e-7);
    assert_eq!(frame.z, [23.5], "the first of two equal samples");

    let minip = render(&ReferenceScene { mode: Mode::Minip, ..mip.clone() });
    assert_near(minip.rgba[0][3], 0.1, 1e-7);
    assert_eq!(minip.z, [14.5]);

    let mean = render(&ReferenceScene { mode: Mode::Mean, ..mip.clone() });
    assert_near(mean.rgba[0][3], mean_of_column(&voxels), 1e-7);
    assert_eq!(mean.z, [f64::INFINITY]);

    let negated = render(&ReferenceScene { slope: -1.0, intercept: 1.0, ..mip });
    assert_near(negated.rgba[0][3], 0.9, 1e-7);
    assert_eq!(negated.z, [14.5], "the largest value is the smallest stored one");
}

fn mean_of_column(voxels: &[f64]) -> f64 {
    (0..20).map(|y| voxels[2 + 5 * y + 100 * 2]).sum::<f64>() / 20.0
}

#[test]
fn voxels_are_rounded_to_f32_and_those_that_are_not_finite_are_0() {
    let camera = orthographic([0.0, -2.5, 0.0], [0.0; 3], 0.1);
    for (stored, read) in [
        (f64::NAN, 0.0),
        (f64::INFINITY, 0.0),
        (f64::NEG_INFINITY, 0.0),
        (16_777_217.0, 16_777_216.0),
        (4_294_967_295.0, 4_294_967_296.0),
    ] {
        let points = [point(read - 1.0, 0.0), point(read + 1.0, 1.0)];
        let voxels = [stored];
        let one = ReferenceScene { mode: Mode::Mip, ..scene([1; 3], &voxels, &points, camera) };
        assert_near(render(&one).rgba[0][3], 0.5, 1e-6);
    }
}

#[test]
fn srgb_decodes_what_it_encodes() {
    assert_near(srgb::decode(0.5), 0.214_041_14, 1e-8);
    assert_eq!((srgb::decode(0.0), srgb::encode(0.0)), (0.0, 0.0));
    assert_near(srgb::encode(1.0), 1.0, 1e-12);
    for step in 0..=1000 {
        let encoded = f64::from(step) / 1000.0;
        assert_near(srgb::encode(srgb::decode(encoded)), encoded, 1e-7);
    }
}
