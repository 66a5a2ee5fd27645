//! The scenes, by what is particular about them.

use super::cameras::{along_axis, inside, orthographic, orthographic_along_axis, outside};
use super::transfer_functions as tf;
use super::volumes::{F32, F64, I8, I16, I32, U8, U16, U32};
use super::{Geometry, Scene, Volume};
use crate::reference::{Camera, ControlPoint, Mode, Phong};

/// All of them.
pub fn all() -> Vec<Scene> {
    [stored_types(), not_finite(), geometries(), views(), transfer_functions(), modes(), thin_volumes()]
        .concat()
}

/// One for each stored type, with extents around multiples of a core, and rescale slopes of both signs.
fn stored_types() -> Vec<Scene> {
    let volumes = [
        (U8, [61, 60, 59]),
        (I8, [60, 62, 61]),
        (U16, [119, 60, 40]),
        (I16, [41, 121, 60]),
        (U32, [40, 60, 120]),
        (I32, [60, 60, 60]),
        (F32, [121, 61, 40]),
        (F64, [59, 119, 41]),
    ];
    let scene = |(index, (stored, extent))| {
        let volume = Volume::body(&stored, extent, Geometry::plain());
        let camera = outside(&volume, [0.5, -1.0, 0.4], 1.3, 35.0);
        let points = tf::several_bands(volume.value_range);
        Scene {
            phong: every(2, index),
            ..dvr(format!("stored type {}", stored.name), &volume, camera, points)
        }
    };
    volumes.into_iter().enumerate().map(scene).collect()
}

/// Voxels that are not numbers, which are read as 0.
fn not_finite() -> Vec<Scene> {
    let scene = |stored| {
        let volume = Volume::body(&stored, [61, 40, 60], Geometry::plain()).with_voxels_not_finite();
        let camera = outside(&volume, [-0.5, -1.0, 0.3], 1.3, 35.0);
        let points = tf::haze(volume.value_range);
        dvr(format!("NaN and infinities in {}", stored.name), &volume, camera, points)
    };
    [F32, F64].into_iter().map(scene).collect()
}

/// Volumes that lie in the world in every way that files place them, shaded.
fn geometries() -> Vec<Scene> {
    let geometries = [
        ("anisotropic", Geometry::anisotropic()),
        ("oblique", Geometry::oblique()),
        ("gantry tilt", Geometry::gantry_tilt()),
        ("left-handed", Geometry::left_handed()),
        ("axes permuted", Geometry::axes_permuted()),
    ];
    let scene = |(name, geometry)| {
        let volume = Volume::body(&I16, [61, 60, 40], geometry);
        let camera = outside(&volume, [-0.7, -1.0, -0.5], 1.4, 30.0);
        let points = tf::bounded_away_from_ends(volume.value_range);
        Scene { phong: Some(Phong::default()), ..dvr(format!("geometry {name}"), &volume, camera, points) }
    };
    geometries.into_iter().map(scene).collect()
}

/// Cameras in every position that needs care. Odd sizes put a pixel on the picture's axis.
fn views() -> Vec<Scene> {
    let plain = &Volume::body(&U16, [119, 61, 60], Geometry::plain());
    let oblique = &Volume::body(&U8, [61, 70, 62], Geometry::oblique());
    let askew = Camera { up: [0.8, 0.3, -0.6], ..outside(plain, [0.2, -1.0, 0.1], 1.3, 30.0) };
    let perspective = [
        ("near, wide angle", oblique, outside(oblique, [1.0, 0.8, 0.3], 0.62, 80.0)),
        ("far, narrow angle", plain, outside(plain, [-1.0, 2.0, -0.4], 14.0, 3.5)),
        ("up vector askew", plain, askew),
        ("volume behind the eye", plain, looking_away(plain)),
        ("along x", plain, along_axis(plain, 0, 1.3, 40.0)),
        ("along y", plain, along_axis(plain, 1, 1.3, 40.0)),
        ("along z", plain, along_axis(plain, 2, 1.3, 40.0)),
        ("in the plane of the low face", plain, inside(plain, [-0.5, -90.0, 29.5], [-0.5, 0.0, 29.5], 50.0)),
        (
            "in the plane of the high face",
            plain,
            inside(plain, [118.5, -90.0, 29.5], [118.5, 0.0, 29.5], 50.0),
        ),
    ];
    let from_inside = [
        ("inside", plain, inside(plain, [33.3, 31.7, 20.4], [80.0, 40.0, 45.0], 70.0)),
        ("inside, oblique", oblique, inside(oblique, [8.1, 9.2, 55.5], [40.0, 45.0, 10.0], 60.0)),
        ("along a brick's face", plain, inside(plain, [59.5, 5.0, 20.0], [59.5, 30.0, 30.0], 60.0)),
        ("across a brick's face", plain, inside(plain, [59.5, 22.0, 31.0], [0.0, 31.5, 28.0], 60.0)),
        ("from a brick's corner", plain, inside(plain, [59.5, 59.5, 59.5], [100.0, 20.0, 10.0], 75.0)),
        ("from a voxel's centre", plain, inside(plain, [90.0, 40.0, 30.0], [20.0, 10.0, 30.0], 50.0)),
    ];
    let parallel = [
        ("orthographic along x", plain, orthographic_along_axis(plain, 0, 64.0)),
        ("orthographic along y", plain, orthographic_along_axis(plain, 1, 82.0)),
        ("orthographic along z, a voxel a pixel", plain, orthographic_along_axis(plain, 2, 41.0)),
        ("orthographic", oblique, orthographic(oblique, [1.0, -0.6, 0.7], 90.0, 1.5)),
        ("orthographic, eye inside", oblique, orthographic(oblique, [0.3, -1.0, -0.5], 70.0, 0.0)),
    ];
    let scene = |(index, (name, volume, camera)): (usize, (&str, &Volume, Camera))| {
        let range = volume.value_range;
        let points = if index % 2 == 0 { tf::bounded_away_from_ends(range) } else { tf::haze(range) };
        let scene = dvr(format!("view {name}"), volume, camera, points);
        Scene { width: 49, height: 41, phong: every(3, index), ..scene }
    };
    perspective.into_iter().chain(from_inside).chain(parallel).enumerate().map(scene).collect()
}

/// What a transfer function can show and hide.
fn transfer_functions() -> Vec<Scene> {
    let body = &Volume::body(&I16, [60, 61, 119], Geometry::plain());
    let smooth = &Volume::smooth(&U16, [61, 119, 60], Geometry::anisotropic());
    let (range, smooth_range) = (body.value_range, smooth.value_range);
    let functions = [
        ("narrow band", body, tf::narrow_band(range), None),
        ("several bands", body, tf::several_bands(range), Some(2.5)),
        ("steepest ramp", smooth, tf::steepest_ramp(smooth_range), None),
        ("steepest ramp at sharp edges", body, tf::steepest_ramp(range), Some(0.8)),
        ("steepest fall", smooth, tf::reversed(tf::steepest_ramp(smooth_range)), Some(1.0)),
        ("haze", smooth, tf::haze(smooth_range), Some(0.6)),
        ("bounded away from the ends", body, tf::bounded_away_from_ends(range), Some(1.0)),
        ("opaque", body, tf::opaque_above(range), None),
        ("reversed", body, tf::reversed(tf::opaque_above(range)), None),
        ("wider than the values", body, tf::wider_than_the_values(range), None),
        ("one point", smooth, tf::one_point(), Some(40.0)),
    ];
    let scene = |(index, (name, volume, points, unit))| {
        let camera = outside(volume, [-0.6, 1.0, 0.5], 1.3, 32.0);
        Scene {
            unit,
            phong: every(2, index),
            ..dvr(format!("transfer function {name}"), volume, camera, points)
        }
    };
    functions.into_iter().enumerate().map(scene).collect()
}

/// Every mode with every step; the larger pictures are here.
fn modes() -> Vec<Scene> {
    let volume = &Volume::body(&U8, [121, 60, 45], Geometry::anisotropic());
    let camera = outside(volume, [0.9, -1.0, 0.6], 1.25, 34.0);
    let strong = Phong { ambient: 0.3, diffuse: 0.5, specular: 0.6, shininess: 25.0 };
    let modes = [
        ("dvr", Mode::Dvr, None),
        ("dvr shaded", Mode::Dvr, Some(strong)),
        ("mip", Mode::Mip, None),
        ("minip", Mode::Minip, None),
        ("mean", Mode::Mean, None),
    ];
    let scenes = modes.into_iter().flat_map(|(name, mode, phong)| {
        [0.5, 1.0, 1.7].map(|step| {
            let points = points_for(mode, tf::several_bands(volume.value_range), volume);
            let scene = dvr(format!("mode {name}, step {step}"), volume, camera, points);
            Scene { width: 96, height: 64, mode, phong, step, ..scene }
        })
    });
    scenes.collect()
}

/// Volumes of one or two voxels along some axis.
fn thin_volumes() -> Vec<Scene> {
    let extents = [
        ([1, 1, 1], Mode::Dvr),
        ([2, 2, 2], Mode::Minip),
        ([1, 61, 119], Mode::Mip),
        ([2, 121, 61], Mode::Dvr),
        ([150, 1, 60], Mode::Dvr),
        ([61, 120, 1], Mode::Mean),
        ([121, 1, 1], Mode::Dvr),
    ];
    let scene = |(index, (extent, mode))| {
        let volume = Volume::smooth(&F32, extent, Geometry::anisotropic());
        let line = extent[1] == 1 && extent[2] == 1 && extent[0] > 1;
        let camera = if line {
            along_axis(&volume, 0, 0.6, 6.0)
        } else {
            outside(&volume, [0.8, -1.0, 0.9], 1.2, 35.0)
        };
        let points = points_for(mode, tf::bounded_away_from_ends(volume.value_range), &volume);
        let scene = dvr(format!("thin volume {extent:?}"), &volume, camera, points);
        Scene { mode, phong: every(2, index), step: 0.5, ..scene }
    };
    extents.into_iter().enumerate().map(scene).collect()
}

/// An unshaded picture with steps of one voxel.
fn dvr(name: String, volume: &Volume, camera: Camera, points: Vec<ControlPoint>) -> Scene {
    Scene {
        name,
        volume: volume.clone(),
        points,
        unit: None,
        camera,
        width: 64,
        height: 48,
        step: 1.0,
        mode: Mode::Dvr,
        phong: None,
    }
}

/// Shading for every `n`-th scene of a family.
fn every(n: usize, index: usize) -> Option<Phong> {
    (index % n == n - 1).then(Phong::default)
}

/// The points for DVR; for the modes that show one value, a transfer function that tells all values apart.
fn points_for(mode: Mode, points_for_dvr: Vec<ControlPoint>, volume: &Volume) -> Vec<ControlPoint> {
    if mode == Mode::Dvr { points_for_dvr } else { tf::rainbow(volume.value_range) }
}

fn looking_away(volume: &Volume) -> Camera {
    let camera = outside(volume, [0.4, -1.0, 0.2], 1.2, 40.0);
    let target = std::array::from_fn(|axis| 2.0 * camera.eye[axis] - camera.target[axis]);
    Camera { target, ..camera }
}
