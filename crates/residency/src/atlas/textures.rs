use glam::UVec3;

use super::{AtlasShape, TexelFormat};

/// The textures of an atlas, each made when the first slot in it is needed.
pub struct AtlasTextures {
    pub shape: AtlasShape,
    pub format: TexelFormat,
    textures: Vec<wgpu::Texture>,
}

impl AtlasTextures {
    pub fn new(shape: AtlasShape, format: TexelFormat) -> Self {
        Self { shape, format, textures: Vec::new() }
    }

    /// Bytes of one texture.
    pub fn texture_bytes(&self) -> u64 {
        self.shape.cube_voxels() * u64::from(self.shape.cubes_per_texture) * u64::from(self.format.bytes())
    }

    /// Bytes of the textures that are made.
    pub fn bytes(&self) -> u64 {
        self.texture_bytes() * self.textures.len() as u64
    }

    pub fn textures(&self) -> &[wgpu::Texture] {
        &self.textures
    }

    /// Makes textures until there are so many; returns how many there are then: fewer where the device's memory ends.
    pub async fn make(&mut self, device: &wgpu::Device, count: usize) -> usize {
        while self.textures.len() < count {
            // Some drivers say of one that does not fit that it is invalid.
            let out_of_memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
            let invalid = device.push_error_scope(wgpu::ErrorFilter::Validation);
            let texture = self.texture(device);
            let (invalid, out_of_memory) = (invalid.pop().await, out_of_memory.pop().await);
            if invalid.is_some() || out_of_memory.is_some() {
                break;
            }
            self.textures.push(texture);
        }
        self.textures.len()
    }

    fn texture(&self, device: &wgpu::Device) -> wgpu::Texture {
        let UVec3 { x, y, z } = self.shape.texture_extent();
        device.create_texture(&wgpu::TextureDescriptor {
            label: Some("atlas"),
            size: wgpu::Extent3d { width: x, height: y, depth_or_array_layers: z },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format: self.format.wgpu(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        })
    }
}
