//! The raycast pass: one march per pixel through the page table. A ray that needs a brick which is not resident asks for
//! it and waits; rounds of loading and marching follow one another until no ray asks.

use glassbrick_residency::{NOT_PLANNED, PageTable, SlotId};
use glassbrick_shaders::{Pass, RayState};
use glassbrick_volume::{BrickId, PixelRect, PlannedBrick};
use wgpu::{BufferUsages, ShaderStages};

use crate::bindings::{bind, layout_of, picture, read_only, storage, uniform};
use crate::frame_uniform::{FrameParts, cell_question, frame_uniform};
use crate::grown_buffer::GrownBuffer;
use crate::read_back::ReadBack;
use crate::residents::Residents;
use crate::tiles::Taken;
use crate::waiting::Waiting;
use crate::{GpuDevice, GpuError};

/// What became of a brick, as the shader writes it.
const ASKED_FOR: u32 = 1;
const RENDERED: u32 = 2;

/// Pixels along a side of a work group.
const GROUP_EDGE: u32 = 8;

/// What the raycast pass keeps between frames.
pub struct Raycast {
    layout: wgpu::BindGroupLayout,
    page_table: GrownBuffer,
    reaches: GrownBuffer,
    states: GrownBuffer,
    fates: GrownBuffer,
}

impl Raycast {
    pub fn new(device: &wgpu::Device) -> Self {
        let layout = layout_of(
            device,
            "raycast",
            ShaderStages::COMPUTE,
            &[
                (0, uniform()),
                (2, picture()),
                (3, read_only()),
                (5, read_only()),
                (6, storage()),
                (7, storage()),
                (8, read_only()),
            ],
        );
        Self {
            layout,
            page_table: GrownBuffer::new("page table", BufferUsages::STORAGE | BufferUsages::COPY_DST),
            reaches: GrownBuffer::new("reaches", BufferUsages::STORAGE | BufferUsages::COPY_DST),
            states: GrownBuffer::new(
                "ray states",
                BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC,
            ),
            fates: GrownBuffer::new(
                "fates of bricks",
                BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC,
            ),
        }
    }

    /// Marches the rays of a tile, and hands on what they gathered, row by row. `planned` are the bricks that it can meet,
    /// front to back.
    pub fn draw_tile(
        &mut self,
        parts: &FrameParts,
        residents: &mut Residents,
        tile: &PixelRect,
        planned: &[PlannedBrick],
        use_them: impl FnOnce(&[RayState]),
    ) -> Result<Taken, GpuError> {
        let FrameParts { device, scene, level, waiting, .. } = *parts;
        let number = scene.plan.level;
        let id = |index: u32| BrickId::new(number, level.grid.brick(index as usize));
        let mut table =
            PageTable::new(number, level.grid, planned.iter().map(|brick| brick.index), &residents.set);
        let size = [tile.max[0] - tile.min[0], tile.max[1] - tile.min[1]];
        let (bricks, rays) = (level.grid.len(), (size[0] * size[1]) as usize);
        self.make_buffers(parts, bricks, rays)?;
        let fates_read = ReadBack::new(&device.device, bricks as u64 * 4);
        let mut taken = Taken::default();
        let question = cell_question(parts);
        residents.cells.answer(device, &question, residents.set.slots())?;
        let uniform = frame_uniform(parts, residents.cells.layout(), tile);
        device.queue.write_buffer(&parts.shared.frame, 0, bytemuck::bytes_of(&uniform));
        let mut is_first = true;
        loop {
            if let Some(dirty) = table.take_dirty() {
                let shape = &residents.textures.shape;
                let page = |&entry: &u32| {
                    let is_slot = entry < NOT_PLANNED;
                    [entry, if is_slot { shape.place(SlotId(entry)).packed(shape.brick_edge) } else { 0 }]
                };
                let pages: Vec<[u32; 2]> = table.entries()[dirty.clone()].iter().map(page).collect();
                let offset = (dirty.start * size_of::<[u32; 2]>()) as u64;
                device.queue.write_buffer(self.page_table.get(), offset, bytemuck::cast_slice(&pages));
            }
            self.march(parts, residents, size, &fates_read, is_first);
            let fates: Vec<u32> = fates_read.read(device, bricks, <[u32]>::to_vec)?;
            let with = |fate: u32| {
                let fates = &fates;
                planned
                    .iter()
                    .map(|brick| brick.index)
                    .filter(move |&index| fates[index as usize] & fate != 0)
            };
            // What was just used goes last. What was there before the first round is a hit, the rest was a miss.
            for index in with(RENDERED) {
                taken.rendered.insert(index);
                if is_first {
                    residents.set.hold(id(index));
                } else {
                    residents.set.hold_again(id(index));
                }
            }
            is_first = false;
            let asked: Vec<BrickId> = with(ASKED_FOR).map(id).collect();
            if asked.is_empty() {
                residents.set.end_round();
                break;
            }
            if waiting == Waiting::Never {
                residents.set.end_round();
                taken.missing.extend(asked);
                break;
            }
            let round = residents.load_round(device, &asked, usize::MAX, scene.allow_damaged)?;
            residents.cells.answer(device, &question, residents.set.slots())?;
            table.follow(&round.loads);
            // Prefetched bricks may have come besides.
            for &brick in &asked {
                if let Some(slot) = residents.set.slot_of(brick) {
                    table.set_resident(brick, slot);
                }
            }
            for (brick, why) in round.damaged {
                table.leave_out(brick);
                taken.damaged.insert(level.grid.index(brick.place()) as u32, why);
            }
        }
        self.read_states(device, rays, use_them)?;
        Ok(taken)
    }

    fn make_buffers(&mut self, parts: &FrameParts, bricks: usize, rays: usize) -> Result<(), GpuError> {
        let device = parts.device;
        self.page_table.grow(device, bricks as u64 * 8)?;
        self.fates.grow(device, bricks as u64 * 4)?;
        self.states.grow(device, (rays * size_of::<RayState>()) as u64)?;
        let reaches: Vec<[f32; 2]> = parts.ranges.iter().map(|range| range.reach).collect();
        self.reaches.write(device, bytemuck::cast_slice(&reaches))
    }

    /// Runs the pass once and copies the bricks' fates to where they are read.
    fn march(
        &self,
        parts: &FrameParts,
        residents: &Residents,
        size: [u32; 2],
        fates_read: &ReadBack,
        is_first: bool,
    ) {
        let FrameParts { device, shared, atlas, pixels, .. } = *parts;
        let bindings = bind(
            &device.device,
            &self.layout,
            &[
                (0, shared.frame.as_entire_binding()),
                (2, shared.entries()),
                (3, self.page_table.binding()),
                (5, self.reaches.binding()),
                (6, self.states.binding()),
                (7, self.fates.binding()),
                (8, residents.cells.binding()),
            ],
        );
        let textures = atlas.all(device, &residents.textures);
        let pass = Pass::Raycast { pixels, filters: atlas.filters(), many_textures: atlas.textures() > 1 };
        let pipeline = device.compute_pipeline(pass, &[Some(&self.layout), Some(atlas.layout())]);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        encoder.clear_buffer(self.fates.get(), 0, Some(self.fates.used_bytes()));
        if is_first {
            encoder.clear_buffer(self.states.get(), 0, Some(self.states.used_bytes()));
        }
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &bindings, &[]);
        pass.set_bind_group(1, &textures, &[]);
        let groups = size.map(|pixels| pixels.div_ceil(GROUP_EDGE));
        pass.dispatch_workgroups(groups[0], groups[1], 1);
        drop(pass);
        encoder.copy_buffer_to_buffer(self.fates.get(), 0, fates_read.buffer(), 0, self.fates.used_bytes());
        device.queue.submit([encoder.finish()]);
    }

    fn read_states(
        &self,
        device: &GpuDevice,
        rays: usize,
        use_them: impl FnOnce(&[RayState]),
    ) -> Result<(), GpuError> {
        let bytes = self.states.used_bytes();
        let read = ReadBack::new(&device.device, bytes);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(self.states.get(), 0, read.buffer(), 0, bytes);
        device.queue.submit([encoder.finish()]);
        read.read(device, rays, use_them)
    }
}
