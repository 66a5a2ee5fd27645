use glam::{DVec3, UVec2};

use crate::VolumeDesc;

/// How a camera projects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Rays start at the eye; the picture's full height spans `fov_y_deg`.
    Perspective { fov_y_deg: f64 },
    /// Rays are parallel; the picture is `height_mm` high.
    Orthographic { height_mm: f64 },
}

/// Where the eye is, where it looks, and what is up, in world millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    pub projection: Projection,
    pub eye_mm: DVec3,
    pub target_mm: DVec3,
    /// Any direction that is not along the line of sight.
    pub up: DVec3,
}

/// The unit vectors of a camera in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraBasis {
    pub forward: DVec3,
    pub right: DVec3,
    pub up: DVec3,
}

/// A view named after the side of the patient that faces the viewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedView {
    Front,
    Back,
    Left,
    Right,
    Top,
    Bottom,
}

/// The default field of view, in degrees.
pub const DEFAULT_FOV_Y_DEG: f64 = 30.0;

impl NamedView {
    /// Direction from the target to the eye, and up.
    fn eye_direction_and_up(self) -> (DVec3, DVec3) {
        match self {
            Self::Front => (DVec3::NEG_Y, DVec3::Z),
            Self::Back => (DVec3::Y, DVec3::Z),
            Self::Left => (DVec3::X, DVec3::Z),
            Self::Right => (DVec3::NEG_X, DVec3::Z),
            Self::Top => (DVec3::Z, DVec3::NEG_Y),
            Self::Bottom => (DVec3::NEG_Z, DVec3::NEG_Y),
        }
    }
}

impl Camera {
    /// The default framing of a volume from a named side.
    pub fn framing(desc: &VolumeDesc, view: NamedView) -> Self {
        let (eye_direction, up) = view.eye_direction_and_up();
        Self::framing_from(desc, eye_direction, up)
    }

    /// The default framing from an azimuth and an elevation in degrees: the eye stands in direction
    /// (sin A cos E, −cos A cos E, sin E) from the target, so that (0, 0) is `front` and (90, 0) is `left`.
    pub fn framing_around(desc: &VolumeDesc, azimuth_deg: f64, elevation_deg: f64) -> Self {
        let ([sin_a, cos_a], [sin_e, cos_e]) = (sin_and_cos(azimuth_deg), sin_and_cos(elevation_deg));
        let up = match elevation_deg {
            e if e >= 90.0 => DVec3::NEG_Y,
            e if e <= -90.0 => DVec3::Y,
            _ => DVec3::Z,
        };
        Self::framing_from(desc, DVec3::new(sin_a * cos_e, -cos_a * cos_e, sin_e), up)
    }

    fn framing_from(desc: &VolumeDesc, eye_direction: DVec3, up: DVec3) -> Self {
        let corners = desc.corners_mm();
        let [low, high] = desc.box_voxel();
        let target_mm = desc.world_from_voxel().transform_point3((low + high) / 2.0);
        let radius_mm = corners.iter().map(|corner| corner.distance(target_mm)).fold(0.0, f64::max);
        let half_fov = (DEFAULT_FOV_Y_DEG / 2.0).to_radians();
        Self {
            projection: Projection::Perspective { fov_y_deg: DEFAULT_FOV_Y_DEG },
            eye_mm: target_mm + eye_direction * (radius_mm / half_fov.sin()),
            target_mm,
            up,
        }
    }

    /// The same camera with tan(fov_y / 2), or the height, divided by `zoom`.
    pub fn zoomed(mut self, zoom: f64) -> Self {
        match &mut self.projection {
            Projection::Perspective { fov_y_deg } => {
                let half = (*fov_y_deg / 2.0).to_radians().tan() / zoom;
                *fov_y_deg = 2.0 * half.atan().to_degrees();
            }
            Projection::Orthographic { height_mm } => *height_mm /= zoom,
        }
        self
    }

    /// Forward, right and true up.
    ///
    /// # Errors
    /// When the camera has no direction, or up lies along it, or its lens is impossible: which, as a sentence.
    pub fn basis(&self) -> Result<CameraBasis, &'static str> {
        if !(self.eye_mm.is_finite() && self.target_mm.is_finite() && self.up.is_finite()) {
            return Err("the camera's eye, target and up must be finite numbers");
        }
        let lens_is_sound = match self.projection {
            Projection::Perspective { fov_y_deg } => fov_y_deg > 0.0 && fov_y_deg < 180.0,
            Projection::Orthographic { height_mm } => height_mm > 0.0 && height_mm.is_finite(),
        };
        if !lens_is_sound {
            return Err(
                "the camera's field of view must lie between 0 and 180 degrees, and its height be positive",
            );
        }
        let forward = (self.target_mm - self.eye_mm)
            .try_normalize()
            .ok_or("the camera's eye and target are the same point")?;
        let right = forward
            .cross(self.up.try_normalize().ok_or("the camera's up is zero")?)
            .try_normalize()
            .filter(|right| right.is_finite())
            .ok_or("the camera's up lies along its line of sight")?;
        Ok(CameraBasis { forward, right, up: right.cross(forward) })
    }

    /// The size of a pixel of a picture of `size` pixels, in mm: at a depth in mm for a perspective camera.
    pub fn pixel_mm(&self, size: UVec2, depth_mm: f64) -> f64 {
        let height = 2.0 * self.half_extent(size)[1] / f64::from(size.y);
        if matches!(self.projection, Projection::Perspective { .. }) { height * depth_mm } else { height }
    }

    /// Half the width and height of the picture: at depth 1 for a perspective camera, in mm for an orthographic one.
    pub fn half_extent(&self, size: UVec2) -> [f64; 2] {
        let half_height = match self.projection {
            Projection::Perspective { fov_y_deg } => (fov_y_deg / 2.0).to_radians().tan(),
            Projection::Orthographic { height_mm } => height_mm / 2.0,
        };
        [half_height * f64::from(size.x) / f64::from(size.y), half_height]
    }
}

/// Sine and cosine of an angle in degrees; of a quarter turn exactly 0 and 1, so that rays go along the volume's axes.
fn sin_and_cos(degrees: f64) -> [f64; 2] {
    match degrees.rem_euclid(360.0) {
        0.0 => [0.0, 1.0],
        90.0 => [1.0, 0.0],
        180.0 => [0.0, -1.0],
        270.0 => [-1.0, 0.0],
        _ => degrees.to_radians().sin_cos().into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::StoredType;
    use glam::UVec3;

    fn cube() -> VolumeDesc {
        VolumeDesc::new(UVec3::splat(100), StoredType::U8)
    }

    #[test]
    fn front_shows_the_patients_left_on_the_right_and_the_head_on_top() {
        let basis = Camera::framing(&cube(), NamedView::Front).basis().expect("a framing has a basis");
        assert!(basis.right.distance(DVec3::X) < 1e-12);
        assert!(basis.up.distance(DVec3::Z) < 1e-12);
    }

    #[test]
    fn named_views_are_azimuths_and_elevations() {
        let views = [
            (NamedView::Front, 0.0, 0.0),
            (NamedView::Left, 90.0, 0.0),
            (NamedView::Back, 180.0, 0.0),
            (NamedView::Right, 270.0, 0.0),
            (NamedView::Top, 0.0, 90.0),
        ];
        for (view, azimuth, elevation) in views {
            let named = Camera::framing(&cube(), view);
            let turned = Camera::framing_around(&cube(), azimuth, elevation);
            assert_eq!(named.eye_mm, turned.eye_mm, "{view:?}");
            assert_eq!(named.up, turned.up, "{view:?}");
        }
    }

    #[test]
    fn the_framing_holds_the_whole_box() {
        let desc = cube();
        let camera = Camera::framing(&desc, NamedView::Left);
        let basis = camera.basis().expect("a framing has a basis");
        let [half_width, half_height] = camera.half_extent(UVec2::splat(512));
        for corner in desc.corners_mm() {
            let from_eye = corner - camera.eye_mm;
            let depth = from_eye.dot(basis.forward);
            assert!(from_eye.dot(basis.right).abs() <= half_width * depth);
            assert!(from_eye.dot(basis.up).abs() <= half_height * depth);
        }
    }

    #[test]
    fn impossible_cameras_are_refused() {
        let camera = Camera::framing(&cube(), NamedView::Front);
        assert!(Camera { target_mm: camera.eye_mm, ..camera }.basis().is_err());
        assert!(Camera { up: DVec3::Y, ..camera }.basis().is_err());
        assert!(
            Camera { projection: Projection::Orthographic { height_mm: 0.0 }, ..camera }.basis().is_err()
        );
    }
}
