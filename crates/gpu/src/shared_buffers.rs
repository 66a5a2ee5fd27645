use wgpu::BufferUsages;

use crate::frame_uniform::entries;
use crate::grown_buffer::GrownBuffer;
use crate::ray_parts::ray_parts;
use crate::{GpuDevice, GpuError, GpuScene};

/// What all passes of a frame read.
pub struct SharedBuffers {
    pub frame: wgpu::Buffer,
    pub ray_parts: GrownBuffer,
    pub entries: GrownBuffer,
}

impl SharedBuffers {
    pub fn new(device: &wgpu::Device) -> Self {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        Self {
            frame: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("frame"),
                size: size_of::<glassbrick_shaders::Frame>() as u64,
                usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            }),
            ray_parts: GrownBuffer::new("ray parts", usage),
            entries: GrownBuffer::new("transfer function", usage),
        }
    }

    /// Takes what a scene's tiles have in common.
    pub fn write(&mut self, device: &GpuDevice, scene: &GpuScene) -> Result<(), GpuError> {
        self.ray_parts.write(device, bytemuck::cast_slice(&ray_parts(scene.rays)))?;
        self.entries.write(device, bytemuck::cast_slice(&entries(scene)))
    }
}
