use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use glassbrick_volume::Brick;

use super::{SlotPlace, VoxelEncoding};

/// Bricks that may be on their way to the device at once.
const MOST_BUFFERS: usize = 16;

/// A ring of buffers, each of one brick, by which bricks go to the device without an allocation each.
///
/// A buffer is *free* (mapped, to be written), *used* (its copy is recorded, not submitted) or *under way* (submitted;
/// the device maps it again when the copy is done, which frees it).
pub struct StagingRing {
    row_bytes: u32,
    brick_edge: u32,
    /// One slice of texels, before it goes to the mapped memory whole.
    slice: Vec<u8>,
    made: usize,
    free: Vec<wgpu::Buffer>,
    used: Vec<wgpu::Buffer>,
    returned: (Sender<Option<wgpu::Buffer>>, Receiver<Option<wgpu::Buffer>>),
}

impl StagingRing {
    pub fn new(brick_edge: u32, texel_bytes: u32) -> Self {
        let row_bytes = (brick_edge * texel_bytes).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        Self {
            row_bytes,
            brick_edge,
            slice: vec![0; (row_bytes * brick_edge) as usize],
            made: 0,
            free: Vec::new(),
            used: Vec::new(),
            returned: channel(),
        }
    }

    /// Whether a brick can be written without waiting for the device.
    pub fn has_room(&mut self) -> bool {
        self.take_returned();
        !self.free.is_empty() || self.made < MOST_BUFFERS
    }

    /// Writes a brick and records its copy to a slot. There must be room.
    pub fn write(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        brick: &Brick,
        encoding: &VoxelEncoding,
        texture: &wgpu::Texture,
        place: SlotPlace,
    ) -> Result<(), wgpu::MapRangeError> {
        let buffer = self.free.pop().unwrap_or_else(|| {
            self.made += 1;
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("brick on its way"),
                size: u64::from(self.row_bytes) * u64::from(self.brick_edge).pow(2),
                usage: wgpu::BufferUsages::MAP_WRITE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: true,
            })
        });
        let mut mapped = buffer.get_mapped_range_mut(..)?;
        for z in 0..self.brick_edge {
            encoding.encode_slice(brick, z, self.row_bytes as usize, &mut self.slice);
            let start = z as usize * self.slice.len();
            mapped.slice(start..start + self.slice.len()).copy_from_slice(&self.slice);
        }
        drop(mapped);
        buffer.unmap();
        let origin = place.texel;
        encoder.copy_buffer_to_texture(
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(self.row_bytes),
                    rows_per_image: Some(self.brick_edge),
                },
            },
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level: 0,
                origin: wgpu::Origin3d { x: origin.x, y: origin.y, z: origin.z },
                aspect: wgpu::TextureAspect::All,
            },
            wgpu::Extent3d {
                width: self.brick_edge,
                height: self.brick_edge,
                depth_or_array_layers: self.brick_edge,
            },
        );
        self.used.push(buffer);
        Ok(())
    }

    /// To be called when the recorded copies are submitted: their buffers come back when the device is done.
    pub fn submitted(&mut self) {
        for buffer in self.used.drain(..) {
            let (sender, copy) = (self.returned.0.clone(), buffer.clone());
            buffer.map_async(wgpu::MapMode::Write, .., move |mapped| {
                // A ring that is gone needs no buffers.
                let _ = sender.send(mapped.ok().map(|()| copy));
            });
        }
    }

    fn take_returned(&mut self) {
        loop {
            match self.returned.1.try_recv() {
                Ok(Some(buffer)) => self.free.push(buffer),
                // A buffer that could not be mapped again is replaced when it is needed.
                Ok(None) => self.made -= 1,
                Err(TryRecvError::Empty | TryRecvError::Disconnected) => return,
            }
        }
    }
}
