//! Making a brick store of a volume: slice by slice, then level by level, beside its place, which it takes at the end.

mod halved_slices;
mod level_writer;
mod read_ahead;
mod slice_window;
mod staging;
#[cfg(test)]
mod tests;

use std::fs;
use std::path::Path;

use glam::UVec3;
use glassbrick_volume::{BrickLayout, VolumeReader};

use crate::store::{Codec, SHARD_EDGE, StoreDesc, StoreError, documents};
use halved_slices::HalvedSlices;
use level_writer::LevelWriter;
use read_ahead::with_read_ahead;
use slice_window::{SliceFeed, SliceWindow};
use staging::{RunState, Staging};

/// Bricks that are made ready before they are written take this much, at most.
const READY_BYTES: usize = 64 << 20;

/// How a store is made.
#[derive(Clone, Debug)]
pub struct IngestSettings {
    pub layout: BrickLayout,
    pub codec: Codec,
    /// Whether a store that is there already is replaced.
    pub replace: bool,
    /// Whether to go on where a run was stopped, and to keep what is done for such a run when this one fails.
    pub resume: bool,
    /// What tells the input from any other, so that a run is not resumed with another one.
    pub input: String,
}

/// What was made.
#[derive(Clone, Debug, PartialEq)]
pub struct Ingested {
    pub store: StoreDesc,
    /// Bytes of voxels, all levels together, that an earlier run had stored.
    pub resumed_bytes: u64,
    /// Bytes of voxels, all levels together.
    pub voxel_bytes: u64,
}

/// Makes a brick store of the volume that a reader reads, at `target`. What stands there is untouched until the store
/// is whole. Works on the threads of the current rayon pool, with as many slices in memory as a brick has along z.
///
/// `progress` hears how many bytes of voxels of how many are stored, of all levels together.
///
/// # Errors
/// When the volume cannot be read or the store not be written.
pub fn ingest(
    reader: &mut dyn VolumeReader,
    target: &Path,
    settings: &IngestSettings,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Ingested, StoreError> {
    let mut store = StoreDesc {
        volume: reader.desc().clone(),
        layout: settings.layout,
        codec: settings.codec,
        not_finite: 0,
        source_format: reader.format().to_owned(),
        notes: reader.notes().to_vec(),
    };
    store.check().map_err(|what| StoreError::Unstorable { what })?;
    let mut staging = Staging::begin(target, settings.replace, settings.resume)?;
    let begun = begin(&staging, &store, settings)?;
    let resumed_bytes = done_bytes(&store, &begun);
    let mut made = Run { staging: &staging, store: &store, state: begun, progress }.levels(reader);
    if let Ok(not_finite) = made {
        store.not_finite = not_finite;
        made = write_documents(staging.folder(), &store).and_then(|()| staging.commit()).map(|()| not_finite);
    }
    match made {
        Ok(_) => Ok(Ingested { voxel_bytes: voxel_bytes(&store), store, resumed_bytes }),
        Err(error) => {
            if !settings.resume {
                staging.discard();
            }
            Err(error)
        }
    }
}

/// Where to begin: where an earlier run of the same was stopped, or at the start.
fn begin(staging: &Staging, store: &StoreDesc, settings: &IngestSettings) -> Result<RunState, StoreError> {
    let run = format!("{} of {}", store.to_attributes(), settings.input);
    match staging.state() {
        Some(state) if state.run == run && state.level <= store.levels() => Ok(state),
        Some(_) => Err(staging.other_run()),
        None => Ok(RunState { run, level: 0, shard_rows: 0, not_finite: 0 }),
    }
}

/// A run that makes the levels of a store.
struct Run<'a> {
    staging: &'a Staging,
    store: &'a StoreDesc,
    state: RunState,
    progress: &'a mut dyn FnMut(u64, u64),
}

impl Run<'_> {
    /// Makes what is missing of all levels; returns how many voxels of level 0 are not finite.
    fn levels(mut self, reader: &mut dyn VolumeReader) -> Result<u64, StoreError> {
        while self.state.level < self.store.levels() {
            if self.state.level == 0 {
                with_read_ahead(reader, |slices| self.level(slices))?;
            } else {
                self.level(&mut HalvedSlices::new(self.staging.folder(), self.store, self.state.level))?;
            }
            self.state.level += 1;
            self.state.shard_rows = 0;
        }
        Ok(self.state.not_finite)
    }

    /// Makes what is missing of the level, whose slices `feed` gives.
    fn level(&mut self, feed: &mut dyn SliceFeed) -> Result<(), StoreError> {
        let level = self.state.level;
        let mut writer = LevelWriter::new(self.staging.folder(), self.store, level);
        let desc = self.store.volume.level(level).desc;
        let mut slices = SliceWindow::new(&desc, writer.grid());
        let total_bytes = voxel_bytes(self.store);
        let mut done_bytes = done_bytes(self.store, &self.state);
        for shard_row in self.state.shard_rows..writer.shard_rows() {
            writer.begin(shard_row)?;
            for layer in writer.layers(shard_row) {
                slices.advance_to(layer, feed)?;
                let not_finite = writer.add_layer(&slices, layer)?;
                if level == 0 {
                    self.state.not_finite += not_finite;
                }
                done_bytes += layer_bytes(self.store, level, layer);
                (self.progress)(done_bytes, total_bytes);
            }
            writer.end(shard_row)?;
            self.state.shard_rows = shard_row + 1;
            self.staging.note(&self.state)?;
        }
        Ok(())
    }
}

/// Bytes of the voxels that a layer of bricks holds in its cores.
fn layer_bytes(store: &StoreDesc, level: u32, layer: u32) -> u64 {
    let grid = store.layout.level_grid(store.volume.extent, level);
    let [start, end] = [grid.core_start(UVec3::Z * layer).z, grid.core_end(UVec3::Z * layer).z];
    u64::from(end - start) * store.volume.level(level).desc.slice_bytes()
}

/// Bytes of the voxels that a run has stored.
fn done_bytes(store: &StoreDesc, state: &RunState) -> u64 {
    let finished: u64 = (0..state.level).map(|level| store.volume.level(level).desc.bytes()).sum();
    let layers = 0..state.shard_rows * SHARD_EDGE;
    let layer_count = store.layout.level_grid(store.volume.extent, state.level).counts.z;
    finished
        + layers.take(layer_count as usize).map(|layer| layer_bytes(store, state.level, layer)).sum::<u64>()
}

/// Bytes of the voxels of all levels.
fn voxel_bytes(store: &StoreDesc) -> u64 {
    (0..store.levels()).map(|level| store.volume.level(level).desc.bytes()).sum()
}

fn write_documents(folder: &Path, store: &StoreDesc) -> Result<(), StoreError> {
    documents(store).into_iter().try_for_each(|(name, document)| {
        let path = folder.join(name);
        let text = serde_json::to_string_pretty(&document).expect("a JSON value becomes text");
        fs::write(&path, text + "\n").map_err(|source| StoreError::Write { path, source })
    })
}

/// How many bricks are worked on before the memory for them is used again.
fn bricks_at_once(store: &StoreDesc) -> usize {
    (READY_BYTES / store.brick_bytes()).max(1)
}
