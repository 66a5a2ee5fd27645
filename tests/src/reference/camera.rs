use glam::DVec3;

/// Where the picture is seen from. Positions are world millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    pub projection: Projection,
    pub eye: [f64; 3],
    pub target: [f64; 3],
    pub up: [f64; 3],
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    Perspective {
        fov_y_deg: f64,
    },
    /// `height` of the picture, in mm.
    Orthographic {
        height: f64,
    },
}

/// The ray of a pixel: `ray` has length 1 along the camera's forward direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    pub start: DVec3,
    pub ray: DVec3,
}

impl Camera {
    /// The ray through the centre of pixel (i, j) of a picture of `width` by `height`; row 0 is on top.
    pub fn ray(&self, i: usize, j: usize, width: usize, height: usize) -> Ray {
        let eye = DVec3::from_array(self.eye);
        let forward = unit(DVec3::from_array(self.target) - eye);
        let right = unit(forward.cross(DVec3::from_array(self.up)));
        let true_up = right.cross(forward);
        let aspect = width as f64 / height as f64;
        let x = (2.0 * (i as f64 + 0.5) / width as f64 - 1.0) * aspect;
        let y = 1.0 - 2.0 * (j as f64 + 0.5) / height as f64;
        match self.projection {
            Projection::Perspective { fov_y_deg } => {
                let t = (fov_y_deg.to_radians() / 2.0).tan();
                Ray { start: eye, ray: forward + x * t * right + y * t * true_up }
            }
            Projection::Orthographic { height } => {
                Ray { start: eye + (x * right + y * true_up) * (height / 2.0), ray: forward }
            }
        }
    }
}

/// The direction of a vector; exactly 1 along an axis, which multiplying by a reciprocal is not.
fn unit(vector: DVec3) -> DVec3 {
    vector / vector.length()
}
