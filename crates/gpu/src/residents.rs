use std::collections::HashMap;
use std::sync::Arc;

use glassbrick_residency::{
    AtlasShape, AtlasTextures, Load, Loaded, Loader, Priority, SlotId, StagingRing, VoxelEncoding,
    WorkingSet, WorkingSetCounts, next_round,
};
use glassbrick_volume::{Brick, BrickId, BrickSource, ReadError};

use crate::slot_cells::SlotCells;
use crate::tier::TexelChoice;
use crate::{GpuDevice, GpuError};

/// The bricks that are on the device, and the way there.
pub struct Residents {
    pub set: WorkingSet,
    pub textures: AtlasTextures,
    pub encoding: VoxelEncoding,
    pub cells: SlotCells,
    loader: Loader,
    staging: StagingRing,
    /// Slots that the budget, or the device's memory, leaves room for.
    most_slots: u32,
    /// Whether there is one texture, which is made anew when more is needed.
    grows: bool,
    counts: UploadCounts,
    slot_counts: WorkingSetCounts,
    peak_bytes: u64,
}

/// What went to the device.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UploadCounts {
    pub uploads: u64,
    pub bytes: u64,
}

/// A part of what was wanted, ready to be drawn.
pub struct LoadedRound {
    /// How many of the wanted bricks are resident or damaged, from the first on.
    pub taken: usize,
    pub loads: Vec<Load>,
    /// Bricks that could not be read, and why.
    pub damaged: Vec<(BrickId, String)>,
}

impl Residents {
    /// Room for bricks of a source in at most `budget_bytes` of the device's memory.
    ///
    /// # Errors
    /// When not even one atlas texture has room, or bricks are too large for the device's textures.
    pub fn new(
        device: &GpuDevice,
        source: Arc<dyn BrickSource>,
        texels: TexelChoice,
        min_stored: f32,
        budget_bytes: u64,
        threads: usize,
    ) -> Result<Self, GpuError> {
        let brick_edge = source.grid(0).layout.edge;
        let tier = &device.tier;
        let one_cube = AtlasShape::new(brick_edge, 1);
        if one_cube.cube_edge > tier.largest_volume_texture {
            return Err(GpuError::BrickTooLarge { brick_edge, largest: tier.largest_volume_texture });
        }
        let cube_bytes = one_cube.cube_voxels() * u64::from(texels.format.bytes());
        let most_cubes = one_cube.most_cubes(tier.textures, tier.largest_volume_texture);
        let cubes = (budget_bytes / cube_bytes).min(most_cubes.into()) as u32;
        if cubes == 0 {
            return Err(GpuError::BudgetTooSmall { budget_bytes, needed_bytes: cube_bytes });
        }
        let grows = tier.textures == 1;
        let per_texture = if grows { 1 } else { cubes.div_ceil(tier.textures as u32).next_power_of_two() };
        // A texture that grows doubles: what is not a power of two of cubes would go beyond the budget.
        let cubes = if grows { 1 << cubes.ilog2() } else { cubes / per_texture * per_texture };
        let shape = AtlasShape::new(brick_edge, per_texture);
        let most_slots = cubes * shape.slots_per_cube();
        let stored_type = source.desc().stored_type;
        let mut residents = Self {
            set: WorkingSet::new(if grows { shape.slots_per_texture() } else { most_slots }),
            textures: AtlasTextures::new(shape, texels.format),
            encoding: VoxelEncoding::new(texels.format, stored_type, min_stored),
            cells: SlotCells::new(brick_edge),
            loader: Loader::new(source, threads, 2 * threads)?,
            staging: StagingRing::new(brick_edge, texels.format.bytes()),
            most_slots,
            grows,
            counts: UploadCounts::default(),
            slot_counts: WorkingSetCounts::default(),
            peak_bytes: 0,
        };
        residents.make(device, 1)?;
        Ok(residents)
    }

    /// Slots that the budget, or the device's memory, leaves room for.
    pub fn slots(&self) -> usize {
        self.most_slots as usize
    }

    /// Makes room for a frame of so many bricks, as far as the budget goes. A texture that grows loses its bricks.
    ///
    /// # Errors
    /// When the device has no memory at all.
    pub fn reserve(&mut self, device: &GpuDevice, bricks: usize) -> Result<(), GpuError> {
        if !self.grows || bricks <= self.set.slots() as usize || self.set.slots() == self.most_slots {
            return Ok(());
        }
        let per_cube = self.textures.shape.slots_per_cube();
        let cubes = (bricks as u64).div_ceil(per_cube.into()).next_power_of_two();
        let mut cubes = cubes.min(u64::from(self.most_slots / per_cube)) as u32;
        self.keep_counts();
        self.set.clear();
        let pinned: Vec<BrickId> = self.set.missing_pinned().collect();
        let format = self.textures.format;
        loop {
            let shape = AtlasShape::new(self.textures.shape.brick_edge, cubes);
            // The smaller texture goes first, so that the two together never go beyond the budget.
            self.textures = AtlasTextures::new(shape, format);
            self.set = WorkingSet::new(shape.slots_per_texture());
            self.set.set_pinned(&pinned);
            if pollster::block_on(self.textures.make(&device.device, 1)) == 1 {
                self.peak_bytes = self.peak_bytes.max(self.textures.bytes());
                return Ok(());
            }
            self.most_slots = (cubes / 2).max(1) * per_cube;
            if cubes == 1 {
                return Err(self.out_of_memory());
            }
            cubes /= 2;
        }
    }

    /// Brings as many of the wanted bricks as there is room for, from the first on.
    ///
    /// # Errors
    /// When a brick cannot be read and may not be left out, or the device fails.
    pub fn load_round(
        &mut self,
        device: &GpuDevice,
        wanted: &[BrickId],
        most_loads: usize,
        allow_damaged: bool,
    ) -> Result<LoadedRound, GpuError> {
        let missing = wanted.iter().filter(|&&brick| self.set.slot_of(brick).is_none()).count();
        self.make_room(device, missing.min(most_loads))?;
        let round = next_round(&mut self.set, wanted, most_loads);
        let mut slots: HashMap<BrickId, SlotId> =
            round.loads.iter().map(|load| (load.brick, load.slot)).collect();
        let bricks: Vec<BrickId> = round.loads.iter().map(|load| load.brick).collect();
        if !bricks.is_empty() {
            self.loader.request(Priority::NeededNow, &bricks);
        }
        let mut damaged = Vec::new();
        let mut encoder = device.device.create_command_encoder(&Default::default());
        while !slots.is_empty() {
            let Some(Loaded { brick, voxels }) = self.loader.wait() else { break };
            let done = match (slots.remove(&brick), voxels) {
                (Some(slot), Ok(voxels)) => self.upload(device, &mut encoder, slot, &voxels),
                (Some(_), Err(error)) if allow_damaged => {
                    damaged.push((brick, error.to_string()));
                    self.set.remove(brick);
                    Ok(())
                }
                (Some(_), Err(error)) => Err(error.into()),
                (None, Ok(voxels)) => self.upload_if_free(device, &mut encoder, brick, &voxels),
                // Whoever needs it hears of it then.
                (None, Err(_)) => Ok(()),
            };
            if let Err(error) = done {
                self.forget(slots.into_keys().chain([brick]));
                return Err(error);
            }
        }
        self.submit(device, encoder);
        Ok(LoadedRound { taken: round.taken, loads: round.loads, damaged })
    }

    /// Uploads a brick that was asked for before this round, where no other one has to go for it.
    fn upload_if_free(
        &mut self,
        device: &GpuDevice,
        encoder: &mut wgpu::CommandEncoder,
        brick: BrickId,
        voxels: &Arc<Brick>,
    ) -> Result<(), GpuError> {
        if self.set.resident() < self.set.slots() as usize
            && let Some(slot) = self.room_for(device, brick)?
        {
            self.upload(device, encoder, slot, voxels)?;
        }
        Ok(())
    }

    /// Makes room for so many bricks more, as far as the device's memory goes, before any of them is given a slot: free
    /// slots are given lowest first.
    fn make_room(&mut self, device: &GpuDevice, bricks: usize) -> Result<(), GpuError> {
        let slots = (self.set.resident() + bricks).min(self.set.slots() as usize);
        self.make(device, slots.div_ceil(self.textures.shape.slots_per_texture() as usize))
    }

    /// Lets bricks go that were given slots and did not come.
    fn forget(&mut self, bricks: impl Iterator<Item = BrickId>) {
        for brick in bricks {
            self.set.remove(brick);
        }
        self.loader.request(Priority::NeededNow, &[]);
    }

    /// Asks for bricks without waiting: those needed now, and then those pinned.
    pub fn ask(&mut self, needed: &[BrickId]) {
        let is_missing = |brick: &&BrickId| self.set.slot_of(**brick).is_none();
        let needed: Vec<BrickId> = needed.iter().filter(is_missing).copied().collect();
        self.loader.request(Priority::NeededNow, &needed);
        let pinned: Vec<BrickId> = self.set.missing_pinned().collect();
        self.loader.request(Priority::Boundary, &pinned);
    }

    /// Uploads what has come since, at most `most_uploads` bricks; returns bricks that could not be read, and why.
    ///
    /// # Errors
    /// When the device fails.
    pub fn take_loaded(
        &mut self,
        device: &GpuDevice,
        most_uploads: usize,
    ) -> Result<Vec<(BrickId, ReadError)>, GpuError> {
        // Gives back the buffers whose copies are done.
        let _ = device.device.poll(wgpu::PollType::Poll);
        let mut damaged = Vec::new();
        let mut encoder = device.device.create_command_encoder(&Default::default());
        for _ in 0..most_uploads {
            if !self.staging.has_room() {
                break;
            }
            let Some(Loaded { brick, voxels }) = self.loader.take() else { break };
            match voxels {
                Err(error) => damaged.push((brick, error)),
                Ok(voxels) => {
                    if let Some(slot) = self.room_for(device, brick)? {
                        self.upload(device, &mut encoder, slot, &voxels)?;
                    }
                }
            }
        }
        self.submit(device, encoder);
        self.set.end_round();
        Ok(damaged)
    }

    /// A slot for a brick that is not resident, in a texture that is made.
    fn room_for(&mut self, device: &GpuDevice, brick: BrickId) -> Result<Option<SlotId>, GpuError> {
        if self.set.slot_of(brick).is_some() {
            return Ok(None);
        }
        self.make_room(device, 1)?;
        Ok(self.set.admit(brick).map(|admitted| admitted.slot))
    }

    /// What happened in the slots, and what was uploaded, since this was asked last.
    pub fn take_counts(&mut self) -> (WorkingSetCounts, UploadCounts) {
        self.keep_counts();
        (std::mem::take(&mut self.slot_counts), std::mem::take(&mut self.counts))
    }

    fn keep_counts(&mut self) {
        let WorkingSetCounts { hits, misses, evictions } = self.set.take_counts();
        self.slot_counts.hits += hits;
        self.slot_counts.misses += misses;
        self.slot_counts.evictions += evictions;
    }

    /// Bytes of the textures that there were at once, at most.
    pub fn peak_bytes(&self) -> u64 {
        self.peak_bytes
    }

    fn upload(
        &mut self,
        device: &GpuDevice,
        encoder: &mut wgpu::CommandEncoder,
        slot: SlotId,
        voxels: &Arc<Brick>,
    ) -> Result<(), GpuError> {
        let place = self.textures.shape.place(slot);
        while !self.staging.has_room() {
            let fresh = device.device.create_command_encoder(&Default::default());
            self.submit(device, std::mem::replace(encoder, fresh));
            device.wait()?;
        }
        let texture = &self.textures.textures()[place.texture as usize];
        self.staging
            .write(&device.device, encoder, voxels, &self.encoding, texture, place)
            .map_err(|error| GpuError::driver(&error))?;
        self.cells.put(slot, voxels.cells());
        self.counts.uploads += 1;
        self.counts.bytes +=
            u64::from(self.textures.shape.brick_edge).pow(3) * u64::from(self.textures.format.bytes());
        Ok(())
    }

    fn submit(&mut self, device: &GpuDevice, encoder: wgpu::CommandEncoder) {
        device.queue.submit([encoder.finish()]);
        self.staging.submitted();
    }

    /// Makes textures up to a number. Where the device's memory ends before, slots end there.
    fn make(&mut self, device: &GpuDevice, count: usize) -> Result<(), GpuError> {
        if self.textures.textures().len() >= count {
            return Ok(());
        }
        let made = pollster::block_on(self.textures.make(&device.device, count));
        self.peak_bytes = self.peak_bytes.max(self.textures.bytes());
        if made == 0 {
            return Err(self.out_of_memory());
        }
        if made < count {
            self.most_slots = made as u32 * self.textures.shape.slots_per_texture();
            self.set.limit(self.most_slots);
        }
        Ok(())
    }

    fn out_of_memory(&self) -> GpuError {
        GpuError::OutOfMemory { what: "an atlas texture", needed_bytes: self.textures.texture_bytes() }
    }
}
