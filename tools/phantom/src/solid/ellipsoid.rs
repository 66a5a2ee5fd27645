use super::{Rect, Row};
use crate::vector::{Vec3, frame_along, mirror};

/// An ellipsoid in any attitude.
#[derive(Clone, Debug)]
pub struct Ellipsoid {
    center: Vec3,
    axes: [Vec3; 3],
    radii: Vec3,
}

impl Ellipsoid {
    /// With its axes along x, y and z.
    pub fn new(center: Vec3, radii: Vec3) -> Self {
        Self { center, axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], radii }
    }

    /// With its first axis along `axis` and its second as much along y as that leaves it.
    pub fn along(center: Vec3, axis: Vec3, radii: Vec3) -> Self {
        Self { center, axes: frame_along(axis), radii }
    }

    pub(super) fn mirrored(&self) -> Self {
        Self { center: mirror(self.center), axes: self.axes.map(mirror), radii: self.radii }
    }

    pub(super) fn rect(&self, z_mm: f32, margin_mm: f32) -> Option<Rect> {
        let half = |axis: usize| {
            let squared = |j: usize| (self.axes[j][axis] * self.radii[j]).powi(2);
            (squared(0) + squared(1) + squared(2)).sqrt() + margin_mm
        };
        let beside = (z_mm - self.center[2]).abs() <= half(2);
        beside.then(|| Rect::around([self.center[0], self.center[1]], [half(0), half(1)]))
    }

    pub(super) fn distances(&self, row: &Row, out: &mut [f32]) {
        let (py, pz) = (row.first_mm[1] - self.center[1], row.first_mm[2] - self.center[2]);
        let inverse = self.radii.map(f32::recip);
        // Coordinates along the axes in radii, linear in x.
        let slope: Vec3 = std::array::from_fn(|j| self.axes[j][0] * inverse[j]);
        let offset: Vec3 =
            std::array::from_fn(|j| (self.axes[j][1] * py + self.axes[j][2] * pz) * inverse[j]);
        for (i, distance) in out.iter_mut().enumerate() {
            let px = row.x(i) - self.center[0];
            let e0 = offset[0] + slope[0] * px;
            let e1 = offset[1] + slope[1] * px;
            let e2 = offset[2] + slope[2] * px;
            let (g0, g1, g2) = (e0 * inverse[0], e1 * inverse[1], e2 * inverse[2]);
            let radial = (e0 * e0 + e1 * e1 + e2 * e2).sqrt();
            let gradient = (g0 * g0 + g1 * g1 + g2 * g2).sqrt();
            *distance = (radial - 1.0) * (radial + 1e-5) / (gradient + 1e-5 * inverse[0]);
        }
    }
}
