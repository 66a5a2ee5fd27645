use glam::{DVec3, UVec3};

use crate::volume_desc::box_corners;
use crate::{BrickGrid, FrameRays, VOLUME_MARGIN_VOXELS};

/// Boxes are taken this much larger, in voxels, than they are, so that rounding of sample positions to `f32` never
/// puts a sample outside the footprint of its brick.
const SLACK_VOXELS: f64 = 1.0 / 64.0;

/// Pixels from `min` up to, not including, `max`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PixelRect {
    pub min: [u32; 2],
    pub max: [u32; 2],
}

impl PixelRect {
    /// Whether two rectangles have a pixel in common.
    pub fn overlaps(&self, other: &Self) -> bool {
        (0..2).all(|axis| self.min[axis] < other.max[axis] && other.min[axis] < self.max[axis])
    }

    /// The smallest rectangle that holds both.
    pub fn union(self, other: Self) -> Self {
        Self {
            min: [0, 1].map(|axis| self.min[axis].min(other.min[axis])),
            max: [0, 1].map(|axis| self.max[axis].max(other.max[axis])),
        }
    }

    /// The pixels that lie in both of two rectangles that overlap.
    pub fn intersection(self, other: Self) -> Self {
        Self {
            min: [0, 1].map(|axis| self.min[axis].max(other.min[axis])),
            max: [0, 1].map(|axis| self.max[axis].min(other.max[axis])),
        }
    }

    /// What lies in a tile of the picture, counted from the tile's first pixel.
    pub fn in_tile(&self, tile: &Self) -> Self {
        let counted =
            |at: [u32; 2]| [0, 1].map(|axis| at[axis].clamp(tile.min[axis], tile.max[axis]) - tile.min[axis]);
        Self { min: counted(self.min), max: counted(self.max) }
    }
}

/// Where boxes of voxels fall in the picture.
#[derive(Clone, Debug)]
pub struct Footprints {
    picture_from_voxel: [(DVec3, f64); 3],
    size: [f64; 2],
    perspective: bool,
    near_mm: f64,
}

/// A point of the picture before the perspective division: right, up and depth.
type PicturePoint = [f64; 3];

impl Footprints {
    pub fn new(rays: &FrameRays) -> Self {
        Self {
            picture_from_voxel: rays.picture_from_voxel(),
            size: rays.size.as_dvec2().to_array(),
            perspective: rays.is_perspective(),
            near_mm: rays.step_mm * 0.499,
        }
    }

    /// The pixels whose rays can have a sample in a brick's core; none when it is outside the frustum.
    pub fn of_brick(&self, grid: &BrickGrid, brick: UVec3) -> Option<PixelRect> {
        let margin = DVec3::splat(0.5 + VOLUME_MARGIN_VOXELS + SLACK_VOXELS);
        let low = grid.core_start(brick).as_dvec3() - margin;
        let high = grid.core_end(brick).as_dvec3() - 1.0 + margin;
        self.of_box(low, high)
    }

    fn of_box(&self, low: DVec3, high: DVec3) -> Option<PixelRect> {
        let points = box_corners(low, high)
            .map(|corner| self.picture_from_voxel.map(|(direction, offset)| direction.dot(corner) + offset));
        let mut bounds = Bounds::NOTHING;
        for point in points {
            if point[2] >= self.near_mm {
                bounds.widen(self.project(point));
            }
        }
        for (a, b) in box_edges().map(|(a, b)| (points[a], points[b])) {
            if (a[2] < self.near_mm) != (b[2] < self.near_mm) {
                let t = (self.near_mm - a[2]) / (b[2] - a[2]);
                bounds.widen(self.project(std::array::from_fn(|c| a[c] + t * (b[c] - a[c]))));
            }
        }
        self.pixels(&bounds)
    }

    fn project(&self, [right, up, depth]: PicturePoint) -> [f64; 2] {
        let scale = if self.perspective { 1.0 / depth } else { 1.0 };
        [(right * scale + 1.0) / 2.0 * self.size[0], (1.0 - up * scale) / 2.0 * self.size[1]]
    }

    /// The pixels whose centres lie in the bounds, with a hundredth of a pixel to spare.
    fn pixels(&self, bounds: &Bounds) -> Option<PixelRect> {
        let min = [0, 1].map(|axis| (bounds.min[axis] - 0.51).ceil().clamp(0.0, self.size[axis]) as u32);
        let max = [0, 1].map(|axis| (bounds.max[axis] + 0.51).floor().clamp(0.0, self.size[axis]) as u32);
        (min[0] < max[0] && min[1] < max[1]).then_some(PixelRect { min, max })
    }
}

/// The twelve edges of a box as pairs of corner numbers.
fn box_edges() -> impl Iterator<Item = (usize, usize)> {
    (0..8usize).flat_map(|corner| {
        [1, 2, 4].into_iter().filter(move |bit| corner & bit == 0).map(move |bit| (corner, corner | bit))
    })
}

struct Bounds {
    min: [f64; 2],
    max: [f64; 2],
}

impl Bounds {
    const NOTHING: Self = Self { min: [f64::INFINITY; 2], max: [f64::NEG_INFINITY; 2] };

    fn widen(&mut self, point: [f64; 2]) {
        for (axis, at) in point.into_iter().enumerate() {
            self.min[axis] = self.min[axis].min(at);
            self.max[axis] = self.max[axis].max(at);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BrickLayout, Camera, NamedView, StoredType, VolumeDesc};
    use glam::UVec2;

    fn scene(camera: impl Fn(&VolumeDesc) -> Camera) -> (FrameRays, BrickGrid) {
        let desc = VolumeDesc::new(UVec3::new(90, 70, 130), StoredType::U8);
        let grid = BrickLayout { edge: 32, halo: 2 }.grid(desc.extent);
        let rays =
            FrameRays::new(&desc.level(0), &camera(&desc), UVec2::new(40, 30), 1.0).expect("sound camera");
        (rays, grid)
    }

    fn every_sample_lies_in_its_footprint(camera: impl Fn(&VolumeDesc) -> Camera) {
        let (rays, grid) = scene(camera);
        let footprints = Footprints::new(&rays);
        let bricks: Vec<_> = (0..grid.len()).map(|b| footprints.of_brick(&grid, grid.brick(b))).collect();
        for row in 0..30 {
            for column in 0..40 {
                let ray = rays.ray(column, row);
                for number in 0..rays.sample_count {
                    let Some(brick) = grid.owner(ray.sample(number)) else { continue };
                    let rect = bricks[grid.index(brick)].expect("a brick with a sample is in the frustum");
                    assert!((rect.min[0]..rect.max[0]).contains(&column));
                    assert!((rect.min[1]..rect.max[1]).contains(&row));
                }
            }
        }
    }

    #[test]
    fn rectangles_are_counted_from_their_tile() {
        let rect = |min, max| PixelRect { min, max };
        let tile = rect([100, 50], [200, 150]);
        let both = rect([90, 70], [120, 80]).union(rect([150, 60], [160, 65]));
        assert_eq!(both.in_tile(&tile), rect([0, 10], [60, 30]));
        assert_eq!(both.intersection(tile), rect([100, 60], [160, 80]));
        assert!(both.overlaps(&tile) && !both.overlaps(&rect([160, 0], [170, 500])));
    }

    #[test]
    fn every_sample_lies_in_its_footprint_from_outside() {
        every_sample_lies_in_its_footprint(|desc| Camera::framing_around(desc, 30.0, 20.0));
        every_sample_lies_in_its_footprint(|desc| Camera::framing(desc, NamedView::Top));
    }

    #[test]
    fn every_sample_lies_in_its_footprint_from_inside() {
        every_sample_lies_in_its_footprint(|desc| Camera {
            eye_mm: DVec3::new(30.0, 27.5, 60.0),
            target_mm: DVec3::new(80.0, 40.0, 10.0),
            ..Camera::framing(desc, NamedView::Front)
        });
    }

    #[test]
    fn bricks_behind_the_eye_are_outside_the_frustum() {
        let (rays, grid) = scene(|desc| Camera {
            eye_mm: DVec3::new(45.0, 60.0, 60.0),
            target_mm: DVec3::new(45.0, 90.0, 60.0),
            ..Camera::framing(desc, NamedView::Front)
        });
        assert!(Footprints::new(&rays).of_brick(&grid, UVec3::ZERO).is_none());
    }
}
