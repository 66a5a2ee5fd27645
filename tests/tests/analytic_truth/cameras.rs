//! What each pixel looks at.

use glassbrick_tests::reference::{Camera, Mode, Phong, Projection, ReferenceScene, render};

use super::{LINEAR_RAMP, assert_near, assert_same_picture, orthographic, point, scene, voxels};

#[test]
fn the_ray_on_the_axis_is_the_same_in_perspective_and_orthographic() {
    let voxels = voxels([9, 11, 10], |p| (p[0] * 0.7).sin() * 0.3 + 0.05 * p[1] + 0.02 * p[2]);
    let mut camera = orthographic([-8.0, -12.3, 9.1], [4.0, 5.0, 4.5], 12.0);
    let picture = |camera| {
        let scene = scene([9, 11, 10], &voxels, &LINEAR_RAMP, camera);
        render(&ReferenceScene { width: 5, height: 3, phong: Some(Phong::default()), ..scene })
    };
    let flat = picture(camera);
    camera.projection = Projection::Perspective { fov_y_deg: 40.0 };
    let deep = picture(camera);
    assert_eq!((flat.rgba[7], flat.z[7]), (deep.rgba[7], deep.z[7]));
    assert!(flat.rgba[7][3] > 0.5 && flat.rgba[6] != deep.rgba[6]);
}

#[test]
fn rays_span_the_field_of_view_and_the_pictures_proportions() {
    let orthographic = orthographic([0.0; 3], [0.0, 7.0, 0.0], 6.0);
    let perspective = Camera {
        projection: Projection::Perspective { fov_y_deg: 2.0 * 0.4_f64.atan().to_degrees() },
        ..orthographic
    };
    // Pixel (3, 0) of 4 by 2 is 3/4 of the way to the right edge, which is twice as far as the top, and half way up.
    let ray = perspective.ray(3, 0, 4, 2);
    assert_eq!(ray.start.to_array(), [0.0; 3]);
    for (component, expected) in ray.ray.to_array().into_iter().zip([0.4 * 1.5, 1.0, 0.4 * 0.5]) {
        assert_near(component, expected, 1e-12);
    }
    let ray = orthographic.ray(3, 0, 4, 2);
    assert_eq!((ray.start.to_array(), ray.ray.to_array()), ([4.5, 0.0, 1.5], [0.0, 1.0, 0.0]));
}

#[test]
fn row_0_is_on_top_and_the_patients_left_is_on_the_right_from_the_front() {
    let voxels = voxels([3, 1, 3], |p| if p == [2.0, 0.0, 2.0] { 1.0 } else { 0.0 });
    let camera = orthographic([1.0, -5.0, 1.0], [1.0, 0.0, 1.0], 3.0);
    let frame =
        render(&ReferenceScene { width: 3, height: 3, ..scene([3, 1, 3], &voxels, &LINEAR_RAMP, camera) });
    let seen: Vec<usize> = (0..9).filter(|&pixel| frame.rgba[pixel][3] > 0.9).collect();
    assert_eq!(seen, [2]);
}

#[test]
fn a_camera_inside_sees_only_what_is_before_it() {
    let camera = orthographic([0.0, 10.0, 0.0], [0.0, 20.0, 0.0], 0.1);
    let block = scene([1, 30, 1], &[0.0; 30], &[point(0.0, 0.1)], camera);
    let frame = render(&block);
    // Samples at 10.5 to 29.5, the last one in the margin of 1/1024 voxel.
    assert_near(frame.rgba[0][3], 1.0 - 0.9_f64.powi(20), 1e-12);
    assert_eq!(frame.z, [6.5]);
}

#[test]
fn the_low_end_of_the_volume_belongs_to_it_and_the_high_end_does_not() {
    let margin = 1.0 / 1024.0;
    for (first_sample, inside) in
        [(-0.5 - margin, true), (-0.5 - 2.0 * margin, false), (0.5, true), (0.5 + margin, false)]
    {
        let camera = orthographic([0.0, first_sample - 5.0, 0.0], [0.0, 100.0, 0.0], 0.1);
        let one = ReferenceScene { step: 10.0, ..scene([1; 3], &[1.0], &LINEAR_RAMP, camera) };
        assert_eq!(render(&one).rgba[0][3] > 0.9, inside, "{first_sample}");
    }
}

#[test]
fn a_ray_that_misses_the_volume_is_transparent_in_every_mode() {
    let camera = orthographic([5.0, -10.0, 0.0], [5.0, 0.0, 0.0], 0.1);
    for mode in [Mode::Dvr, Mode::Mip, Mode::Minip, Mode::Mean] {
        let frame = render(&ReferenceScene { mode, ..scene([3, 3, 3], &[1.0; 27], &LINEAR_RAMP, camera) });
        assert_eq!((frame.rgba, frame.z), (vec![[0.0; 4]], vec![f64::INFINITY]));
    }
}

#[test]
fn the_picture_does_not_depend_on_the_order_in_which_voxels_are_stored() {
    let value = |p: [f64; 3]| (0.4 * p[0]).sin() * 0.4 + (0.3 * p[1]).cos() * 0.3 + 0.03 * p[2];
    let stored = voxels([10, 12, 8], value);
    let permuted = voxels([8, 10, 12], |p| value([p[1], p[2], p[0]]));
    let camera = Camera {
        projection: Projection::Perspective { fov_y_deg: 35.0 },
        ..orthographic([-9.0, -20.0, 13.0], [4.0, 5.0, 3.0], 1.0)
    };
    let a = ReferenceScene {
        spacing: [0.7, 0.9, 1.3],
        width: 12,
        height: 9,
        phong: Some(Phong::default()),
        ..scene([10, 12, 8], &stored, &LINEAR_RAMP, camera)
    };
    let b = ReferenceScene {
        extent: [8, 10, 12],
        voxels: &permuted,
        spacing: [1.3, 0.7, 0.9],
        direction: [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        ..a.clone()
    };
    assert_same_picture(&render(&a), &render(&b), 1e-9);
}
