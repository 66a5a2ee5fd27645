use super::{Rect, Row};
use crate::vector::{Vec3, frame_along, mirror};

/// An elliptic cylinder with a waist and rounded rims: vertebral bodies and the discs between them.
#[derive(Clone, Debug)]
pub struct Drum {
    pub center: Vec3,
    /// Axis first, then the directions of the two radii.
    axes: [Vec3; 3],
    half_height: f32,
    /// Anteroposterior and lateral.
    radii: [f32; 2],
    /// How much narrower it is halfway up, as a share of its radii.
    waist: f32,
}

impl Drum {
    pub fn new(center: Vec3, axis: Vec3, half_height: f32, radii: [f32; 2], waist: f32) -> Self {
        Self { center, axes: frame_along(axis), half_height, radii, waist }
    }

    pub(super) fn mirrored(&self) -> Self {
        Self { center: mirror(self.center), axes: self.axes.map(mirror), ..self.clone() }
    }

    pub(super) fn rect(&self, z_mm: f32, margin_mm: f32) -> Option<Rect> {
        let sizes = [self.half_height, self.radii[0], self.radii[1]];
        let half = |axis: usize| {
            let reach = |j: usize| (self.axes[j][axis] * sizes[j]).abs();
            reach(0) + reach(1) + reach(2) + margin_mm
        };
        let beside = (z_mm - self.center[2]).abs() <= half(2);
        beside.then(|| Rect::around([self.center[0], self.center[1]], [half(0), half(1)]))
    }

    pub(super) fn distances(&self, row: &Row, out: &mut [f32]) {
        const RIM_MM: f32 = 3.0;
        let (py, pz) = (row.first_mm[1] - self.center[1], row.first_mm[2] - self.center[2]);
        let fixed: Vec3 = std::array::from_fn(|j| self.axes[j][1] * py + self.axes[j][2] * pz);
        let slope: Vec3 = std::array::from_fn(|j| self.axes[j][0]);
        for (i, distance) in out.iter_mut().enumerate() {
            let px = row.x(i) - self.center[0];
            let along = fixed[0] + slope[0] * px;
            let level = along / self.half_height;
            let narrowing = 1.0 - self.waist * (1.0 - level * level).max(0.0);
            let (ra, rb) = (self.radii[0] * narrowing, self.radii[1] * narrowing);
            let (a, b) = ((fixed[1] + slope[1] * px) / ra, (fixed[2] + slope[2] * px) / rb);
            let radial = (a * a + b * b).sqrt();
            let gradient = ((a / ra).powi(2) + (b / rb).powi(2)).sqrt();
            let side = (radial - 1.0) * (radial + 1e-5) / (gradient + 1e-5 / ra);
            let lid = along.abs() - self.half_height;
            let overlap = (RIM_MM - (side - lid).abs()).max(0.0) / RIM_MM;
            *distance = side.max(lid) + overlap * overlap * RIM_MM * 0.25;
        }
    }
}
