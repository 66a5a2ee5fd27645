//! Small CTs of a body, and views of them.

use std::sync::OnceLock;

use glam::DVec3;
use glassbrick::{NamedView, OpenSettings, TransferFunction, Volume, preset};
use glassbrick_phantom::Phantom;
use glassbrick_tests::drawing::{desc, native_bytes};
use glassbrick_tests::reference::{Camera, ControlPoint, Mode, Projection};
use glassbrick_tests::scenes::{self, Geometry, Scene};

pub const PRESETS: [&str; 3] = ["ct-bone", "ct-skin", "haze"];

/// The length that the presets' opacities are of, in mm.
const UNIT_MM: f64 = 1.0;

/// Two upper bodies of different heights, and a whole one of longer voxels.
const EXTENTS: [[u32; 3]; 3] = [[128, 128, 107], [128, 128, 128], [128, 76, 432]];

/// The phantoms, by extent.
pub fn phantoms() -> &'static [scenes::Volume] {
    static PHANTOMS: OnceLock<Vec<scenes::Volume>> = OnceLock::new();
    PHANTOMS.get_or_init(|| EXTENTS.into_iter().map(phantom).collect())
}

fn phantom(extent: [u32; 3]) -> scenes::Volume {
    let phantom = Phantom::new(extent, 1);
    let mut voxels = vec![0; phantom.slice_voxels() * extent[2] as usize];
    phantom.fill_slices(0, &mut voxels);
    scenes::Volume {
        extent: extent.map(|voxels| voxels as usize),
        stored_type: "i16",
        voxels: voxels.into_iter().map(f64::from).collect(),
        slope: 1.0,
        intercept: 0.0,
        value_range: [-1024.0, 3071.0],
        geometry: Geometry {
            spacing: phantom.spacing_mm(),
            origin: phantom.origin_mm(),
            ..Geometry::plain()
        },
    }
}

/// The same in bytes, a step of which is 16 HU.
pub fn in_bytes(phantom: &scenes::Volume) -> scenes::Volume {
    scenes::Volume {
        stored_type: "u8",
        voxels: phantom.voxels.iter().map(|hu| ((hu + 1024.0) / 16.0).floor()).collect(),
        slope: 16.0,
        intercept: -1024.0,
        ..phantom.clone()
    }
}

/// A preset's points.
pub fn points(preset_name: &str) -> Vec<ControlPoint> {
    let TransferFunction { points, unit_mm } = preset(preset_name, [0.0, 1.0]).expect("it is a preset");
    assert_eq!(unit_mm, Some(UNIT_MM), "{preset_name}");
    points.iter().map(|p| ControlPoint { value: p.value, color: p.color, opacity: p.opacity }).collect()
}

/// A small picture of a phantom.
pub fn scene(phantom: &scenes::Volume, points: Vec<ControlPoint>, (name, camera): View) -> Scene {
    Scene {
        name: format!("{:?} {name}", phantom.extent),
        volume: phantom.clone(),
        points,
        unit: Some(UNIT_MM),
        camera,
        width: 64,
        height: 64,
        step: 1.0,
        mode: Mode::Dvr,
        phong: None,
    }
}

pub type View = (&'static str, Camera);

/// In these views some bricks lie beside the picture.
pub const INSIDE: &str = "inside";
pub const CLOSE_UP: &str = "close-up";

pub fn views(phantom: &scenes::Volume) -> [View; 4] {
    let extent = DVec3::from_array(phantom.extent.map(|voxels| voxels as f64));
    let world =
        |part: [f64; 3]| phantom.geometry.world_from_voxel((DVec3::from_array(part) * extent).to_array());
    let inside = Camera {
        projection: Projection::Perspective { fov_y_deg: 60.0 },
        eye: world([0.47, 0.55, 0.61]),
        target: world([0.9, 0.2, 0.3]),
        up: [0.0, 0.0, 1.0],
    };
    let desc = desc(&scene(phantom, Vec::new(), ("nothing", inside)));
    let front = glassbrick::Camera::framing(&desc, NamedView::Front);
    let turned = glassbrick::Camera::framing_around(&desc, 45.0, 0.0);
    [
        ("front", plain(front)),
        ("azimuth 45", plain(turned)),
        (INSIDE, inside),
        (CLOSE_UP, plain(front.zoomed(4.0))),
    ]
}

fn plain(camera: glassbrick::Camera) -> Camera {
    let glassbrick::Projection::Perspective { fov_y_deg } = camera.projection else {
        panic!("framing is perspective");
    };
    Camera {
        projection: Projection::Perspective { fov_y_deg },
        eye: camera.eye_mm.to_array(),
        target: camera.target_mm.to_array(),
        up: camera.up.to_array(),
    }
}

/// A phantom from an array in memory.
pub fn opened(phantom: &scenes::Volume, settings: &OpenSettings) -> Volume {
    let scene = scene(phantom, Vec::new(), views(phantom)[0]);
    Volume::from_array(desc(&scene), native_bytes(&scene), settings).expect("a phantom is sound")
}
