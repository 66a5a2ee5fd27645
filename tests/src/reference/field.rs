use std::ops::Range;

use glam::{DMat3, DVec3};

/// How far the volume reaches beyond its box, in voxels.
const MARGIN: f64 = 1.0 / 1024.0;

/// The volume as a function of position: voxel coordinates to values.
pub struct Field<'a> {
    pub extent: [usize; 3],
    pub voxels: &'a [f64],
    pub slope: f64,
    pub intercept: f64,
    /// Takes world vectors to voxel vectors.
    pub voxel_from_world: DMat3,
    /// World position of the centre of voxel (0, 0, 0), in mm.
    pub origin: DVec3,
    /// Where the volume's box ends, in voxels.
    pub box_end: DVec3,
}

impl Field<'_> {
    /// The box that the volume fills; the high end is not part of it.
    fn box_ends(&self) -> [DVec3; 2] {
        [DVec3::splat(-0.5 - MARGIN), self.box_end + MARGIN]
    }

    /// Whether a position is in the volume.
    pub fn contains(&self, q: DVec3) -> bool {
        let [low, high] = self.box_ends();
        q.cmpge(low).all() && q.cmplt(high).all()
    }

    /// How far a position must move along an axis to enter or leave the volume's box, in voxels: from inside to the
    /// nearest end, from outside past the farthest.
    pub fn distance_to_box(&self, q: DVec3) -> f64 {
        let [low, high] = self.box_ends();
        (low - q).max(q - high).max_element().abs()
    }

    /// The indices k of the samples `start + d·(k + 0.5)`, k ≥ 0, that can lie in the volume, and a few more.
    pub fn sample_indices(&self, start: DVec3, d: DVec3) -> Range<usize> {
        let [low, high] = self.box_ends();
        let (mut first, mut last) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            if d[axis] == 0.0 {
                if start[axis] < low[axis] || start[axis] >= high[axis] {
                    return 0..0;
                }
            } else {
                let a = (low[axis] - start[axis]) / d[axis];
                let b = (high[axis] - start[axis]) / d[axis];
                first = first.max(a.min(b));
                last = last.min(a.max(b));
            }
        }
        // Beyond the ends by two samples, whatever the rounding; a ray that misses has first > last.
        if first > last + 2.0 {
            0..0
        } else {
            (first - 2.0).max(0.0) as usize..(last + 2.0).max(0.0) as usize
        }
    }

    /// The value at a position: trilinear between stored values, then rescaled.
    pub fn value(&self, q: DVec3) -> f64 {
        let cell = q.floor();
        let fraction = q - cell;
        let x = self.axis_indices(cell, 0);
        let y = self.axis_indices(cell, 1).map(|y| y * self.extent[0]);
        let z = self.axis_indices(cell, 2).map(|z| z * self.extent[0] * self.extent[1]);
        let row = |y: usize, z: usize| mix(self.stored(x[0] + y + z), self.stored(x[1] + y + z), fraction.x);
        let plane = |z: usize| mix(row(y[0], z), row(y[1], z), fraction.y);
        self.slope * mix(plane(z[0]), plane(z[1]), fraction.z) + self.intercept
    }

    /// The gradient of the values in world space: central differences of one voxel.
    pub fn gradient_world(&self, q: DVec3) -> DVec3 {
        let difference = |axis: DVec3| (self.value(q + axis) - self.value(q - axis)) / 2.0;
        let gradient_voxel = DVec3::new(difference(DVec3::X), difference(DVec3::Y), difference(DVec3::Z));
        self.voxel_from_world.transpose() * gradient_voxel
    }

    /// The two voxel indices along an axis that a cell lies between, clamped to the volume.
    fn axis_indices(&self, cell: DVec3, axis: usize) -> [usize; 2] {
        let last = self.extent[axis] as f64 - 1.0;
        [cell[axis].clamp(0.0, last) as usize, (cell[axis] + 1.0).clamp(0.0, last) as usize]
    }

    /// A voxel as it is read: rounded to `f32`, which keeps all but u32, i32 and f64 as they are; 0 if not finite.
    pub fn stored(&self, index: usize) -> f64 {
        let rounded = self.voxels[index] as f32;
        if rounded.is_finite() { f64::from(rounded) } else { 0.0 }
    }
}

/// Linear interpolation that gives exactly `a` between equals, so that a plateau has no gradient.
fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + t * (b - a)
}
