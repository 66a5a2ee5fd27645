use super::{Rect, Row};
use crate::vector::{Vec3, dot, mirror, sub};

/// A segment whose thickness goes from one radius to another, with round ends: limbs, ribs, vessels.
///
/// Its section may be oval: `tallness` stretches it along z.
#[derive(Clone, Debug)]
pub struct RoundCone {
    a: Vec3,
    ba: Vec3,
    radius: [f32; 2],
    /// What z is multiplied by before the distance is taken.
    squeeze: f32,
    inverse_length_squared: f32,
}

impl RoundCone {
    pub fn new(a: Vec3, radius_a: f32, b: Vec3, radius_b: f32, tallness: f32) -> Self {
        let squeeze = 1.0 / tallness;
        let flat = |p: Vec3| [p[0], p[1], p[2] * squeeze];
        let ba = sub(flat(b), flat(a));
        Self {
            a: flat(a),
            ba,
            radius: [radius_a, radius_b],
            squeeze,
            inverse_length_squared: 1.0 / dot(ba, ba).max(1e-9),
        }
    }

    pub(super) fn mirrored(&self) -> Self {
        Self { a: mirror(self.a), ba: mirror(self.ba), ..self.clone() }
    }

    pub(super) fn rect(&self, z_mm: f32, margin_mm: f32) -> Option<Rect> {
        let reach = self.radius[0].max(self.radius[1]) + margin_mm;
        let (low, high) = (z_mm * self.squeeze - reach - self.a[2], z_mm * self.squeeze + reach - self.a[2]);
        let (start, end) = if self.ba[2].abs() < 1e-4 {
            if low > 0.0 || high < 0.0 {
                return None;
            }
            (0.0, 1.0)
        } else {
            let (t0, t1) = (low / self.ba[2], high / self.ba[2]);
            (t0.min(t1).max(0.0), t0.max(t1).min(1.0))
        };
        if start > end {
            return None;
        }
        let range = |axis: usize| {
            let (p, q) = (self.a[axis] + start * self.ba[axis], self.a[axis] + end * self.ba[axis]);
            [p.min(q) - reach, p.max(q) + reach]
        };
        Some(Rect { x: range(0), y: range(1) })
    }

    pub(super) fn distances(&self, row: &Row, out: &mut [f32]) {
        let [bx, by, bz] = self.ba;
        let (py, pz) = (row.first_mm[1] - self.a[1], row.first_mm[2] * self.squeeze - self.a[2]);
        let along = (py * by + pz * bz) * self.inverse_length_squared;
        let along_x = bx * self.inverse_length_squared;
        let growth = self.radius[1] - self.radius[0];
        for (i, distance) in out.iter_mut().enumerate() {
            let px = row.x(i) - self.a[0];
            let t = (along + px * along_x).clamp(0.0, 1.0);
            let (qx, qy, qz) = (px - t * bx, py - t * by, pz - t * bz);
            *distance = (qx * qx + qy * qy + qz * qz).sqrt() - self.radius[0] - t * growth;
        }
    }
}
