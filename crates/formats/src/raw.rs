use glam::{DVec3, UVec3};
use glassbrick_volume::{Endian, Rescale, StoredType};

/// What a raw file does not say of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct RawLayout {
    /// Voxels along x (fastest in the file), y and z.
    pub extent: UVec3,
    pub stored_type: StoredType,
    pub endian: Endian,
    /// Distance of neighbouring voxel centres, in mm; positive.
    pub spacing_mm: DVec3,
    /// Bytes before the first voxel, in a compressed file after decompression.
    pub offset_bytes: u64,
    pub rescale: Rescale,
}
