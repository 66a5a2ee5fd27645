use super::Row;
use crate::vector::{Vec3, dot, mirror, normalize};

/// All that lies behind a plane.
#[derive(Clone, Debug)]
pub struct HalfSpace {
    normal: Vec3,
    offset: f32,
}

impl HalfSpace {
    /// Behind the plane through `point` whose `normal` points out of the solid.
    pub fn new(point: Vec3, normal: Vec3) -> Self {
        let normal = normalize(normal);
        Self { normal, offset: dot(normal, point) }
    }

    pub(super) fn mirrored(&self) -> Self {
        Self { normal: mirror(self.normal), offset: self.offset }
    }

    pub(super) fn distances(&self, row: &Row, out: &mut [f32]) {
        let fixed = self.normal[1] * row.first_mm[1] + self.normal[2] * row.first_mm[2] - self.offset;
        for (i, distance) in out.iter_mut().enumerate() {
            *distance = fixed + self.normal[0] * row.x(i);
        }
    }
}
