//! Scenes as glassbrick draws them.

use glam::{DMat3, DVec3, UVec3};
use glassbrick::{
    BrickLayout, Camera, ControlPoint, Mode, OpenSettings, Phong, Projection, RenderRequest, RenderSettings,
    Rendered, Rescale, StoredType, TransferFunction, Volume, VolumeDesc,
};

use crate::reference;
use crate::scenes::Scene;

/// Draws a scene from an array in memory, with bricks of `edge`, so that nothing stops early.
pub fn draw(scene: &Scene, edge: u32) -> Rendered {
    let settings = OpenSettings { layout: BrickLayout { edge, halo: 2 }, ..OpenSettings::default() };
    draw_with(scene, &settings, |_| ())
}

/// Draws a scene from an array in memory, with the request changed as is wanted.
pub fn draw_with(scene: &Scene, settings: &OpenSettings, change: impl Fn(&mut RenderRequest)) -> Rendered {
    let volume =
        Volume::from_array(desc(scene), native_bytes(scene), settings).expect("a scene's array is sound");
    let mut request = request(scene);
    change(&mut request);
    volume.render(request, &camera(scene)).expect("a scene can be drawn")
}

/// The volume of a scene.
pub fn desc(scene: &Scene) -> VolumeDesc {
    let volume = &scene.volume;
    VolumeDesc {
        extent: UVec3::from_array(volume.extent.map(|n| n as u32)),
        stored_type: StoredType::from_name(volume.stored_type).expect("scenes name stored types"),
        spacing_mm: DVec3::from_array(volume.geometry.spacing),
        origin_mm: DVec3::from_array(volume.geometry.origin),
        direction: DMat3::from_cols_array_2d(&volume.geometry.direction),
        rescale: Rescale { slope: volume.slope, intercept: volume.intercept },
    }
}

/// What is to be drawn of a scene; nothing stops early.
pub fn request(scene: &Scene) -> RenderRequest {
    let points = scene.points.iter();
    let transfer_function = TransferFunction {
        points: points.map(|p| ControlPoint { value: p.value, color: p.color, opacity: p.opacity }).collect(),
        unit_mm: scene.unit,
    };
    let shading = scene.phong.map(|phong| Phong {
        ambient: phong.ambient as f32,
        diffuse: phong.diffuse as f32,
        specular: phong.specular as f32,
        shininess: phong.shininess as f32,
    });
    let mode = match scene.mode {
        reference::Mode::Dvr => Mode::Dvr,
        reference::Mode::Mip => Mode::Mip,
        reference::Mode::Minip => Mode::Minip,
        reference::Mode::Mean => Mode::Mean,
    };
    RenderRequest {
        size: [scene.width as u32, scene.height as u32],
        step_voxels: scene.step,
        settings: RenderSettings { mode, shading, opacity_cutoff: 1.0, ..RenderSettings::default() },
        ..RenderRequest::new(transfer_function)
    }
}

/// The camera of a scene.
pub fn camera(scene: &Scene) -> Camera {
    let reference::Camera { projection, eye, target, up } = scene.camera;
    Camera {
        projection: match projection {
            reference::Projection::Perspective { fov_y_deg } => Projection::Perspective { fov_y_deg },
            reference::Projection::Orthographic { height } => Projection::Orthographic { height_mm: height },
        },
        eye_mm: DVec3::from_array(eye),
        target_mm: DVec3::from_array(target),
        up: DVec3::from_array(up),
    }
}

/// A scene's voxels in this machine's byte order.
pub fn native_bytes(scene: &Scene) -> Vec<u8> {
    let mut bytes = scene.volume.stored_bytes();
    if cfg!(target_endian = "big") {
        bytes.chunks_exact_mut(desc(scene).stored_type.bytes()).for_each(<[u8]>::reverse);
    }
    bytes
}
