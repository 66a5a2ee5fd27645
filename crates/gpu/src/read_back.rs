use bytemuck::Pod;

use crate::{GpuDevice, GpuError};

/// A buffer by which others are read.
pub struct ReadBack {
    buffer: wgpu::Buffer,
}

impl ReadBack {
    pub fn new(device: &wgpu::Device, bytes: u64) -> Self {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("read back"),
            size: bytes.max(16).next_multiple_of(16),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        Self { buffer }
    }

    /// Where copies go.
    pub fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Waits for what was submitted, and reads the first `count` items.
    ///
    /// # Errors
    /// When the device is lost or in trouble.
    pub fn read<T: Pod, R>(
        &self,
        device: &GpuDevice,
        count: usize,
        use_them: impl FnOnce(&[T]) -> R,
    ) -> Result<R, GpuError> {
        let bytes = (count * size_of::<T>()) as u64;
        self.buffer.map_async(wgpu::MapMode::Read, ..bytes, |_| ());
        device.wait()?;
        let mapped = self.buffer.get_mapped_range(..bytes).map_err(|error| GpuError::driver(&error))?;
        let result = match bytemuck::try_cast_slice(&mapped) {
            Ok(items) => use_them(items),
            Err(_) => use_them(&bytemuck::pod_collect_to_vec(&mapped)),
        };
        drop(mapped);
        self.buffer.unmap();
        Ok(result)
    }
}
