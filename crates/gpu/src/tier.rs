use glassbrick_residency::TexelFormat;
use glassbrick_shaders::MOST_TEXTURES;
use glassbrick_volume::StoredType;
use wgpu::{DownlevelFlags, Features};

use crate::GpuError;
use crate::adapter::is_hardware;

/// What passes may use of a device: the one place where its features and limits are looked at.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Tier {
    /// Whether it computes on the CPU.
    pub is_software: bool,
    /// Textures of an atlas: many of one cube each; or one that grows, where a driver executes every branch that
    /// samples a texture, as software drivers do.
    pub textures: usize,
    /// Texels of a 3D texture along an axis, at most.
    pub largest_volume_texture: u32,
    /// Whether slices can be drawn at all: into f32.
    pub draws_f32: bool,
    /// Whether f32 can be blended; f16 is, where not, and no means are drawn by slices.
    pub blends_f32: bool,
    /// Formats whose texels are filtered exactly, found by trying.
    pub filtered: Vec<TexelFormat>,
    /// Formats that textures can have.
    pub formats: Vec<TexelFormat>,
}

/// How a volume's voxels are kept and read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TexelChoice {
    pub format: TexelFormat,
    /// Between texels by the texture unit; else by eight loads.
    pub filters: bool,
}

/// The features that passes use where they are there.
const WANTED: Features = Features::TEXTURE_FORMAT_16BIT_NORM
    .union(Features::FLOAT32_FILTERABLE)
    .union(Features::FLOAT32_BLENDABLE);

impl Tier {
    /// What to ask an adapter for.
    pub fn features(adapter: &wgpu::Adapter) -> Features {
        adapter.features() & WANTED
    }

    /// Whether an adapter can draw at all.
    pub fn check(adapter: &wgpu::Adapter, described: &str) -> Result<(), GpuError> {
        let flags = adapter.get_downlevel_capabilities().flags;
        let needs = [
            (DownlevelFlags::COMPUTE_SHADERS, "no compute shaders"),
            (DownlevelFlags::INDIRECT_EXECUTION, "no indirect drawing"),
            (DownlevelFlags::FRAGMENT_WRITABLE_STORAGE, "no storage buffers"),
        ];
        match needs.into_iter().find(|(flag, _)| !flags.contains(*flag)) {
            Some((_, lacks)) => Err(GpuError::TooWeak { adapter: described.to_owned(), lacks }),
            None => Ok(()),
        }
    }

    /// The tier of a device; `filters_exactly` tries a format that can be filtered.
    pub fn new(
        adapter: &wgpu::Adapter,
        device: &wgpu::Device,
        filters_exactly: impl Fn(TexelFormat) -> bool,
    ) -> Self {
        let (features, limits) = (device.features(), device.limits());
        let has = |feature| features.contains(feature);
        let mut formats = vec![TexelFormat::R8, TexelFormat::Rg8, TexelFormat::R32];
        let mut filterable = vec![TexelFormat::R8];
        if has(Features::TEXTURE_FORMAT_16BIT_NORM) {
            formats.push(TexelFormat::R16);
            filterable.push(TexelFormat::R16);
        }
        if has(Features::FLOAT32_FILTERABLE) {
            filterable.push(TexelFormat::R32);
        }
        let f32_picture =
            adapter.get_texture_format_features(wgpu::TextureFormat::Rgba32Float).allowed_usages;
        let draws_f32 = f32_picture.contains(wgpu::TextureUsages::RENDER_ATTACHMENT);
        let is_software = !is_hardware(&adapter.get_info());
        // The transfer function is one more.
        let fits_all = limits.max_sampled_textures_per_shader_stage as usize > MOST_TEXTURES;
        Self {
            is_software,
            textures: if is_software || !fits_all { 1 } else { MOST_TEXTURES },
            largest_volume_texture: limits.max_texture_dimension_3d,
            draws_f32,
            blends_f32: draws_f32 && has(Features::FLOAT32_BLENDABLE),
            filtered: filterable.into_iter().filter(|&format| filters_exactly(format)).collect(),
            formats,
        }
    }

    /// What slices are blended into.
    pub fn blend_format(&self) -> wgpu::TextureFormat {
        if self.blends_f32 { wgpu::TextureFormat::Rgba32Float } else { wgpu::TextureFormat::Rgba16Float }
    }

    /// How the voxels of a stored type are kept: the smallest format that is filtered exactly, else the smallest.
    pub fn texels(&self, stored_type: StoredType) -> TexelChoice {
        let enough: &[TexelFormat] = match stored_type {
            StoredType::U8 | StoredType::I8 => &[TexelFormat::R8, TexelFormat::R16, TexelFormat::Rg8],
            StoredType::U16 | StoredType::I16 => &[TexelFormat::R16, TexelFormat::Rg8],
            StoredType::U32 | StoredType::I32 | StoredType::F32 | StoredType::F64 => &[TexelFormat::R32],
        };
        let filtered = enough.iter().find(|format| self.filtered.contains(format));
        let there = enough.iter().find(|format| self.formats.contains(format));
        let format =
            *filtered.or(there).expect("every device has 8 bits in one and two channels, and 32 bits");
        TexelChoice { format, filters: filtered.is_some() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tier(filtered: &[TexelFormat], formats: &[TexelFormat]) -> Tier {
        Tier {
            is_software: false,
            textures: 16,
            largest_volume_texture: 2048,
            draws_f32: true,
            blends_f32: true,
            filtered: filtered.to_vec(),
            formats: formats.to_vec(),
        }
    }

    #[test]
    fn a_coarse_filter_is_met_with_loads_of_the_smallest_format() {
        use TexelFormat::{R8, R16, R32, Rg8};
        let hardware = tier(&[], &[R8, Rg8, R32, R16]);
        assert_eq!(hardware.texels(StoredType::U8), TexelChoice { format: R8, filters: false });
        assert_eq!(hardware.texels(StoredType::I16), TexelChoice { format: R16, filters: false });
        let software = tier(&[R16, R32], &[R8, Rg8, R32, R16]);
        assert_eq!(software.texels(StoredType::I8), TexelChoice { format: R16, filters: true });
        assert_eq!(software.texels(StoredType::F64), TexelChoice { format: R32, filters: true });
        let least = tier(&[], &[R8, Rg8, R32]);
        assert_eq!(least.texels(StoredType::U16), TexelChoice { format: Rg8, filters: false });
    }
}
