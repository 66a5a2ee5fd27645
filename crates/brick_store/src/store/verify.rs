use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use glam::UVec3;
use glassbrick_volume::{BrickGrid, BrickId, VCT_BINS};
use rayon::prelude::*;

use super::brick_files::{Found, brick_name};
use super::read_metadata::{check_documents, read_desc};
use super::shard::shard_path;
use super::table_chunks::read_chunk;
use super::{BrickFiles, StoreDesc, StoreError, Table, TableChunks};
use crate::brick_stats::StoredBrick;

/// No more damage than this is told: a store of which so much is broken is not worth more time.
const MOST_DAMAGE: usize = 1000;

/// What checking a store found.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Verified {
    pub levels: u32,
    pub bricks: u64,
    /// What is wrong: one line each that names a brick, table or file. Empty of a sound store.
    pub damage: Vec<String>,
}

/// Checks the metadata, every table and every brick of a store: checksums, and that the tables tell what the bricks
/// hold. `progress` hears how many bricks of how many are done.
///
/// # Errors
/// When the store cannot be checked at all, for it does not say what it is.
pub fn verify(root: &Path, progress: &(dyn Fn(u64, u64) + Sync)) -> Result<Verified, StoreError> {
    let (store, _) = read_desc(root)?;
    let mut damage = Vec::new();
    check_documents(root, &store, |error| {
        damage.push(error.to_string());
        Ok(())
    })?;
    let grids: Vec<BrickGrid> =
        (0..store.levels()).map(|level| store.layout.level_grid(store.volume.extent, level)).collect();
    let bricks = grids.iter().map(|grid| grid.len() as u64).sum();
    let check = Check {
        root,
        store: &store,
        files: BrickFiles::new(root.to_owned(), &store),
        done: AtomicU64::new(0),
        bricks,
        progress,
        damage: Mutex::new(damage),
    };
    let is_checked = (0..).zip(&grids).all(|(level, grid)| check.level(level, grid));
    let mut damage = check.damage.into_inner().expect("no thread panicked");
    if !is_checked {
        damage.push("so much is damaged that the rest was not checked".to_owned());
    }
    Ok(Verified { levels: store.levels(), bricks, damage })
}

struct Check<'a> {
    root: &'a Path,
    store: &'a StoreDesc,
    files: BrickFiles,
    done: AtomicU64,
    bricks: u64,
    progress: &'a (dyn Fn(u64, u64) + Sync),
    damage: Mutex<Vec<String>>,
}

impl Check<'_> {
    /// Checks a level, chunk of tables by chunk of tables; false where so much is damaged that it stopped.
    fn level(&self, level: u32, grid: &BrickGrid) -> bool {
        let chunks = TableChunks::new(grid);
        for chunk in (0..chunks.layers()).flat_map(|layer| chunks.layer(layer)) {
            let [ranges, counts] = Table::ALL.map(|table| self.table_chunk(level, table, chunk));
            let rows: Vec<(UVec3, usize)> = chunks.rows(chunk).collect();
            let mut damage: Vec<(usize, String)> = rows
                .par_iter()
                .flat_map_iter(|&(brick, row)| {
                    let of_row = |rows: &Option<Vec<u8>>, table: Table| {
                        let row_bytes = table.row_bytes(self.store.volume.stored_type);
                        rows.as_ref().map(|rows| rows[row * row_bytes..][..row_bytes].to_vec())
                    };
                    let told = [of_row(&ranges, Table::Range), of_row(&counts, Table::VoxelCounts)];
                    let damage = self.brick(level, grid, brick, told);
                    (self.progress)(self.done.fetch_add(1, Ordering::Relaxed) + 1, self.bricks);
                    damage.into_iter().map(move |line| (row, line))
                })
                .collect();
            damage.sort();
            self.note(damage.into_iter().map(|(_, line)| line));
            if self.damage.lock().expect("nothing panics while it is held").len() > MOST_DAMAGE {
                return false;
            }
        }
        true
    }

    /// The rows of a chunk, if it is sound.
    fn table_chunk(&self, level: u32, table: Table, chunk: UVec3) -> Option<Vec<u8>> {
        match read_chunk(self.root, self.store, level, table, chunk) {
            Ok(read) => Some(read.rows),
            Err(error) => {
                self.note([format!("table {} of level {level}: {error}", table.name())]);
                None
            }
        }
    }

    /// What is wrong with a brick, or with what its tables tell of it.
    fn brick(
        &self,
        level: u32,
        grid: &BrickGrid,
        at: UVec3,
        [range_row, counts_row]: [Option<Vec<u8>>; 2],
    ) -> Vec<String> {
        let id = BrickId::new(level, at);
        let StoreDesc { volume, layout, .. } = self.store;
        let (stored_type, layout, core) =
            (volume.stored_type, *layout, grid.core_end(at) - grid.core_start(at));
        let read = self.files.read(
            id,
            || Ok(()),
            |found, voxels| (found, StoredBrick { voxels, stored_type, layout, core }.stats()),
        );
        let (found, stats) = match read {
            Ok(read) => read,
            Err(error) => return vec![error.to_string()],
        };
        let mut cumulative = Vec::with_capacity(VCT_BINS * size_of::<u32>());
        cumulative.extend(stats.table.cumulative.iter().flat_map(|count| count.to_le_bytes()));
        let mut damage = Vec::new();
        for (table, told, counted) in
            [(Table::Range, range_row, &stats.range_row), (Table::VoxelCounts, counts_row, &cumulative)]
        {
            if told.is_none_or(|told| told == *counted) {
                continue;
            }
            damage.push(if found == Found::Zeros {
                let path = self.root.join(shard_path(id));
                format!("{} is damaged: {} does not hold it", brick_name(id), path.display())
            } else {
                format!("table {} of level {level} does not tell what {} holds", table.name(), brick_name(id))
            });
        }
        damage.dedup();
        damage
    }

    fn note(&self, lines: impl IntoIterator<Item = String>) {
        self.damage.lock().expect("nothing panics while it is held").extend(lines);
    }
}
