use glam::{DAffine3, DMat3, DVec3, UVec3};

use crate::StoredType;

/// How far the volume reaches beyond its outermost voxels' faces, in voxels.
///
/// It keeps cameras at round numbers from putting a whole face on a knife's edge.
pub const VOLUME_MARGIN_VOXELS: f64 = 1.0 / 1024.0;

/// What a stored value means: `value = slope · stored + intercept`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rescale {
    pub slope: f64,
    pub intercept: f64,
}

impl Rescale {
    /// Stored values are the values.
    pub const IDENTITY: Self = Self { slope: 1.0, intercept: 0.0 };

    /// The value of a stored value.
    pub fn value(self, stored: f64) -> f64 {
        self.slope * stored + self.intercept
    }

    /// The stored value, not rounded, that has this value. The slope must not be zero.
    pub fn stored(self, value: f64) -> f64 {
        (value - self.intercept) / self.slope
    }
}

impl Default for Rescale {
    fn default() -> Self {
        Self::IDENTITY
    }
}

/// What a volume is: its grid of voxels and where that lies in the world.
///
/// World space is LPS millimetres: +x to the patient's left, +y posterior, +z superior. Voxel (i, j, k) has its
/// centre at voxel coordinate (i, j, k), and `world = origin + direction · (spacing ∘ voxel)`.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeDesc {
    /// Voxels along x (fastest in memory), y and z.
    pub extent: UVec3,
    pub stored_type: StoredType,
    /// Distance of neighbouring voxel centres along each voxel axis, in mm; positive.
    pub spacing_mm: DVec3,
    /// World position of the centre of voxel (0, 0, 0).
    pub origin_mm: DVec3,
    /// World directions of the voxel axes as unit columns; they need not be orthogonal (gantry tilt).
    pub direction: DMat3,
    pub rescale: Rescale,
}

impl VolumeDesc {
    /// A volume of cubic 1 mm voxels along the world's axes, whose values are the stored ones.
    pub fn new(extent: UVec3, stored_type: StoredType) -> Self {
        Self {
            extent,
            stored_type,
            spacing_mm: DVec3::ONE,
            origin_mm: DVec3::ZERO,
            direction: DMat3::IDENTITY,
            rescale: Rescale::IDENTITY,
        }
    }

    /// Takes voxel coordinates to world millimetres.
    pub fn world_from_voxel(&self) -> DAffine3 {
        DAffine3 {
            matrix3: self.direction * DMat3::from_diagonal(self.spacing_mm),
            translation: self.origin_mm,
        }
    }

    /// Takes world millimetres to voxel coordinates. The directions must be independent.
    pub fn voxel_from_world(&self) -> DAffine3 {
        self.world_from_voxel().inverse()
    }

    /// The inverse transpose, by which surfaces' normals go from gradients per voxel to world space.
    pub fn normal_from_gradient(&self) -> DMat3 {
        self.world_from_voxel().matrix3.inverse().transpose()
    }

    /// The smallest spacing, in mm: the length that a step of one voxel means.
    pub fn smallest_spacing_mm(&self) -> f64 {
        self.spacing_mm.min_element()
    }

    /// Number of voxels.
    pub fn voxels(&self) -> u64 {
        self.extent.as_u64vec3().element_product()
    }

    /// Size of the voxels as stored, in bytes.
    pub fn bytes(&self) -> u64 {
        self.voxels() * self.stored_type.bytes() as u64
    }

    /// Size of one z-slice as stored, in bytes.
    pub fn slice_bytes(&self) -> u64 {
        u64::from(self.extent.x) * u64::from(self.extent.y) * self.stored_type.bytes() as u64
    }

    /// The box that frames the volume, [−0.5, n − 0.5], in voxel coordinates: its two opposite corners.
    pub fn box_voxel(&self) -> [DVec3; 2] {
        [DVec3::splat(-0.5), self.extent.as_dvec3() - 0.5]
    }

    /// The eight corners of that box in world millimetres.
    pub fn corners_mm(&self) -> [DVec3; 8] {
        let [low, high] = self.box_voxel();
        let world_from_voxel = self.world_from_voxel();
        box_corners(low, high).map(|corner| world_from_voxel.transform_point3(corner))
    }
}

/// The eight corners of a box; bit 0 of the index chooses x, bit 1 y, bit 2 z.
pub(crate) fn box_corners(low: DVec3, high: DVec3) -> [DVec3; 8] {
    std::array::from_fn(|corner| {
        DVec3::new(
            if corner & 1 == 0 { low.x } else { high.x },
            if corner & 2 == 0 { low.y } else { high.y },
            if corner & 4 == 0 { low.z } else { high.z },
        )
    })
}
