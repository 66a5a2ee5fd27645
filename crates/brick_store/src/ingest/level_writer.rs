use std::cell::RefCell;
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;

use glam::UVec3;
use glassbrick_volume::{BrickGrid, BrickId};
use rayon::prelude::*;

use super::bricks_at_once;
use super::slice_window::SliceWindow;
use crate::brick_cut::cut_stored;
use crate::brick_stats::{BrickStats, StoredBrick};
use crate::store::{
    SHARD_EDGE, ShardIndex, StoreDesc, StoreError, Table, TableChunks, chunk_path, shard_path,
};

/// Writes a level, a row of shards after the other: their bricks layer by layer, then their indices and tables.
pub struct LevelWriter<'a> {
    root: &'a Path,
    store: &'a StoreDesc,
    level: u32,
    grid: BrickGrid,
    shards: Vec<OpenShard>,
    /// The rows of each table for the bricks of the row of shards, by place in the grid.
    rows: [Vec<u8>; Table::ALL.len()],
    /// Memory of written bricks, to be filled again.
    used: Mutex<Vec<Vec<u8>>>,
}

/// A shard whose index is not written yet.
#[derive(Clone, Default)]
struct OpenShard {
    path: PathBuf,
    bytes: u64,
    index: ShardIndex,
}

/// A brick that is ready to be written.
struct ReadyBrick {
    brick: UVec3,
    /// Nothing for a brick of zeros.
    encoded: Option<Vec<u8>>,
    stats: BrickStats,
}

impl<'a> LevelWriter<'a> {
    /// Writes a level of the store in a folder.
    pub fn new(root: &'a Path, store: &'a StoreDesc, level: u32) -> Self {
        let grid = store.layout.level_grid(store.volume.extent, level);
        Self {
            root,
            store,
            level,
            grid,
            shards: Vec::new(),
            rows: Default::default(),
            used: Mutex::default(),
        }
    }

    /// The grid of the level.
    pub fn grid(&self) -> &BrickGrid {
        &self.grid
    }

    /// How many rows of shards the level has.
    pub fn shard_rows(&self) -> u32 {
        self.grid.counts.z.div_ceil(SHARD_EDGE)
    }

    /// The layers of bricks of a row of shards.
    pub fn layers(&self, shard_row: u32) -> std::ops::Range<u32> {
        shard_row * SHARD_EDGE..((shard_row + 1) * SHARD_EDGE).min(self.grid.counts.z)
    }

    /// Begins a row of shards; what a stopped run left of it is written over.
    ///
    /// # Errors
    /// When the files cannot be made.
    pub fn begin(&mut self, shard_row: u32) -> Result<(), StoreError> {
        let bricks = self.layers(shard_row).len() * (self.grid.counts.x * self.grid.counts.y) as usize;
        for (table, rows) in Table::ALL.into_iter().zip(&mut self.rows) {
            rows.clear();
            rows.resize(bricks * table.row_bytes(self.store.volume.stored_type), 0);
        }
        self.shards.clear();
        for y in 0..self.grid.counts.y.div_ceil(SHARD_EDGE) {
            for x in 0..self.grid.counts.x.div_ceil(SHARD_EDGE) {
                let first = UVec3::new(x, y, shard_row) * SHARD_EDGE;
                let path = self.root.join(shard_path(self.id(first)));
                create(&path).map_err(|source| StoreError::Write { path: path.clone(), source })?;
                self.shards.push(OpenShard { path, ..OpenShard::default() });
            }
        }
        Ok(())
    }

    /// Writes a layer of bricks, cut from slices; returns how many of its voxels are not finite.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn add_layer(&mut self, slices: &SliceWindow, layer: u32) -> Result<u64, StoreError> {
        let mut bricks: Vec<UVec3> = (0..self.grid.counts.y)
            .flat_map(|y| (0..self.grid.counts.x).map(move |x| UVec3::new(x, y, layer)))
            .collect();
        bricks.sort_by_key(|&brick| self.shard_of(brick));
        let mut not_finite = 0;
        for bricks in bricks.chunks(bricks_at_once(self.store)) {
            let ready: Vec<ReadyBrick> =
                bricks.par_iter().map(|&brick| self.make_ready(slices, brick)).collect();
            not_finite += ready.iter().map(|ready| ready.stats.not_finite).sum::<u64>();
            self.fill_rows(&ready);
            self.append(&ready)?;
            let written = ready.into_iter().filter_map(|ready| ready.encoded);
            self.used.get_mut().expect("nothing panics while it is held").extend(written);
        }
        Ok(not_finite)
    }

    /// Ends a row of shards: writes the shards' indices and the tables.
    ///
    /// # Errors
    /// When they cannot be written.
    pub fn end(&self, shard_row: u32) -> Result<(), StoreError> {
        for shard in &self.shards {
            append(&shard.path, &[shard.index.encode()])?;
        }
        let chunks = TableChunks::new(&self.grid);
        let first_brick = self.first_brick(shard_row);
        for (table, rows) in Table::ALL.into_iter().zip(&self.rows) {
            let stored_type = self.store.volume.stored_type;
            let row_bytes = table.row_bytes(stored_type);
            for chunk in chunks.layer(shard_row) {
                let mut chunk_rows = vec![0; chunks.bricks_per_chunk() * row_bytes];
                for (brick, row) in chunks.rows(chunk) {
                    let place = (self.grid.index(brick) - first_brick) * row_bytes;
                    chunk_rows[row * row_bytes..][..row_bytes].copy_from_slice(&rows[place..][..row_bytes]);
                }
                let mut encoded = Vec::new();
                self.store.codec.encode(table.element(stored_type).bytes(), &chunk_rows, &mut encoded);
                let path = self.root.join(chunk_path(self.level, table, chunk));
                create(&path)
                    .and_then(|mut file| file.write_all(&encoded))
                    .map_err(|source| StoreError::Write { path, source })?;
            }
        }
        Ok(())
    }

    fn make_ready(&self, slices: &SliceWindow, brick: UVec3) -> ReadyBrick {
        thread_local! {
            static VOXELS: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
        }
        let stored_type = self.store.volume.stored_type;
        VOXELS.with_borrow_mut(|voxels| {
            voxels.resize(self.store.brick_bytes(), 0);
            match stored_type.bytes() {
                1 => cut_stored::<1>(slices, &self.grid, brick, voxels),
                2 => cut_stored::<2>(slices, &self.grid, brick, voxels),
                4 => cut_stored::<4>(slices, &self.grid, brick, voxels),
                _ => cut_stored::<8>(slices, &self.grid, brick, voxels),
            }
            let core = self.grid.core_end(brick) - self.grid.core_start(brick);
            let stats = StoredBrick { voxels, stored_type, layout: self.store.layout, core }.stats();
            let is_zero =
                stats.range_row.iter().all(|&byte| byte == 0) && voxels.iter().all(|&byte| byte == 0);
            let encoded = (!is_zero).then(|| {
                let used = self.used.lock().expect("nothing panics while it is held").pop();
                let mut encoded = used.unwrap_or_default();
                encoded.clear();
                self.store.codec.encode(stored_type.bytes(), voxels, &mut encoded);
                encoded
            });
            ReadyBrick { brick, encoded, stats }
        })
    }

    fn fill_rows(&mut self, ready: &[ReadyBrick]) {
        let first_brick = self.first_brick(ready[0].brick.z / SHARD_EDGE);
        let [ranges, counts] = &mut self.rows;
        for ReadyBrick { brick, stats, .. } in ready {
            let index = self.grid.index(*brick) - first_brick;
            let range = &stats.range_row;
            ranges[index * range.len()..][..range.len()].copy_from_slice(range);
            let row = stats.table.cumulative.map(u32::to_le_bytes);
            let row = row.as_flattened();
            counts[index * row.len()..][..row.len()].copy_from_slice(row);
        }
    }

    /// Appends bricks, which are in the order of their shards.
    fn append(&mut self, ready: &[ReadyBrick]) -> Result<(), StoreError> {
        let runs: Vec<&[ReadyBrick]> =
            ready.chunk_by(|a, b| self.shard_of(a.brick) == self.shard_of(b.brick)).collect();
        for run in &runs {
            let number = self.shard_of(run[0].brick);
            let shard = &mut self.shards[number];
            for ReadyBrick { brick, encoded, .. } in *run {
                if let Some(encoded) = encoded {
                    shard.index.set_place(*brick, shard.bytes, encoded.len() as u64);
                    shard.bytes += encoded.len() as u64;
                }
            }
        }
        runs.par_iter().try_for_each(|run| {
            let encoded: Vec<&[u8]> = run.iter().filter_map(|ready| ready.encoded.as_deref()).collect();
            append(&self.shards[self.shard_of(run[0].brick)].path, &encoded)
        })
    }

    /// The place in `shards` of the shard that a brick lies in.
    fn shard_of(&self, brick: UVec3) -> usize {
        let columns = self.grid.counts.x.div_ceil(SHARD_EDGE);
        ((brick.y / SHARD_EDGE) * columns + brick.x / SHARD_EDGE) as usize
    }

    /// The place in the grid of the first brick of a row of shards.
    fn first_brick(&self, shard_row: u32) -> usize {
        self.grid.index(UVec3::Z * (shard_row * SHARD_EDGE))
    }

    fn id(&self, brick: UVec3) -> BrickId {
        BrickId::new(self.level, brick)
    }
}

/// An empty file, with the folders that it lies in.
fn create(path: &Path) -> io::Result<File> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    File::create(path)
}

fn append(path: &Path, parts: &[impl AsRef<[u8]>]) -> Result<(), StoreError> {
    let write = || {
        let mut file = OpenOptions::new().append(true).open(path)?;
        parts.iter().try_for_each(|part| file.write_all(part.as_ref()))
    };
    write().map_err(|source| StoreError::Write { path: path.to_owned(), source })
}
