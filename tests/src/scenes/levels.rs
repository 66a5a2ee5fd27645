//! Scenes of volumes with odd extents, whose levels end within their last voxels.

use super::cameras::{inside, orthographic, outside};
use super::transfer_functions as tf;
use super::volumes::{F32, F64, I8, I16, I32, U8, U16, U32};
use super::{Geometry, Scene, Volume};
use crate::reference::{Mode, Phong};

/// Each mode, stored type and geometry at least once; their levels are drawn, so pictures are close.
pub fn level_scenes() -> Vec<Scene> {
    let shaded = Some(Phong::default());
    let volumes = [
        ("haze", Volume::body(&I16, [45, 30, 17], Geometry::oblique()), Mode::Dvr, None),
        ("shaded", Volume::body(&U16, [61, 33, 29], Geometry::oblique()), Mode::Dvr, shaded),
        ("mip", Volume::body(&U8, [45, 30, 17], Geometry::anisotropic()), Mode::Mip, None),
        ("minip", Volume::smooth(&I8, [31, 45, 22], Geometry::gantry_tilt()), Mode::Minip, None),
        ("mean", Volume::body(&F64, [29, 41, 39], Geometry::left_handed()), Mode::Mean, None),
        ("u32", Volume::smooth(&U32, [33, 27, 47], Geometry::axes_permuted()), Mode::Dvr, shaded),
        ("i32", Volume::smooth(&I32, [25, 57, 26], Geometry::plain()), Mode::Dvr, None),
        (
            "NaN",
            Volume::body(&F32, [45, 30, 17], Geometry::oblique()).with_voxels_not_finite(),
            Mode::Dvr,
            None,
        ),
    ];
    let scene = |(index, (name, volume, mode, phong)): (usize, (&str, Volume, Mode, Option<Phong>))| {
        let camera = match index % 4 {
            1 => orthographic(&volume, [0.7, -1.0, 0.6], 0.9 * volume.diagonal_mm(), 1.1),
            3 => inside(&volume, [2.2, 3.1, 4.3], volume.centre_voxel(), 85.0),
            _ => outside(&volume, [0.8, -1.0, -0.6], 1.15, 38.0),
        };
        let range = volume.value_range;
        let points = match (mode, index % 2) {
            (Mode::Dvr, 0) => tf::haze(range),
            (Mode::Dvr, _) => tf::bounded_away_from_ends(range),
            _ => tf::rainbow(range),
        };
        Scene {
            name: format!("levels, {name}"),
            points,
            unit: (index % 3 == 2).then_some(2.0),
            camera,
            width: 56,
            height: 44,
            step: if index % 3 == 1 { 0.5 } else { 1.0 },
            mode,
            phong,
            volume,
        }
    };
    volumes.into_iter().enumerate().map(scene).collect()
}
