//! The headlight.

use glassbrick_tests::reference::{Phong, ReferenceScene, render};
use glassbrick_tests::srgb;

use super::{assert_near, colored, orthographic, scene, voxels};

#[test]
fn shading_follows_the_normal_in_the_world_under_gantry_tilt() {
    // Values that are a plane wave in the world, in a volume whose z axis leans by 30° and whose voxels are not cubes.
    let normal = [0.48, -0.6, 0.64];
    let (spacing, direction) =
        ([0.8, 1.0, 1.5], [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.5, 0.75_f64.sqrt()]]);
    let world = |p: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|row| (0..3).map(|axis| direction[axis][row] * spacing[axis] * p[axis]).sum())
    };
    let along = |p: [f64; 3]| world(p).iter().zip(normal).map(|(a, b)| a * b).sum::<f64>();
    let voxels = voxels([9; 3], along);
    let middle = world([4.0; 3]);
    let phong = Phong { ambient: 0.15, diffuse: 0.7, specular: 0.3, shininess: 6.0 };
    let color = [0.8, 0.5, 0.2];
    let camera = orthographic([middle[0], middle[1] - 1.0, middle[2]], middle, 0.1);
    let wave = ReferenceScene {
        spacing,
        direction,
        phong: Some(phong),
        opacity_cutoff: 0.0,
        ..scene([9; 3], &voxels, &[colored(0.0, color, 0.3)], camera)
    };
    let headlight: f64 = 0.6;
    let expected =
        color.map(|channel| srgb::decode(channel) * (0.15 + 0.7 * headlight) + 0.3 * headlight.powi(6));
    for slope in [1.0, -3.0] {
        let [r, g, b, alpha] = render(&ReferenceScene { slope, ..wave.clone() }).rgba[0];
        for (channel, expected) in [r, g, b].into_iter().zip(expected) {
            assert_near(channel / alpha, expected, 1e-5);
        }
    }
}

#[test]
fn a_plateau_keeps_its_colour_under_shading() {
    let camera = orthographic([3.3, -4.0, 2.7], [3.1, 0.0, 3.2], 2.0);
    let scene = scene([7; 3], &[0.1; 343], &[colored(0.0, [0.9, 0.4, 0.2], 0.2)], camera);
    let unshaded = ReferenceScene { width: 4, height: 4, ..scene };
    let shaded = ReferenceScene { phong: Some(Phong::default()), ..unshaded.clone() };
    assert_eq!(render(&shaded), render(&unshaded));
}
