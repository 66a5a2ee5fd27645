use wgpu::BufferUsages;

use crate::frame_uniform::entries;
use crate::{GpuDevice, GpuScene};

/// What all passes of a frame read.
pub struct SharedBuffers {
    pub frame: wgpu::Buffer,
    entries: wgpu::Texture,
    entries_view: wgpu::TextureView,
}

impl SharedBuffers {
    pub fn new(device: &wgpu::Device) -> Self {
        let entries = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("transfer function"),
            size: wgpu::Extent3d {
                width: glassbrick_volume::BAKED_ENTRIES as u32,
                height: 1,
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        Self {
            frame: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("frame"),
                size: size_of::<glassbrick_shaders::Frame>() as u64,
                usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            entries_view: entries.create_view(&Default::default()),
            entries,
        }
    }

    /// Takes what a scene's tiles have in common.
    pub fn write(&self, device: &GpuDevice, scene: &GpuScene) {
        let entries = entries(scene);
        let size = self.entries.size();
        device.queue.write_texture(
            self.entries.as_image_copy(),
            bytemuck::cast_slice(&entries),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(size.width * size_of::<[f32; 4]>() as u32),
                rows_per_image: None,
            },
            size,
        );
    }

    /// The baked transfer function, to be bound.
    pub fn entries(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::TextureView(&self.entries_view)
    }
}
