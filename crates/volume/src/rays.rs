use glam::{DVec3, UVec2, Vec3};

use crate::volume_desc::box_corners;
use crate::{Camera, CameraBasis, Projection, VOLUME_MARGIN_VOXELS, VolumeLevel};

/// More samples than this along a ray would not be told apart by an `f32` sample number.
const MOST_SAMPLES: f64 = (1 << 24) as f64;

/// The rays of a frame and the sample planes that all bricks share.
///
/// Sample k lies at depth (k + 0.5)·Δ along the camera's forward direction. Rays begin at `first_sample`, the first
/// one whose plane can meet the volume; sample numbers below count from there.
#[derive(Clone, Debug)]
pub struct FrameRays {
    pub size: UVec2,
    /// Distance of neighbouring sample planes, Δ.
    pub step_mm: f64,
    /// The k of sample number 0.
    pub first_sample: u64,
    /// How many samples a ray has, at most.
    pub sample_count: u32,
    /// The eye in voxel coordinates.
    pub eye_voxel: DVec3,
    /// Forward in voxel coordinates per mm of depth.
    pub forward_voxel: DVec3,
    perspective: bool,
    /// From the eye to the picture's right and upper edge at depth 1 (perspective) or at any depth, in voxels.
    right_voxel: DVec3,
    up_voxel: DVec3,
    half_extent: [f64; 2],
}

/// The ray of one pixel in voxel coordinates: sample number n is at `start + n · step`, formed in `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Position of sample number 0.
    pub start: Vec3,
    /// From one sample to the next.
    pub step: Vec3,
    /// The world length of a step, Δ·|ray|.
    pub step_length_mm: f32,
}

/// How the rays of a frame fan out, in f64: each of these is `middle + x·across + y·along` for a pixel whose centre is at
/// (x, y), both from −1 to 1, x to the right and y upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayFan {
    /// Position of sample number 0, in voxels: middle, across, along.
    pub start_voxel: [DVec3; 3],
    /// From one sample to the next, in voxels: middle, across, along.
    pub step_voxel: [DVec3; 3],
    /// From the picture's middle to its right and upper edge at depth 1; nothing where rays are parallel.
    pub half_extent: [f64; 2],
}

impl Ray {
    /// Voxel coordinates of a sample. This value alone decides which brick, cell and fraction the sample has.
    pub fn sample(&self, number: u32) -> Vec3 {
        self.start + number as f32 * self.step
    }
}

impl FrameRays {
    /// The rays of `camera` through a picture of `size` pixels, with samples `step_voxels` of the level's smallest
    /// spacing apart.
    ///
    /// # Errors
    /// When the camera is impossible or the step too small for this volume: which, as a sentence.
    pub fn new(
        level: &VolumeLevel,
        camera: &Camera,
        size: UVec2,
        step_voxels: f64,
    ) -> Result<Self, &'static str> {
        let CameraBasis { forward, right, up } = camera.basis()?;
        let desc = &level.desc;
        if !(step_voxels > 0.0 && step_voxels.is_finite()) {
            return Err("the step must be a positive number of voxels");
        }
        let step_mm = step_voxels * desc.smallest_spacing_mm();
        let (low, high) = (DVec3::splat(-0.5 - VOLUME_MARGIN_VOXELS), level.end + VOLUME_MARGIN_VOXELS);
        let world_from_voxel = desc.world_from_voxel();
        let depths = box_corners(low, high)
            .map(|corner| (world_from_voxel.transform_point3(corner) - camera.eye_mm).dot(forward));
        let nearest = depths.into_iter().fold(f64::INFINITY, f64::min);
        let farthest = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let first_sample = (nearest / step_mm - 0.5).ceil().max(0.0);
        let sample_count = ((farthest / step_mm - 0.5).floor() - first_sample + 1.0).max(0.0);
        if !(sample_count < MOST_SAMPLES && first_sample < MOST_SAMPLES * MOST_SAMPLES) {
            return Err(
                "the step is too small, or the eye too far away, for this volume: a ray would have too many samples",
            );
        }
        let voxel_from_world = desc.voxel_from_world();
        let [half_width, half_height] = camera.half_extent(size);
        Ok(Self {
            size,
            step_mm,
            first_sample: first_sample as u64,
            sample_count: sample_count as u32,
            eye_voxel: voxel_from_world.transform_point3(camera.eye_mm),
            forward_voxel: voxel_from_world.transform_vector3(forward),
            perspective: matches!(camera.projection, Projection::Perspective { .. }),
            right_voxel: voxel_from_world.transform_vector3(right) * half_width,
            up_voxel: voxel_from_world.transform_vector3(up) * half_height,
            half_extent: [half_width, half_height],
        })
    }

    /// Whether all rays start at the eye.
    pub fn is_perspective(&self) -> bool {
        self.perspective
    }

    /// The ray through the centre of pixel (column, row); row 0 is on top.
    pub fn ray(&self, column: u32, row: u32) -> Ray {
        let (x, y) = (self.across(column), self.along(row));
        let aside = self.right_voxel * x + self.up_voxel * y;
        let depth_mm = (self.first_sample as f64 + 0.5) * self.step_mm;
        let (start, direction) = if self.perspective {
            let ray = self.forward_voxel + aside;
            (self.eye_voxel + ray * depth_mm, ray)
        } else {
            (self.eye_voxel + aside + self.forward_voxel * depth_mm, self.forward_voxel)
        };
        Ray {
            start: start.as_vec3(),
            step: (direction * self.step_mm).as_vec3(),
            step_length_mm: self.step_length_mm(column, row),
        }
    }

    /// The world length of a step of the ray through the centre of pixel (column, row), Δ·|ray|.
    pub fn step_length_mm(&self, column: u32, row: u32) -> f32 {
        let length = if self.perspective {
            let [right, up] =
                [self.half_extent[0] * self.across(column), self.half_extent[1] * self.along(row)];
            (1.0 + right * right + up * up).sqrt()
        } else {
            1.0
        };
        (length * self.step_mm) as f32
    }

    /// The size of a pixel at depth 1 mm; of any pixel where rays are parallel.
    pub fn pixel_mm(&self) -> f64 {
        2.0 * self.half_extent[1] / f64::from(self.size.y)
    }

    /// Where a column's pixels have their centres, from −1 on the left to 1 on the right.
    pub fn across(&self, column: u32) -> f64 {
        2.0 * (f64::from(column) + 0.5) / f64::from(self.size.x) - 1.0
    }

    /// Where a row's pixels have their centres, from 1 on top to −1 below.
    pub fn along(&self, row: u32) -> f64 {
        1.0 - 2.0 * (f64::from(row) + 0.5) / f64::from(self.size.y)
    }

    /// All rays at once, for those who form them elsewhere.
    pub fn fan(&self) -> RayFan {
        let depth_mm = self.depth_mm(0);
        let start = self.eye_voxel + self.forward_voxel * depth_mm;
        let (right, up) = (self.right_voxel, self.up_voxel);
        let step = self.forward_voxel * self.step_mm;
        if self.perspective {
            RayFan {
                start_voxel: [start, right * depth_mm, up * depth_mm],
                step_voxel: [step, right * self.step_mm, up * self.step_mm],
                half_extent: self.half_extent,
            }
        } else {
            RayFan {
                start_voxel: [start, right, up],
                step_voxel: [step, DVec3::ZERO, DVec3::ZERO],
                half_extent: [0.0; 2],
            }
        }
    }

    /// Depth along forward of a sample number, in mm.
    pub fn depth_mm(&self, number: u32) -> f64 {
        (self.first_sample as f64 + f64::from(number) + 0.5) * self.step_mm
    }

    /// Rows that take voxel coordinates to the picture: (right, up) in units of half the picture at depth 1 mm (or
    /// of half the picture, for an orthographic camera) and depth in mm. Each is a direction and an offset.
    pub fn picture_from_voxel(&self) -> [(DVec3, f64); 3] {
        let voxel_from_picture = glam::DMat3::from_cols(self.right_voxel, self.up_voxel, self.forward_voxel);
        let picture_from_voxel = voxel_from_picture.inverse();
        let offset = -(picture_from_voxel * self.eye_voxel);
        std::array::from_fn(|row| (picture_from_voxel.row(row), offset[row]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NamedView, StoredType, VolumeDesc};
    use glam::UVec3;

    #[test]
    fn the_middle_ray_looks_at_the_target() {
        let desc = VolumeDesc::new(UVec3::new(100, 60, 80), StoredType::U8);
        let camera = Camera::framing(&desc, NamedView::Front);
        let rays = FrameRays::new(&desc.level(0), &camera, UVec2::new(65, 33), 1.0).expect("sound camera");
        let ray = rays.ray(32, 16);
        assert!((ray.start.x - 49.5).abs() < 1e-4 && (ray.start.z - 39.5).abs() < 1e-4);
        assert!(ray.step.distance(Vec3::Y) < 1e-6);
        assert!((ray.start.y - -0.5).abs() < 1.0, "it begins at the volume's face: {}", ray.start.y);
    }

    #[test]
    fn an_eye_inside_starts_half_a_step_in_front_of_itself() {
        let desc = VolumeDesc::new(UVec3::splat(100), StoredType::U8);
        let camera = Camera {
            eye_mm: DVec3::splat(50.0),
            target_mm: DVec3::new(50.0, 90.0, 50.0),
            ..Camera::framing(&desc, NamedView::Front)
        };
        let rays = FrameRays::new(&desc.level(0), &camera, UVec2::new(1, 1), 1.0).expect("sound camera");
        assert_eq!(rays.first_sample, 0);
        assert!(rays.ray(0, 0).sample(0).distance(Vec3::new(50.0, 50.5, 50.0)) < 1e-5);
    }

    #[test]
    fn picture_from_voxel_takes_a_ray_to_its_pixel() {
        let desc = VolumeDesc {
            spacing_mm: DVec3::new(0.7, 0.9, 2.5),
            ..VolumeDesc::new(UVec3::new(40, 50, 60), StoredType::U8)
        };
        let camera = Camera::framing_around(&desc, 33.0, 21.0);
        let rays = FrameRays::new(&desc.level(0), &camera, UVec2::new(64, 48), 1.0).expect("sound camera");
        let sample = rays.ray(10, 40).sample(5).as_dvec3();
        let [right, up, depth] =
            rays.picture_from_voxel().map(|(direction, offset)| direction.dot(sample) + offset);
        assert!((right / depth - (2.0 * 10.5 / 64.0 - 1.0)).abs() < 1e-4);
        assert!((up / depth - (1.0 - 2.0 * 40.5 / 48.0)).abs() < 1e-4);
        assert!((depth - rays.depth_mm(5)).abs() < 1e-3);
    }
}
