//! The pictures that every executor draws for comparison with the reference.
//!
//! Small volumes whose extents put seams and volume ends everywhere, in every stored type, seen from where
//! renderers go wrong. All of it is plain data, and nothing is left to chance.

mod cameras;
mod families;
mod levels;
mod transfer_functions;
mod volumes;

use std::sync::OnceLock;

use crate::reference::{
    Camera, ControlPoint, Mode, Phong, Projection, ReferenceScene, nearest_sample_to_box,
};
pub use levels::level_scenes;
pub use transfer_functions::STEEPEST_RAMP;
pub use volumes::{Geometry, Volume};

/// Samples keep this far from the ends of the volume, in voxels.
///
/// An `f32` position is off by up to about 2e-5 voxels in these scenes. A sample nearer than that to the end would be
/// inside for one executor and outside for another, and no tolerance covers that.
pub const NEAREST_SAMPLE_TO_END: f64 = 3e-5;

/// A volume and a picture of it.
#[derive(Clone, Debug)]
pub struct Scene {
    /// What is particular about it.
    pub name: String,
    pub volume: Volume,
    /// The transfer function, sorted by value.
    pub points: Vec<ControlPoint>,
    /// The length that opacities are of, in mm; the smallest spacing where there is none.
    pub unit: Option<f64>,
    pub camera: Camera,
    pub width: usize,
    pub height: usize,
    /// Distance of the sample planes in units of the smallest spacing.
    pub step: f64,
    pub mode: Mode,
    pub phong: Option<Phong>,
}

impl Scene {
    /// The scene as the reference draws it; nothing stops early.
    pub fn reference(&self) -> ReferenceScene<'_> {
        let volume = &self.volume;
        ReferenceScene {
            extent: volume.extent,
            box_end: None,
            voxels: &volume.voxels,
            spacing: volume.geometry.spacing,
            origin: volume.geometry.origin,
            direction: volume.geometry.direction,
            slope: volume.slope,
            intercept: volume.intercept,
            points: self.points.clone(),
            unit: self.unit,
            camera: self.camera,
            width: self.width,
            height: self.height,
            step: self.step,
            mode: self.mode,
            phong: self.phong,
            opacity_cutoff: 1.0,
        }
    }
}

/// Every scene, each with a name of its own.
pub fn scenes() -> &'static [Scene] {
    static SCENES: OnceLock<Vec<Scene>> = OnceLock::new();
    SCENES.get_or_init(|| families::all().into_iter().map(with_samples_off_the_ends).collect())
}

/// Narrows the view by thousandths until no sample lies on the end of the volume.
fn with_samples_off_the_ends(mut scene: Scene) -> Scene {
    while nearest_sample_to_box(&scene.reference()) < NEAREST_SAMPLE_TO_END {
        match &mut scene.camera.projection {
            Projection::Perspective { fov_y_deg } => *fov_y_deg *= 0.999,
            Projection::Orthographic { height } => *height *= 0.999,
        }
    }
    scene
}
