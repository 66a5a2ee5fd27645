//! Emission, absorption and the transfer function.

use glassbrick_tests::reference::{BakedTransferFunction, Camera, Projection, ReferenceScene, render};

use super::{assert_near, colored, orthographic, point, scene, voxels};

#[test]
fn a_uniform_ball_has_the_optical_depth_of_its_chords() {
    let (radius, middle) = (20.0, 24.0);
    let voxels = voxels([49; 3], |p| p.map(|x| (x - middle) * (x - middle)).iter().sum::<f64>().sqrt());
    let ball = [point(0.0, 0.03), point(radius, 0.03), point(radius, 0.0), point(2.0 * radius, 0.0)];
    let eye = [middle, -60.0, middle];
    let camera = Camera {
        projection: Projection::Perspective { fov_y_deg: 30.0 },
        ..orthographic(eye, [middle; 3], 1.0)
    };
    let scene = ReferenceScene {
        step: 0.05,
        width: 21,
        height: 21,
        unit: Some(0.5),
        ..scene([49; 3], &voxels, &ball, camera)
    };
    let frame = render(&scene);
    let extinction_per_mm = -(1.0_f64 - 0.03).ln() / 0.5;
    for (index, rgba) in frame.rgba.iter().enumerate() {
        let ray = scene.ray(index % 21, index / 21).ray.normalize();
        let along = 84.0 * ray.y;
        let chord = 2.0 * (radius * radius - (84.0 * 84.0 - along * along)).max(0.0).sqrt();
        // Off by at most a sample on either side, and a table entry; more where the ray grazes the surface.
        let tolerance = if chord > 10.0 { 0.2 } else { 4.0 };
        assert_near(-(1.0 - rgba[3]).ln() / extinction_per_mm, chord, tolerance);
        assert_near(rgba[0], rgba[3], 1e-12);
    }
    assert_near(-(1.0 - frame.rgba[220][3]).ln() / extinction_per_mm, 40.0, 0.1);
}

#[test]
fn a_uniform_block_absorbs_by_its_thickness_whatever_the_step() {
    // From here no sample meets the block's ends, where the margin would hold one more.
    let camera = orthographic([1.0, -10.1, 1.0], [1.0; 3], 1.0);
    for step in [0.25, 0.5, 1.0] {
        let block = ReferenceScene { step, ..scene([3, 8, 3], &[7.0; 72], &[point(0.0, 0.1)], camera) };
        let opaque = 1.0 - (1.0_f64 - 0.1).powi(8);
        assert_near(render(&block).rgba[0][3], opaque, 1e-12);
        let of_2_mm = ReferenceScene { unit: Some(2.0), ..block };
        assert_near(render(&of_2_mm).rgba[0][3], 1.0 - (1.0_f64 - 0.1).powi(4), 1e-12);
    }
}

#[test]
fn extinction_that_grows_along_the_ray_adds_up_to_its_integral() {
    let (extent, slope) = ([3, 101, 3], 0.004);
    let voxels = voxels(extent, |p| p[1]);
    let points = [point(0.0, 0.0), point(100.0, 100.0 * slope)];
    let camera = orthographic([1.0, -20.0, 1.0], [1.0; 3], 1.0);
    let frame = render(&ReferenceScene { step: 0.1, ..scene(extent, &voxels, &points, camera) });
    // ∫ −ln(1 − c·y) dy from 0 to 100, and half a voxel of the last value beyond.
    let rest: f64 = 1.0 - slope * 100.0;
    let depth = (rest * rest.ln() + slope * 100.0) / slope - 0.5 * rest.ln();
    assert_near(-(1.0 - frame.rgba[0][3]).ln(), depth, 1e-3 * depth);
}

#[test]
fn what_is_in_front_covers_what_is_behind() {
    let points = [colored(0.0, [1.0, 0.0, 0.0], 0.25), colored(1.0, [0.0, 0.0, 1.0], 0.5)];
    // Steps of one voxel from −4.5 mm meet the voxels' centres, and nothing else.
    let camera = orthographic([0.0, 0.0, -4.5], [0.0; 3], 0.1);
    let frame = render(&scene([1, 1, 2], &[0.0, 1.0], &points, camera));
    for (channel, expected) in frame.rgba[0].into_iter().zip([0.25, 0.0, 0.75 * 0.5, 0.25 + 0.75 * 0.5]) {
        assert_near(channel, expected, 1e-12);
    }
}

#[test]
fn depth_is_of_the_first_sample_after_which_half_is_covered() {
    let camera = orthographic([0.0, -10.5, 0.0], [0.0; 3], 0.1);
    for (opacity, depth) in [(0.51, 10.5), (0.295, 11.5), (0.292, 12.5), (0.02, f64::INFINITY)] {
        let frame = render(&scene([1, 30, 1], &[0.0; 30], &[point(0.0, opacity)], camera));
        assert_eq!(frame.z, [depth]);
    }
}

#[test]
fn a_ray_stops_after_the_first_sample_that_reaches_the_cutoff() {
    let camera = orthographic([0.0, -10.5, 0.0], [0.0; 3], 0.1);
    let block = scene([1, 30, 1], &[0.0; 30], &[point(0.0, 0.5)], camera);
    for (cutoff, samples) in [(0.3, 1), (0.7, 2), (0.76, 3), (0.998, 9), (1.0, 30)] {
        let frame = render(&ReferenceScene { opacity_cutoff: cutoff, ..block.clone() });
        assert_near(frame.rgba[0][3], 1.0 - 0.5_f64.powi(samples), 1e-12);
    }
}

#[test]
fn at_a_step_of_the_transfer_function_the_later_point_holds() {
    let (red, blue) = ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]);
    // The step is at entry 341 of the table: exactly a third of the way.
    let points = [
        colored(0.0, red, 0.2),
        colored(341.0, red, 0.2),
        colored(341.0, blue, 0.6),
        colored(1023.0, blue, 0.6),
    ];
    let baked = BakedTransferFunction::new(&points, 1.0);
    assert_eq!((baked.at(341.0).opacity, baked.at(341.0).color.to_array()), (0.6, blue));
    assert_eq!((baked.at(340.0).opacity, baked.at(340.0).color.to_array()), (0.2, red));
    assert_near(baked.at(340.5).opacity, 0.4, 1e-12);
    assert_near(baked.at(340.5).extinction, -(0.8_f64.ln() + 0.4_f64.ln()) / 2.0, 1e-12);

    let at_the_ends = [point(5.0, 0.1), point(5.0, 0.3), point(6.0, 0.5), point(6.0, 0.7)];
    let baked = BakedTransferFunction::new(&at_the_ends, 1.0);
    assert_eq!([4.0, 5.0, 6.0, 7.0].map(|value| baked.at(value).opacity), [0.3, 0.3, 0.7, 0.7]);

    let one_value = BakedTransferFunction::new(&[point(5.0, 0.1), point(5.0, 0.3)], 1.0);
    assert_eq!([4.0, 5.0, 6.0].map(|value| one_value.at(value).opacity), [0.3; 3]);
}

#[test]
fn extinction_stays_finite_at_full_opacity_and_is_per_unit() {
    let baked = BakedTransferFunction::new(&[point(0.0, 1.0)], 2.0);
    assert_near(baked.at(0.0).extinction, -(0.0001_f64.ln()) / 2.0, 1e-9);
    assert_eq!(baked.at(0.0).opacity, 1.0);
}
