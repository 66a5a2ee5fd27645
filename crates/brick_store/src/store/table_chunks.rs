use std::fs;
use std::path::{Path, PathBuf};

use glam::UVec3;
use glassbrick_volume::{BrickGrid, StoredType, VCT_BINS};

use super::metadata::level_path;
use super::shard::SHARD_EDGE;
use super::{Codec, StoreDesc, StoreError};

/// Bricks along x and y of a chunk, at most.
const CHUNK_EDGE: u32 = 64;

/// A table with a row for every brick of a level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Smallest and largest stored value over the core and one voxel around it, then over the core.
    Range,
    /// Cumulative voxel counts.
    VoxelCounts,
}

impl Table {
    /// Every table.
    pub const ALL: [Self; 2] = [Self::Range, Self::VoxelCounts];

    /// The name of its array.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Range => "range",
            Self::VoxelCounts => "vct",
        }
    }

    /// Elements of a row.
    pub const fn columns(self) -> usize {
        match self {
            Self::Range => 4,
            Self::VoxelCounts => VCT_BINS,
        }
    }

    /// What the elements of a row are.
    pub const fn column_name(self) -> &'static str {
        match self {
            Self::Range => "min_max",
            Self::VoxelCounts => "bin",
        }
    }

    /// The type of its elements in a store of a type of voxels.
    pub const fn element(self, stored_type: StoredType) -> StoredType {
        match self {
            Self::Range => stored_type,
            Self::VoxelCounts => StoredType::U32,
        }
    }

    /// Bytes of a row.
    pub const fn row_bytes(self, stored_type: StoredType) -> usize {
        self.columns() * self.element(stored_type).bytes()
    }
}

/// How the tables of a level are cut into chunks: a row of shards' bricks along z, at most 64 by 64 of them.
#[derive(Clone, Copy, Debug)]
pub struct TableChunks {
    /// Bricks of a chunk.
    pub shape: UVec3,
    grid: BrickGrid,
}

impl TableChunks {
    pub fn new(grid: &BrickGrid) -> Self {
        let shape = UVec3::new(CHUNK_EDGE, CHUNK_EDGE, SHARD_EDGE).min(grid.counts);
        Self { shape, grid: *grid }
    }

    /// Bricks of a chunk, those beyond the grid included.
    pub fn bricks_per_chunk(&self) -> usize {
        self.shape.as_usizevec3().element_product()
    }

    /// How many chunks there are along z.
    pub fn layers(&self) -> u32 {
        self.counts().z
    }

    /// The chunks at a place along z.
    pub fn layer(&self, z: u32) -> impl Iterator<Item = UVec3> + use<> {
        let counts = self.counts();
        (0..counts.y).flat_map(move |y| (0..counts.x).map(move |x| UVec3::new(x, y, z)))
    }

    fn counts(&self) -> UVec3 {
        let [counts, shape] = [self.grid.counts, self.shape].map(|counts| counts.to_array());
        UVec3::from_array(std::array::from_fn(|axis| counts[axis].div_ceil(shape[axis])))
    }

    /// The bricks of a chunk, each with its row in the chunk.
    pub fn rows(&self, chunk: UVec3) -> impl Iterator<Item = (UVec3, usize)> + use<> {
        let shape = self.shape;
        let first = chunk * shape;
        let end = (first + shape).min(self.grid.counts);
        let bricks = (first.z..end.z).flat_map(move |z| {
            (first.y..end.y).flat_map(move |y| (first.x..end.x).map(move |x| UVec3::new(x, y, z)))
        });
        bricks.map(move |brick| {
            let [inner, shape] = [brick - first, shape].map(|place| place.as_usizevec3());
            (brick, (inner.z * shape.y + inner.y) * shape.x + inner.x)
        })
    }
}

/// The file of a chunk within its store.
pub fn chunk_path(level: u32, table: Table, chunk: UVec3) -> PathBuf {
    let UVec3 { x, y, z } = chunk;
    level_path(level).join(format!("{}/c/{z}/{y}/{x}/0", table.name()))
}

/// The rows of a table, by place in the grid, and how many bytes they took in files.
pub struct TableRows {
    pub rows: Vec<u8>,
    pub bytes_read: u64,
}

/// Reads a whole table. Memory is taken once all its files are found, whatever the grid claims.
///
/// # Errors
/// When a chunk is missing or damaged.
pub fn read_table(root: &Path, store: &StoreDesc, level: u32, table: Table) -> Result<TableRows, StoreError> {
    let grid = store.layout.level_grid(store.volume.extent, level);
    let chunks = TableChunks::new(&grid);
    let row_bytes = table.row_bytes(store.volume.stored_type);
    let places = || (0..chunks.layers()).flat_map(|layer| chunks.layer(layer));
    for chunk in places() {
        let path = root.join(chunk_path(level, table, chunk));
        path.metadata().map_err(|source| StoreError::reading(&path, source))?;
    }
    let (mut rows, mut bytes_read) = (Vec::new(), 0);
    for chunk in places() {
        let read = read_chunk(root, store, level, table, chunk)?;
        bytes_read += read.bytes_read;
        for (brick, row) in chunks.rows(chunk) {
            let place = grid.index(brick) * row_bytes;
            if rows.len() < place + row_bytes {
                rows.resize(place + row_bytes, 0);
            }
            rows[place..place + row_bytes].copy_from_slice(&read.rows[row * row_bytes..][..row_bytes]);
        }
    }
    Ok(TableRows { rows, bytes_read })
}

/// Reads the rows of one chunk, by place in the chunk.
///
/// # Errors
/// When it is missing or damaged.
pub fn read_chunk(
    root: &Path,
    store: &StoreDesc,
    level: u32,
    table: Table,
    chunk: UVec3,
) -> Result<TableRows, StoreError> {
    let chunks = TableChunks::new(&store.layout.level_grid(store.volume.extent, level));
    let chunk_bytes = chunks.bricks_per_chunk() * table.row_bytes(store.volume.stored_type);
    let path = root.join(chunk_path(level, table, chunk));
    let damaged = |what: &str| StoreError::Damaged { path: path.clone(), what: what.to_owned() };
    let reading = |source| StoreError::reading(&path, source);
    if path.metadata().map_err(reading)?.len() > Codec::most_encoded_bytes(chunk_bytes) as u64 {
        return Err(damaged("is too long"));
    }
    let encoded = fs::read(&path).map_err(reading)?;
    let mut rows = vec![0; chunk_bytes];
    store.codec.decode(&encoded, &mut rows).map_err(damaged)?;
    Ok(TableRows { rows, bytes_read: encoded.len() as u64 })
}
