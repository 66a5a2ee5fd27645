use wgpu::BufferUsages;

use crate::frame_uniform::entries;
use crate::grown_buffer::GrownBuffer;
use crate::{GpuDevice, GpuError, GpuScene};

/// What all passes of a frame read.
pub struct SharedBuffers {
    pub frame: wgpu::Buffer,
    pub extinctions: GrownBuffer,
    pub colors: GrownBuffer,
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
            extinctions: GrownBuffer::new("extinctions", usage),
            colors: GrownBuffer::new("colours", usage),
        }
    }

    /// Takes what a scene's tiles have in common.
    pub fn write(&mut self, device: &GpuDevice, scene: &GpuScene) -> Result<(), GpuError> {
        let [extinctions, colors] = entries(scene);
        self.extinctions.write(device, bytemuck::cast_slice(&extinctions))?;
        self.colors.write(device, bytemuck::cast_slice(&colors))
    }
}
