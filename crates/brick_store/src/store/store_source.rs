use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};

use glassbrick_volume::{
    Bins, Brick, BrickGrid, BrickId, BrickRange, BrickSource, Endian, ReadError, VCT_BINS, VolumeDesc,
    VoxelCountTable,
};

use super::brick_files::{Found, brick_name};
use super::metadata::level_path;
use super::read_metadata::{METADATA, check_documents, read_desc};
use super::table_chunks::{TableRows, read_table};
use super::{BrickFiles, StoreDesc, StoreError, Table, shard_path};
use crate::brick_stats::kept_range;
use crate::decode::{Kept, Stored, with_stored};
use crate::platform::FileIdentity;

/// A brick store that is open. Opening reads metadata and ranges; tables and bricks are read when they are asked for,
/// by any number of threads and processes.
pub struct StoreSource {
    root: PathBuf,
    store: StoreDesc,
    identity: FileIdentity,
    levels: Vec<Level>,
    files: BrickFiles,
    /// Of metadata and tables.
    bytes_read: AtomicU64,
}

struct Level {
    grid: BrickGrid,
    ranges: Vec<BrickRange>,
    tables: Mutex<Option<Arc<Vec<VoxelCountTable>>>>,
}

/// Whether there is a folder at a path that is a Zarr group or array of whatever kind, or is named as one.
pub fn is_zarr(path: &Path) -> bool {
    path.join(METADATA).is_file()
        || (path.extension().is_some_and(|ending| ending == "zarr") && path.is_dir())
}

/// Whether there is a brick store at a path, sound or not.
pub fn is_store(path: &Path) -> bool {
    !matches!(read_desc(path), Err(StoreError::NotAStore { .. } | StoreError::Read { .. }))
}

impl StoreSource {
    /// Opens the store in a folder, and checks its metadata and ranges.
    ///
    /// # Errors
    /// When it is no brick store, of another version, or damaged.
    pub fn open(root: &Path) -> Result<Self, StoreError> {
        let path = root.join(METADATA);
        let identity = FileIdentity::of(&path);
        let (store, mut bytes_read) = read_desc(root)?;
        let identity = identity.map_err(|source| StoreError::reading(&path, source))?;
        bytes_read += check_documents(root, &store, Err)?;
        let levels = (0..store.levels())
            .map(|level| {
                let grid = store.layout.level_grid(store.volume.extent, level);
                let TableRows { rows, bytes_read: table_bytes } =
                    read_table(root, &store, level, Table::Range)?;
                bytes_read += table_bytes;
                let ranges = with_stored!(store.volume.stored_type, Endian::Little, ranges(&rows));
                match ranges.iter().position(|range| !is_sound(range)) {
                    None => Ok(Level { grid, ranges, tables: Mutex::default() }),
                    Some(index) => Err(table_damage(root, Table::Range, &grid, level, index)),
                }
            })
            .collect::<Result<_, StoreError>>()?;
        let files = BrickFiles::new(root.to_owned(), &store);
        let bytes_read = AtomicU64::new(bytes_read);
        let source = Self { root: root.to_owned(), identity, levels, files, bytes_read, store };
        source.check_it_is_the_same()?;
        Ok(source)
    }

    /// What the store says of itself.
    pub fn store(&self) -> &StoreDesc {
        &self.store
    }

    /// The voxel-count tables of a level.
    fn read_tables(&self, level: u32) -> Result<Vec<VoxelCountTable>, StoreError> {
        let TableRows { rows, bytes_read } = read_table(&self.root, &self.store, level, Table::VoxelCounts)?;
        self.check_it_is_the_same()?;
        self.bytes_read.fetch_add(bytes_read, Ordering::Relaxed);
        let Level { grid, ranges, .. } = &self.levels[level as usize];
        let whole_numbers = self.store.volume.stored_type.is_integer();
        let (rows, _) = rows.as_chunks::<{ VCT_BINS * size_of::<u32>() }>();
        rows.iter()
            .zip(ranges)
            .enumerate()
            .map(|(index, (row, range))| {
                let (counts, _) = row.as_chunks::<{ size_of::<u32>() }>();
                let cumulative = std::array::from_fn(|bin| u32::from_le_bytes(counts[bin]));
                let [min, max] = range.core.map(f64::from);
                let table = VoxelCountTable { cumulative, bins: Bins { min, max, whole_numbers } };
                let brick = grid.brick(index);
                let core = (grid.core_end(brick) - grid.core_start(brick)).element_product();
                if table.cumulative.is_sorted() && table.voxels() == core {
                    Ok(table)
                } else {
                    Err(table_damage(&self.root, Table::VoxelCounts, grid, level, index))
                }
            })
            .collect()
    }

    /// A store that has taken this one's place has other bricks than the ranges at hand are of.
    fn check_it_is_the_same(&self) -> Result<(), StoreError> {
        match FileIdentity::of(&self.root.join(METADATA)) {
            Ok(identity) if identity == self.identity => Ok(()),
            _ => Err(StoreError::Replaced { path: self.root.clone() }),
        }
    }
}

fn ranges<S: Stored>(rows: &[u8]) -> Vec<BrickRange> {
    rows.chunks_exact(4 * S::BYTES).map(kept_range::<S>).collect()
}

fn is_sound(BrickRange { reach, core }: &BrickRange) -> bool {
    reach[0] <= core[0] && core[0] <= core[1] && core[1] <= reach[1]
}

fn table_damage(root: &Path, table: Table, grid: &BrickGrid, level: u32, index: usize) -> StoreError {
    let what = format!("says what cannot be of {}", brick_name(BrickId::new(level, grid.brick(index))));
    StoreError::Damaged { path: root.join(level_path(level)).join(table.name()), what }
}

fn keep<S: Stored>(voxels: &[u8], edge: u32) -> Brick {
    let count = voxels.len() / S::BYTES;
    let mut kept = vec![S::Kept::default(); count + Brick::PADDING];
    S::decode(voxels, &mut kept[..count]);
    Brick::new(edge, S::Kept::into_voxels(kept))
}

impl BrickSource for StoreSource {
    fn desc(&self) -> &VolumeDesc {
        &self.store.volume
    }

    fn levels(&self) -> u32 {
        self.levels.len() as u32
    }

    fn grid(&self, level: u32) -> BrickGrid {
        self.levels[level as usize].grid
    }

    fn ranges(&self, level: u32) -> &[BrickRange] {
        &self.levels[level as usize].ranges
    }

    fn voxel_count_tables(&self, level: u32) -> Result<Arc<Vec<VoxelCountTable>>, ReadError> {
        let tables = &self.levels[level as usize].tables;
        let mut tables = tables.lock().expect("nothing panics while it is held");
        if let Some(tables) = &*tables {
            return Ok(Arc::clone(tables));
        }
        let read = Arc::new(self.read_tables(level)?);
        *tables = Some(Arc::clone(&read));
        Ok(read)
    }

    fn brick(&self, id: BrickId) -> Result<Arc<Brick>, ReadError> {
        let level = &self.levels[id.level as usize];
        let is_zero = level.ranges[level.grid.index(id.place())].reach == [0.0; 2];
        let (stored_type, edge) = (self.store.volume.stored_type, self.store.layout.edge);
        let kept = self.files.read(
            id,
            || self.check_it_is_the_same(),
            |found, voxels| {
                // A brick that is not stored holds nothing but zeros, and its range must say so.
                (found == Found::Stored || is_zero)
                    .then(|| with_stored!(stored_type, Endian::Little, keep(voxels, edge)))
            },
        )?;
        kept.map(Arc::new).ok_or_else(|| {
            let path = self.root.join(shard_path(id));
            let what = "does not hold it".to_owned();
            StoreError::DamagedBrick { brick: brick_name(id), path, what }.into()
        })
    }

    fn will_need(&self, bricks: &[BrickId]) {
        bricks.iter().for_each(|&id| self.files.will_need(id, || self.check_it_is_the_same()));
    }

    /// Bricks are read anew each time, and nothing was promised of what becomes of them.
    fn can_hold(&self, _bricks: usize) -> bool {
        false
    }

    fn not_finite(&self) -> u64 {
        self.store.not_finite
    }

    fn bytes_read(&self) -> u64 {
        self.bytes_read.load(Ordering::Relaxed) + self.files.bytes_read()
    }
}
