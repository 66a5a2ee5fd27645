//! Which bricks a picture needs, by brute force: over every sample of every ray and every voxel. The picture itself has
//! no bricks in it; here its samples and voxels are only handed to their owners.
//!
//! Executors round positions, values and opacities to `f32`. Whether a brick is needed may hang on how that falls, and no
//! executor can be held to that: so bricks that are needed are those that certainly are.

use std::ops::Range;

use glam::DVec3;

use super::{March, ReferenceScene};

/// A sample this near to where a brick or the volume ends, in voxels, may be its neighbour's. In the volumes that are
/// looked at, `f32` positions are off by 6e-5 at most.
const NEAREST_TO_END: f64 = 1e-4;

/// Opacities up to this may be rounded to nothing.
const ALMOST_NOTHING: f64 = 1e-6;

/// A ray whose opacity is this much below the cutoff, or less, may have reached it.
const NEAREST_TO_CUTOFF: f64 = 1e-5;

/// What a picture's rays meet, for each brick by its place in the grid (x fastest).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BricksMet {
    /// Bricks that certainly own a sample of some ray.
    pub met: Vec<bool>,
    /// Bricks that certainly own a sample with opacity, wherever it lies on its ray.
    pub seen: Vec<bool>,
    /// Bricks that certainly own a sample with opacity that its ray evaluates before it has reached the opacity cutoff.
    pub needed: Vec<bool>,
    /// Bricks that may own a sample, with opacity or without, that its ray evaluates before that.
    pub reached: Vec<bool>,
}

/// Walks every ray through bricks with cores of `core` voxels along each side.
pub fn bricks_met(scene: &ReferenceScene, core: usize) -> BricksMet {
    let march = March::new(scene);
    let counts = counts(scene, core);
    let none = || vec![false; counts.iter().product()];
    let mut bricks = BricksMet { met: none(), seen: none(), needed: none(), reached: none() };
    for (i, j) in (0..scene.height).flat_map(|j| (0..scene.width).map(move |i| (i, j))) {
        let ray = scene.ray(i, j);
        let mut opacity = 0.0;
        for (_, q) in march.samples_around(ray) {
            let is_inside = march.field.contains(q);
            let is_at_end = march.field.distance_to_box(q) <= NEAREST_TO_END;
            if !is_inside && !is_at_end {
                continue;
            }
            let entry = march.transfer_function.at(march.field.value(q));
            let alpha = 1.0 - (-entry.extinction * march.delta * ray.ray.length()).exp();
            let is_below_cutoff =
                |margin: f64| scene.opacity_cutoff >= 1.0 || opacity < scene.opacity_cutoff + margin;
            if is_at_end || distance_to_face(q, core) <= NEAREST_TO_END {
                if is_below_cutoff(NEAREST_TO_CUTOFF) {
                    owners_in_doubt(q, core, counts).for_each(|owner| bricks.reached[owner] = true);
                }
            } else {
                let owner = owner(q, core, counts);
                let is_seen = alpha > ALMOST_NOTHING;
                bricks.met[owner] = true;
                bricks.seen[owner] |= is_seen;
                bricks.needed[owner] |= is_seen && is_below_cutoff(-NEAREST_TO_CUTOFF);
                bricks.reached[owner] |= is_below_cutoff(NEAREST_TO_CUTOFF);
            }
            if is_inside {
                opacity += (1.0 - opacity) * alpha;
            }
        }
    }
    bricks
}

/// For each brick, whether interpolation between the voxels of its core and one voxel around it can reach any value with
/// opacity.
pub fn bricks_not_empty(scene: &ReferenceScene, core: usize) -> Vec<bool> {
    let march = March::new(scene);
    let shows = |brick: [usize; 3]| {
        let (min, max) = values(&march, cells(scene, core, brick, 1))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), value| (min.min(value), max.max(value)));
        march.transfer_function.shows_any(min, max)
    };
    grid(scene, core).map(shows).collect()
}

/// For each brick, whether it is left after the empty ones are dropped and, by α and β, the nearly empty ones (Xie, Yang
/// and Zhu 2007): of some band, R1 > α and R2 < β, where R1 is the part of the core's voxels that are not above the band,
/// and R2 the part that are below it. An α of 0 and a β of 1 ask for nothing.
///
/// Voxels are counted by value. That is what tables give for whole numbers of which no core spans more than 256; in the
/// bins of wider tables, a bin that a band cuts counts whole.
pub fn bricks_kept(scene: &ReferenceScene, core: usize, alpha: f64, beta: f64) -> Vec<bool> {
    let march = March::new(scene);
    let bands = march.transfer_function.bands();
    let not_empty = bricks_not_empty(scene, core);
    let keeps = |(brick, is_not_empty): ([usize; 3], bool)| {
        let voxels: Vec<f64> = values(&march, cells(scene, core, brick, 0)).collect();
        let part = |count: usize| count as f64 / voxels.len() as f64;
        let passes = |&[low, high]: &[f64; 2]| {
            let r1 = part(voxels.iter().filter(|&&value| value < high).count());
            let r2 = part(voxels.iter().filter(|&&value| value <= low).count());
            (alpha == 0.0 || r1 > alpha) && (beta == 1.0 || r2 < beta)
        };
        is_not_empty && bands.iter().any(passes)
    };
    grid(scene, core).zip(not_empty).map(keeps).collect()
}

/// Bricks along each axis.
fn counts(scene: &ReferenceScene, core: usize) -> [usize; 3] {
    scene.extent.map(|voxels| voxels.div_ceil(core))
}

/// Every brick, x fastest.
fn grid(scene: &ReferenceScene, core: usize) -> impl Iterator<Item = [usize; 3]> {
    let [x, y, z] = counts(scene, core);
    (0..x * y * z).map(move |place| [place % x, place / x % y, place / (x * y)])
}

/// The place in the grid of the brick whose core [core·b − 0.5, core·(b + 1) − 0.5) holds a position. The outermost cores
/// hold what lies beyond them too.
fn owner(q: DVec3, core: usize, counts: [usize; 3]) -> usize {
    let brick: [usize; 3] = std::array::from_fn(|axis| {
        let brick = ((q[axis] + 0.5) / core as f64).floor().max(0.0) as usize;
        brick.min(counts[axis] - 1)
    });
    brick[0] + counts[0] * (brick[1] + counts[1] * brick[2])
}

/// The places of all bricks that may own a position.
fn owners_in_doubt(q: DVec3, core: usize, counts: [usize; 3]) -> impl Iterator<Item = usize> {
    let around = [-NEAREST_TO_END, NEAREST_TO_END];
    let corners = around
        .into_iter()
        .flat_map(move |x| around.map(|y| (x, y)))
        .flat_map(move |xy| around.map(|z| (xy, z)));
    corners.map(move |((x, y), z)| owner(q + DVec3::new(x, y, z), core, counts))
}

/// How far it is to the nearest plane on which cores end, in voxels.
fn distance_to_face(q: DVec3, core: usize) -> f64 {
    let cores = (q + 0.5) / core as f64;
    ((cores - cores.round()).abs() * core as f64).min_element()
}

/// The voxels of a brick's core and `around` voxels more, as far as there are any.
fn cells(scene: &ReferenceScene, core: usize, brick: [usize; 3], around: usize) -> [Range<usize>; 3] {
    std::array::from_fn(|axis| {
        let start = (brick[axis] * core).saturating_sub(around);
        start..((brick[axis] + 1) * core + around).min(scene.extent[axis])
    })
}

/// The values of a box of voxels.
fn values(march: &March, [x, y, z]: [Range<usize>; 3]) -> impl Iterator<Item = f64> {
    let [columns, rows, _] = march.scene.extent;
    let places = z.flat_map(move |z| {
        let x = x.clone();
        y.clone().flat_map(move |y| x.clone().map(move |x| x + columns * (y + rows * z)))
    });
    places.map(|place| march.scene.slope * march.field.stored(place) + march.scene.intercept)
}
