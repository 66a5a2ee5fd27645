//! Trees of vessels that branch until they reach every one of a cloud of points.

use super::parts::{Join, limb};
use crate::noise::Sequence;
use crate::shape::Part;
use crate::vector::{Vec3, add, dot, frame_along, length, lerp, normalize, scale, sub};

/// How thick a tree's branches are.
#[derive(Clone, Copy, Debug)]
pub struct Girth {
    /// Radius of the last twigs, in mm.
    pub twig_mm: f32,
    /// Radius of the thickest branch.
    pub trunk_mm: f32,
    pub join: Join,
}

impl Girth {
    /// Murray's law: flow, and so the number of twigs fed, goes with the cube of the radius. The power is a little
    /// larger here, as in real vessels.
    fn radius(self, twigs: usize) -> f32 {
        (self.twig_mm * (twigs as f32).powf(1.0 / 2.6)).min(self.trunk_mm)
    }
}

/// A tree from `root` to each of the `targets`.
pub fn grow(root: Vec3, mut targets: Vec<Vec3>, girth: Girth, random: &mut Sequence) -> Vec<Part> {
    let mut parts = Vec::new();
    let radius = girth.radius(targets.len());
    branch(root, radius, &mut targets, girth, random, &mut parts);
    parts
}

fn branch(
    from: Vec3,
    radius: f32,
    targets: &mut [Vec3],
    girth: Girth,
    random: &mut Sequence,
    parts: &mut Vec<Part>,
) {
    match targets {
        [] => {}
        [only] => bend(from, radius, *only, girth.twig_mm, girth, random, parts),
        _ => {
            let middle =
                scale(targets.iter().fold([0.0; 3], |sum, &p| add(sum, p)), 1.0 / targets.len() as f32);
            let fork = lerp(from, middle, 0.42);
            let radius_here = girth.radius(targets.len());
            bend(from, radius.min(radius_here * 1.4), fork, radius_here, girth, random, parts);
            let axis = longest_axis(targets, middle);
            targets.sort_by(|&p, &q| dot(p, axis).total_cmp(&dot(q, axis)));
            // Uneven halves: real forks seldom are even.
            let share = random.between(0.3, 0.7);
            let split = ((targets.len() as f32 * share) as usize).clamp(1, targets.len() - 1);
            let (left, right) = targets.split_at_mut(split);
            branch(fork, radius_here, left, girth, random, parts);
            branch(fork, radius_here, right, girth, random, parts);
        }
    }
}

/// A gently bent piece between two points.
fn bend(
    a: Vec3,
    radius_a: f32,
    b: Vec3,
    radius_b: f32,
    girth: Girth,
    random: &mut Sequence,
    parts: &mut Vec<Part>,
) {
    let along = sub(b, a);
    let [_, side, other] = frame_along(along);
    let reach = 0.09 * length(along);
    let offset = add(scale(side, random.between(-reach, reach)), scale(other, random.between(-reach, reach)));
    let middle = add(lerp(a, b, 0.5), offset);
    let radius_middle = 0.5 * (radius_a + radius_b);
    parts.push(limb(a, radius_a, middle, radius_middle, girth.join));
    parts.push(limb(middle, radius_middle, b, radius_b, girth.join));
}

/// The direction in which points are spread most: a few steps of power iteration on their covariance.
fn longest_axis(points: &[Vec3], middle: Vec3) -> Vec3 {
    let mut axis = normalize([0.61, 0.53, 0.59]);
    for _ in 0..6 {
        let spread = points.iter().fold([0.0; 3], |sum, &point| {
            let offset = sub(point, middle);
            add(sum, scale(offset, dot(offset, axis)))
        });
        axis = normalize(spread);
    }
    axis
}

/// Up to `count` points of the box `low` to `high` that `inside` accepts.
pub fn scatter(
    low: Vec3,
    high: Vec3,
    count: usize,
    random: &mut Sequence,
    inside: impl Fn(Vec3) -> bool,
) -> Vec<Vec3> {
    let mut points = Vec::with_capacity(count);
    for _ in 0..count * 40 {
        let point = std::array::from_fn(|axis| random.between(low[axis], high[axis]));
        if points.len() == count {
            break;
        }
        if inside(point) {
            points.push(point);
        }
    }
    points
}
