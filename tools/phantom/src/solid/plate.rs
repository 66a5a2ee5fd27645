use super::{Rect, Row};
use crate::vector::{Vec3, cross, dot, mirror, sub};

/// A triangle with thickness and round edges: shoulder blades, the wings of the pelvis.
#[derive(Clone, Debug)]
pub struct Plate {
    corners: [Vec3; 3],
    radius: f32,
}

impl Plate {
    /// `radius` is half the thickness.
    pub fn new(corners: [Vec3; 3], radius: f32) -> Self {
        Self { corners, radius }
    }

    pub(super) fn mirrored(&self) -> Self {
        Self { corners: self.corners.map(mirror), radius: self.radius }
    }

    pub(super) fn rect(&self, z_mm: f32, margin_mm: f32) -> Option<Rect> {
        let reach = self.radius + margin_mm;
        let range = |axis: usize| {
            let [a, b, c] = self.corners.map(|corner| corner[axis]);
            [a.min(b).min(c) - reach, a.max(b).max(c) + reach]
        };
        let [low, high] = range(2);
        (low <= z_mm && z_mm <= high).then(|| Rect { x: range(0), y: range(1) })
    }

    pub(super) fn distances(&self, row: &Row, out: &mut [f32]) {
        let [a, b, c] = self.corners;
        let edges = [sub(b, a), sub(c, b), sub(a, c)];
        let normal = cross(edges[0], edges[1]);
        let inward = edges.map(|edge| cross(normal, edge));
        let inverse_normal = 1.0 / dot(normal, normal).max(1e-9);
        let inverse_edge = edges.map(|edge| 1.0 / dot(edge, edge).max(1e-9));
        for (i, distance) in out.iter_mut().enumerate() {
            let p = [row.x(i), row.first_mm[1], row.first_mm[2]];
            let from = [sub(p, a), sub(p, b), sub(p, c)];
            let above = dot(inward[0], from[0]) > 0.0
                && dot(inward[1], from[1]) > 0.0
                && dot(inward[2], from[2]) > 0.0;
            let squared = if above {
                dot(normal, from[0]).powi(2) * inverse_normal
            } else {
                let to_edge = |j: usize| {
                    let t = (dot(edges[j], from[j]) * inverse_edge[j]).clamp(0.0, 1.0);
                    let q = sub(from[j], [edges[j][0] * t, edges[j][1] * t, edges[j][2] * t]);
                    dot(q, q)
                };
                to_edge(0).min(to_edge(1)).min(to_edge(2))
            };
            *distance = squared.sqrt() - self.radius;
        }
    }
}
