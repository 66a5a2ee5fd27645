use glam::{DVec3, UVec2, UVec3};

use crate::{Camera, VolumeDesc};

/// A volume at one of its levels: level L halves level 0 L times, and still ends where that does.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeLevel {
    /// The level's own grid of voxels.
    pub desc: VolumeDesc,
    /// Where its box ends, in its voxel coordinates: n / 2^L − 0.5 for n voxels at level 0.
    pub end: DVec3,
}

impl VolumeDesc {
    /// The volume at a level: ⌈n / 2^L⌉ voxels of 2^L times the spacing, each the average of those that it covers.
    pub fn level(&self, level: u32) -> VolumeLevel {
        let scale = scale(level);
        let first_centre = DVec3::splat((scale - 1.0) / 2.0);
        let desc = Self {
            extent: level_extent(self.extent, level),
            spacing_mm: self.spacing_mm * scale,
            origin_mm: self.world_from_voxel().transform_point3(first_centre),
            ..self.clone()
        };
        VolumeLevel { desc, end: level_end(self.extent, level) }
    }

    /// The coarsest of `levels` levels whose voxels are no larger than a pixel of a picture of `size` pixels, where
    /// the volume is nearest; 0 for an eye inside.
    ///
    /// # Errors
    /// When the camera is impossible: why, as a sentence.
    pub fn auto_level(&self, camera: &Camera, size: UVec2, levels: u32) -> Result<u32, &'static str> {
        let forward = camera.basis()?.forward;
        let [low, high] = self.box_voxel();
        let eye_voxel = self.voxel_from_world().transform_point3(camera.eye_mm);
        if eye_voxel.cmpge(low).all() && eye_voxel.cmple(high).all() {
            return Ok(0);
        }
        let depths = self.corners_mm().map(|corner| (corner - camera.eye_mm).dot(forward));
        let nearest_mm = depths.into_iter().fold(f64::INFINITY, f64::min);
        let pixel_mm = camera.pixel_mm(size, nearest_mm);
        let is_fine = |level: &u32| scale(*level) * self.spacing_mm.max_element() <= pixel_mm;
        Ok((0..levels).take_while(is_fine).last().unwrap_or(0))
    }
}

/// Voxels of level 0 along a voxel of a level.
fn scale(level: u32) -> f64 {
    f64::from(level).exp2()
}

/// Voxels of a level of a volume that has `extent` at level 0.
pub fn level_extent(extent: UVec3, level: u32) -> UVec3 {
    extent.map(|n| if level < 32 { n.div_ceil(1 << level) } else { 1 })
}

/// Where the box of that level ends, in its voxel coordinates.
pub fn level_end(extent: UVec3, level: u32) -> DVec3 {
    extent.as_dvec3() / scale(level) - 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{NamedView, Projection, StoredType};

    #[test]
    fn a_level_covers_the_same_box_in_the_world() {
        let mut desc = VolumeDesc::new(UVec3::new(9, 8, 5), StoredType::U8);
        desc.spacing_mm = DVec3::new(0.5, 1.0, 3.0);
        desc.origin_mm = DVec3::new(-7.0, 0.0, 11.0);
        let level = desc.level(2);
        assert_eq!(level.desc.extent, UVec3::new(3, 2, 2));
        let corner = |desc: &VolumeDesc, voxel| desc.world_from_voxel().transform_point3(voxel);
        let [low, high] = desc.box_voxel();
        assert_eq!(corner(&desc, low), corner(&level.desc, DVec3::splat(-0.5)));
        assert_eq!(corner(&desc, high), corner(&level.desc, level.end));
    }

    #[test]
    fn the_level_of_a_view_has_voxels_no_larger_than_a_pixel() {
        let desc = VolumeDesc::new(UVec3::splat(512), StoredType::U8);
        let camera = |height_mm| Camera {
            projection: Projection::Orthographic { height_mm },
            ..Camera::framing(&desc, NamedView::Front)
        };
        let level = |height_mm, levels| desc.auto_level(&camera(height_mm), UVec2::new(64, 100), levels);
        assert_eq!(level(99.0, 5), Ok(0));
        assert_eq!(level(399.0, 5), Ok(1));
        assert_eq!(level(400.0, 5), Ok(2));
        assert_eq!(level(400.0, 2), Ok(1), "there is no coarser one");
        let inside = Camera { eye_mm: DVec3::splat(200.0), ..camera(1e6) };
        assert_eq!(desc.auto_level(&inside, UVec2::splat(100), 5), Ok(0));
    }

    #[test]
    fn the_nearest_depth_decides_in_perspective() {
        let desc = VolumeDesc::new(UVec3::splat(512), StoredType::U8);
        let camera = Camera::framing(&desc, NamedView::Front);
        let nearest_mm = 512.0 * 0.75f64.sqrt() / 15f64.to_radians().sin() - 256.0;
        let pixels_for_2mm = (nearest_mm * 2.0 * 15f64.to_radians().tan() / 2.0) as u32;
        let level = |pixels| desc.auto_level(&camera, UVec2::splat(pixels), 5);
        assert_eq!(level(pixels_for_2mm), Ok(1));
        assert_eq!(level(pixels_for_2mm + 1), Ok(0));
    }
}
