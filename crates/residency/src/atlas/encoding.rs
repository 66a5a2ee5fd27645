use glassbrick_volume::{Brick, StoredType, Voxels};

/// The texels that voxels are kept as on a GPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TexelFormat {
    /// 8 bits.
    R8,
    /// 16 bits; not every device has it.
    R16,
    /// 16 bits in two channels, which every device has: low byte, high byte.
    Rg8,
    /// 32 bits.
    R32,
}

impl TexelFormat {
    pub const fn bytes(self) -> u32 {
        match self {
            Self::R8 => 1,
            Self::R16 | Self::Rg8 => 2,
            Self::R32 => 4,
        }
    }

    pub const fn wgpu(self) -> wgpu::TextureFormat {
        match self {
            Self::R8 => wgpu::TextureFormat::R8Unorm,
            Self::R16 => wgpu::TextureFormat::R16Unorm,
            Self::Rg8 => wgpu::TextureFormat::Rg8Unorm,
            Self::R32 => wgpu::TextureFormat::R32Float,
        }
    }
}

/// How stored values become texels: whole numbers as their distance from the smallest that the volume has, so that a
/// volume of few values keeps their precision in normalised texels; others as they are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VoxelEncoding {
    pub format: TexelFormat,
    /// The stored value of texel 0.
    pub bias: i32,
}

impl VoxelEncoding {
    /// For a volume whose smallest stored value is `min`.
    pub fn new(format: TexelFormat, stored_type: StoredType, min: f32) -> Self {
        let is_kept_whole =
            matches!(stored_type, StoredType::U8 | StoredType::I8 | StoredType::U16 | StoredType::I16);
        Self { format, bias: if is_kept_whole { min as i32 } else { 0 } }
    }

    /// Factors by which a texel's first two channels add up to the distance from the bias.
    pub fn stored_from_texel(&self) -> [f32; 2] {
        match self.format {
            TexelFormat::R8 => [255.0, 0.0],
            TexelFormat::R16 => [65535.0, 0.0],
            TexelFormat::Rg8 => [255.0, 255.0 * 256.0],
            TexelFormat::R32 => [1.0, 0.0],
        }
    }

    /// Writes one z-slice of a brick's voxels as texels, rows `row_bytes` apart; `texels` holds as many rows as a brick
    /// has voxels along an axis.
    pub fn encode_slice(&self, brick: &Brick, z: u32, row_bytes: usize, texels: &mut [u8]) {
        let edge = brick.edge as usize;
        let slice = z as usize * edge * edge..(z as usize + 1) * edge * edge;
        match &brick.voxels {
            Voxels::U8(voxels) => self.encode_whole(&voxels[slice], edge, row_bytes, texels),
            Voxels::I8(voxels) => self.encode_whole(&voxels[slice], edge, row_bytes, texels),
            Voxels::U16(voxels) => self.encode_whole(&voxels[slice], edge, row_bytes, texels),
            Voxels::I16(voxels) => self.encode_whole(&voxels[slice], edge, row_bytes, texels),
            Voxels::F32(voxels) => each_row(&voxels[slice], edge, row_bytes, texels, f32::to_le_bytes),
        }
    }

    fn encode_whole<V: Copy + Into<i32>>(
        &self,
        voxels: &[V],
        edge: usize,
        row_bytes: usize,
        texels: &mut [u8],
    ) {
        let bias = self.bias;
        match self.format {
            TexelFormat::R8 => each_row(voxels, edge, row_bytes, texels, |v: V| [(v.into() - bias) as u8]),
            TexelFormat::R16 | TexelFormat::Rg8 => {
                each_row(voxels, edge, row_bytes, texels, |v: V| ((v.into() - bias) as u16).to_le_bytes());
            }
            TexelFormat::R32 => {
                each_row(voxels, edge, row_bytes, texels, |v: V| ((v.into() - bias) as f32).to_le_bytes());
            }
        }
    }
}

fn each_row<V: Copy, const N: usize>(
    voxels: &[V],
    edge: usize,
    row_bytes: usize,
    texels: &mut [u8],
    encoded: impl Fn(V) -> [u8; N],
) {
    for (row, out) in voxels.chunks_exact(edge).zip(texels.chunks_mut(row_bytes)) {
        for (texel, &voxel) in out.as_chunks_mut::<N>().0.iter_mut().zip(row) {
            *texel = encoded(voxel);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texels(encoding: VoxelEncoding, voxels: Voxels) -> Vec<u8> {
        let mut texels = vec![0xEE; 4 * 16];
        let brick = Brick::new(2, voxels);
        for (z, slice) in texels.chunks_mut(2 * 16).enumerate() {
            encoding.encode_slice(&brick, z as u32, 16, slice);
        }
        texels
    }

    fn encoding(format: TexelFormat, bias: i32) -> VoxelEncoding {
        VoxelEncoding { format, bias }
    }

    #[test]
    fn whole_numbers_become_distances_from_the_smallest() {
        let voxels: Vec<i16> = vec![-1000, -999, 300, 24, 0, 1, 2, 31767];
        let out = texels(encoding(TexelFormat::R16, -1000), Voxels::I16(voxels.clone()));
        assert_eq!(out[..6], [0, 0, 1, 0, 0xEE, 0xEE], "rows keep their distance");
        assert_eq!(u16::from_le_bytes([out[16], out[17]]), 1300);
        assert_eq!(out[48 + 2..48 + 4], u16::to_le_bytes(32767));
        let out = texels(encoding(TexelFormat::R32, -1000), Voxels::I16(voxels));
        assert_eq!(out[4..8], 1f32.to_le_bytes());
    }

    #[test]
    fn eight_bits_fit_into_any_format() {
        let voxels: Vec<i8> = vec![-128, 127, 0, 1, 2, 3, 4, 5];
        assert_eq!(texels(encoding(TexelFormat::R8, -128), Voxels::I8(voxels.clone()))[..2], [0, 255]);
        assert_eq!(texels(encoding(TexelFormat::R16, -128), Voxels::I8(voxels))[..4], [0, 0, 255, 0]);
    }

    #[test]
    fn fractions_are_kept_as_they_are() {
        let voxels: Vec<f32> = vec![0.5, -2.25, 0.0, 0.0, 0.0, 0.0, 0.0, 1e30];
        let out = texels(VoxelEncoding::new(TexelFormat::R32, StoredType::F64, -2.25), Voxels::F32(voxels));
        assert_eq!(out[4..8], (-2.25f32).to_le_bytes());
        assert_eq!(out[52..56], 1e30f32.to_le_bytes());
    }
}
