//! Short names for the solids that anatomy is written in.

use crate::shape::Part;
use crate::solid::{Ellipsoid, Loft, Plate, RoundCone, Section, Solid};
use crate::vector::Vec3;

/// How a part joins its shape; see [`Part`].
#[derive(Clone, Copy, Debug)]
pub struct Join {
    pub blend_mm: f32,
    pub shell_mm: f32,
}

/// A crease where parts meet, and an inner surface `shell_mm` inside.
pub const fn shell(shell_mm: f32) -> Join {
    Join { blend_mm: 0.0, shell_mm }
}

/// No inner surface of its own.
pub const SOLID: Join = shell(0.0);

impl Join {
    pub const fn blend(self, blend_mm: f32) -> Self {
        Self { blend_mm, ..self }
    }
}

pub fn part(solid: Solid, join: Join) -> Part {
    Part { solid, blend_mm: join.blend_mm, shell_mm: join.shell_mm, carve: false }
}

/// A segment from `a` to `b` with round ends.
pub fn limb(a: Vec3, radius_a: f32, b: Vec3, radius_b: f32, join: Join) -> Part {
    part(Solid::RoundCone(RoundCone::new(a, radius_a, b, radius_b, 1.0)), join)
}

pub fn ball(center: Vec3, radius: f32, join: Join) -> Part {
    limb(center, radius, center, radius, join)
}

/// An ellipsoid along the body's axes.
pub fn oval(center: Vec3, radii: Vec3, join: Join) -> Part {
    part(Solid::Ellipsoid(Ellipsoid::new(center, radii)), join)
}

/// An ellipsoid whose first radius lies along `axis`.
pub fn oval_along(center: Vec3, axis: Vec3, radii: Vec3, join: Join) -> Part {
    part(Solid::Ellipsoid(Ellipsoid::along(center, axis, radii)), join)
}

pub fn plate(corners: [Vec3; 3], half_thickness: f32, join: Join) -> Part {
    part(Solid::Plate(Plate::new(corners, half_thickness)), join)
}

pub fn loft(sections: &[Section], square: f32) -> Loft {
    Loft { sections: sections.to_vec() }.squared(square)
}

/// A smooth tube through points with radii; its section is `tallness` times as tall as wide.
pub fn oval_tube(points: &[(Vec3, f32)], tallness: f32, join: Join) -> Vec<Part> {
    const PIECES: usize = 4;
    let pick = |index: usize| points[index.min(points.len() - 1)];
    let mut parts = Vec::new();
    for index in 0..points.len().saturating_sub(1) {
        let four = [pick(index.saturating_sub(1)), pick(index), pick(index + 1), pick(index + 2)];
        let at = |piece: usize| spline(four, piece as f32 / PIECES as f32);
        for piece in 0..PIECES {
            let ((a, radius_a), (b, radius_b)) = (at(piece), at(piece + 1));
            parts.push(part(Solid::RoundCone(RoundCone::new(a, radius_a, b, radius_b, tallness)), join));
        }
    }
    parts
}

/// A smooth tube through points with radii.
pub fn tube(points: &[(Vec3, f32)], join: Join) -> Vec<Part> {
    oval_tube(points, 1.0, join)
}

/// Uniform Catmull–Rom between the second and the third of four points.
fn spline(four: [(Vec3, f32); 4], t: f32) -> (Vec3, f32) {
    let weights = [
        ((-0.5 * t + 1.0) * t - 0.5) * t,
        (1.5 * t - 2.5) * t * t + 1.0,
        ((-1.5 * t + 2.0) * t + 0.5) * t,
        (0.5 * t - 0.5) * t * t,
    ];
    let sum = |value: &dyn Fn(&(Vec3, f32)) -> f32| {
        four.iter().zip(weights).map(|(point, weight)| value(point) * weight).sum::<f32>()
    };
    let position = std::array::from_fn(|axis| sum(&|(position, _)| position[axis]));
    (position, sum(&|(_, radius)| *radius).max(0.3))
}

/// A dent of the form of a part.
pub fn carve(part: Part) -> Part {
    Part { carve: true, ..part }
}

/// The parts and their mirror images.
pub fn both_sides(parts: Vec<Part>) -> Vec<Part> {
    let mirrored: Vec<_> = parts.iter().map(Part::mirrored).collect();
    [parts, mirrored].concat()
}
