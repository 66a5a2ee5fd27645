use wgpu::{TextureFormat, TextureUsages};

use crate::{GpuDevice, GpuError};

/// What slices of a tile are drawn into.
pub struct SliceTargets {
    pub size: [u32; 2],
    /// What lies in front of the layer that is drawn; of projections, the values.
    pub accumulated: wgpu::TextureView,
    accumulated_texture: wgpu::Texture,
    /// The layer that is drawn.
    pub layer: wgpu::TextureView,
    /// Pixels that are opaque.
    pub stencil: wgpu::TextureView,
    /// Ranks of projected values.
    pub ranks: wgpu::TextureView,
}

/// Of opaque pixels.
pub const STENCIL_FORMAT: TextureFormat = TextureFormat::Stencil8;
/// Of ranks.
pub const RANK_FORMAT: TextureFormat = TextureFormat::Depth32Float;

impl SliceTargets {
    pub fn new(
        device: &GpuDevice,
        size: [u32; 2],
        accumulated_format: TextureFormat,
    ) -> Result<Self, GpuError> {
        let out_of_memory = device.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let texture = |label, format, more: TextureUsages| {
            device.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: TextureUsages::RENDER_ATTACHMENT | more,
                view_formats: &[],
            })
        };
        let read = TextureUsages::TEXTURE_BINDING;
        let accumulated_texture = texture("accumulated", accumulated_format, read | TextureUsages::COPY_SRC);
        let layer = texture("layer", accumulated_format, read);
        let stencil = texture("stencil", STENCIL_FORMAT, TextureUsages::empty());
        let ranks = texture("ranks", RANK_FORMAT, TextureUsages::empty());
        if pollster::block_on(out_of_memory.pop()).is_some() {
            let pixels = u64::from(size[0]) * u64::from(size[1]);
            return Err(GpuError::OutOfMemory { what: "a picture", needed_bytes: pixels * 37 });
        }
        let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
        Ok(Self {
            size,
            accumulated: view(&accumulated_texture),
            accumulated_texture,
            layer: view(&layer),
            stencil: view(&stencil),
            ranks: view(&ranks),
        })
    }

    /// The texture that pictures are read from.
    pub fn accumulated_texture(&self) -> &wgpu::Texture {
        &self.accumulated_texture
    }
}
