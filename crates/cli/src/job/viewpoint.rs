use std::f64::consts::TAU;

use anyhow::Result;
use glam::{DQuat, DVec3};
use glassbrick::{Camera, NamedView, Projection, VolumeDesc, read_camera};

use crate::args::{ViewArgs, ViewChoice};
use crate::usage::UsageError;

const DEFAULT_FOV_Y_DEG: f64 = 30.0;

/// From where the volume is seen, and how near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    viewpoint: Viewpoint,
    zoom: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Viewpoint {
    Named(NamedView),
    Around { azimuth_deg: f64, elevation_deg: f64 },
    Camera(Camera),
}

impl View {
    /// What the flags say; they name one way at most.
    ///
    /// # Errors
    /// When the camera's file cannot be used, or the camera sees nothing.
    pub fn new(args: &ViewArgs) -> Result<Self> {
        let viewpoint = if let Some(path) = &args.camera {
            Viewpoint::Camera(read_camera(path)?)
        } else if let Some((eye, target)) = args.eye.zip(args.target) {
            let camera = Camera {
                projection: Projection::Perspective { fov_y_deg: args.fov.unwrap_or(DEFAULT_FOV_Y_DEG) },
                eye_mm: eye.into(),
                target_mm: target.into(),
                up: args.up.map_or(DVec3::Z, DVec3::from),
            };
            camera
                .basis()
                .map_err(|what| UsageError(format!("{what}; correct --eye, --target, --up or --fov")))?;
            Viewpoint::Camera(camera)
        } else if args.azimuth.is_some() || args.elevation.is_some() {
            let (azimuth_deg, elevation_deg) = (args.azimuth.unwrap_or(0.0), args.elevation.unwrap_or(0.0));
            Viewpoint::Around { azimuth_deg, elevation_deg }
        } else {
            Viewpoint::Named(args.view.map_or(NamedView::Front, named_view))
        };
        Ok(Self { viewpoint, zoom: args.zoom.unwrap_or(1.0) })
    }

    /// The camera for a volume.
    pub fn camera(&self, desc: &VolumeDesc) -> Camera {
        let camera = match self.viewpoint {
            Viewpoint::Named(view) => Camera::framing(desc, view),
            Viewpoint::Around { azimuth_deg, elevation_deg } => {
                Camera::framing_around(desc, azimuth_deg, elevation_deg)
            }
            Viewpoint::Camera(camera) => camera,
        };
        camera.zoomed(self.zoom)
    }
}

fn named_view(view: ViewChoice) -> NamedView {
    match view {
        ViewChoice::Front => NamedView::Front,
        ViewChoice::Back => NamedView::Back,
        ViewChoice::Left => NamedView::Left,
        ViewChoice::Right => NamedView::Right,
        ViewChoice::Top => NamedView::Top,
        ViewChoice::Bottom => NamedView::Bottom,
    }
}

/// The camera turned around the vertical through its target, by `turn` of `turns` equal parts of a whole turn: from
/// the front to the patient's left, as azimuths go.
pub fn turned(camera: &Camera, turn: u32, turns: u32) -> Camera {
    let rotation = DQuat::from_rotation_z(TAU * f64::from(turn) / f64::from(turns));
    Camera {
        eye_mm: camera.target_mm + rotation * (camera.eye_mm - camera.target_mm),
        up: rotation * camera.up,
        ..*camera
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glassbrick::StoredType;

    fn desc() -> VolumeDesc {
        VolumeDesc::new([40, 50, 60].into(), StoredType::U8)
    }

    fn camera(args: ViewArgs) -> Camera {
        View::new(&args).expect("it is sound").camera(&desc())
    }

    #[test]
    fn nothing_said_is_the_front() {
        let front = Camera::framing(&desc(), NamedView::Front);
        assert_eq!(camera(ViewArgs::default()), front.zoomed(1.0));
    }

    #[test]
    fn a_turn_passes_the_azimuths() {
        let front = camera(ViewArgs::default());
        for (turn, azimuth) in [(0, 0.0), (1, 90.0), (2, 180.0), (3, 270.0)] {
            let around = Camera::framing_around(&desc(), azimuth, 0.0);
            assert!(turned(&front, turn, 4).eye_mm.distance(around.eye_mm) < 1e-9, "{azimuth}");
        }
    }

    #[test]
    fn an_eye_has_its_defaults_and_zooms() {
        let args = ViewArgs {
            eye: Some([0.0, -10.0, 0.0]),
            target: Some([0.0; 3]),
            zoom: Some(2.0),
            ..ViewArgs::default()
        };
        let camera = camera(args);
        assert_eq!(camera.up, DVec3::Z);
        let Projection::Perspective { fov_y_deg } = camera.projection else {
            panic!("perspective is the default")
        };
        assert!(((fov_y_deg / 2.0).to_radians().tan() * 2.0 - 15f64.to_radians().tan()).abs() < 1e-12);
    }

    #[test]
    fn an_eye_on_its_target_is_a_usage_error() {
        let args = ViewArgs { eye: Some([1.0; 3]), target: Some([1.0; 3]), ..ViewArgs::default() };
        let error = View::new(&args).expect_err("refused");
        assert!(error.is::<UsageError>() && error.to_string().contains("same point"), "{error}");
    }
}
