use crate::{GpuDevice, GpuError};

/// A buffer that is made anew when more is needed than it holds.
pub struct GrownBuffer {
    label: &'static str,
    usage: wgpu::BufferUsages,
    buffer: Option<wgpu::Buffer>,
    used_bytes: u64,
}

impl GrownBuffer {
    pub fn new(label: &'static str, usage: wgpu::BufferUsages) -> Self {
        Self { label, usage, buffer: None, used_bytes: 0 }
    }

    /// Makes room for so many bytes; what was there may be lost.
    pub fn grow(&mut self, device: &GpuDevice, bytes: u64) -> Result<(), GpuError> {
        self.used_bytes = bytes.max(16).next_multiple_of(16);
        if self.buffer.as_ref().is_some_and(|buffer| buffer.size() >= self.used_bytes) {
            return Ok(());
        }
        self.buffer = None;
        let out_of_memory = device.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let invalid = device.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(self.label),
            size: self.used_bytes,
            usage: self.usage,
            mapped_at_creation: false,
        });
        let (invalid, out_of_memory) =
            (pollster::block_on(invalid.pop()), pollster::block_on(out_of_memory.pop()));
        if invalid.is_some() || out_of_memory.is_some() {
            return Err(GpuError::OutOfMemory { what: self.label, needed_bytes: self.used_bytes });
        }
        self.buffer = Some(buffer);
        Ok(())
    }

    /// Makes room for these bytes and writes them.
    pub fn write(&mut self, device: &GpuDevice, bytes: &[u8]) -> Result<(), GpuError> {
        self.grow(device, bytes.len() as u64)?;
        device.queue.write_buffer(self.get(), 0, bytes);
        Ok(())
    }

    /// Bytes in use, from the first on.
    pub fn used_bytes(&self) -> u64 {
        self.used_bytes
    }

    pub fn get(&self) -> &wgpu::Buffer {
        self.buffer.as_ref().expect("a buffer is grown before it is used")
    }

    /// The first part, of which draws take others by offsets.
    pub fn part(&self, bytes: u64) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: self.get(),
            offset: 0,
            size: wgpu::BufferSize::new(bytes),
        })
    }

    /// What is in use, to be bound.
    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: self.get(),
            offset: 0,
            size: wgpu::BufferSize::new(self.used_bytes),
        })
    }
}
