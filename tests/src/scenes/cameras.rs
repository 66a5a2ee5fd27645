use glam::DVec3;

use super::Volume;
use crate::reference::{Camera, Projection};

/// A perspective view of the whole volume from `direction`, at `distance` diagonals from its centre.
pub fn outside(volume: &Volume, direction: [f64; 3], distance: f64, fov_y_deg: f64) -> Camera {
    let projection = Projection::Perspective { fov_y_deg };
    toward_centre(volume, direction, distance, projection)
}

/// An orthographic view of `height` mm from `direction`, at `distance` diagonals from the volume's centre.
pub fn orthographic(volume: &Volume, direction: [f64; 3], height: f64, distance: f64) -> Camera {
    // The eye may be at the centre itself, so the target lies beyond it.
    let camera = toward_centre(volume, direction, distance, Projection::Orthographic { height });
    let direction = DVec3::from_array(direction);
    Camera { target: (DVec3::from_array(camera.eye) - direction).to_array(), ..camera }
}

/// A perspective view from and to a voxel position.
pub fn inside(volume: &Volume, eye_voxel: [f64; 3], target_voxel: [f64; 3], fov_y_deg: f64) -> Camera {
    Camera {
        projection: Projection::Perspective { fov_y_deg },
        eye: volume.geometry.world_from_voxel(eye_voxel),
        target: volume.geometry.world_from_voxel(target_voxel),
        up: [0.0, 0.0, 1.0],
    }
}

/// A perspective view exactly along a voxel axis through the volume's centre.
pub fn along_axis(volume: &Volume, axis: usize, distance: f64, fov_y_deg: f64) -> Camera {
    let target_voxel = volume.centre_voxel();
    let mut eye_voxel = target_voxel;
    eye_voxel[axis] -= (distance * volume.diagonal_mm() / volume.geometry.spacing[axis]).round();
    let up = if axis == 2 { [0.0, -1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    Camera { up, ..inside(volume, eye_voxel, target_voxel, fov_y_deg) }
}

/// An orthographic view exactly along a voxel axis.
pub fn orthographic_along_axis(volume: &Volume, axis: usize, height: f64) -> Camera {
    Camera { projection: Projection::Orthographic { height }, ..along_axis(volume, axis, 1.0, 1.0) }
}

fn toward_centre(volume: &Volume, direction: [f64; 3], distance: f64, projection: Projection) -> Camera {
    let target = volume.geometry.world_from_voxel(volume.centre_voxel());
    let offset = DVec3::from_array(direction).normalize() * distance * volume.diagonal_mm();
    let eye = (DVec3::from_array(target) + offset).to_array();
    Camera { projection, eye, target, up: [0.0, 0.0, 1.0] }
}
