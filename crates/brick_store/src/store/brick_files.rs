use std::cell::RefCell;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use glassbrick_volume::BrickId;
use quick_cache::sync::Cache;

use super::shard::{Shard, shard_path};
use super::{Codec, StoreDesc, StoreError};
use crate::platform;

/// Shards that are kept open, at most.
const OPEN_SHARDS: usize = 256;

thread_local! {
    /// Room for a brick's bytes: as in its file, and decoded.
    static ROOM: RefCell<[Vec<u8>; 2]> = const { RefCell::new([Vec::new(), Vec::new()]) };
}

/// The files in which the bricks of a store lie.
pub struct BrickFiles {
    root: PathBuf,
    codec: Codec,
    brick_bytes: usize,
    /// By level and place among shards.
    open: Cache<PathBuf, Arc<Shard>>,
    bytes_read: AtomicU64,
}

/// What is found where a brick should be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    Stored,
    /// The brick is not stored, which is said of bricks that hold nothing but zeros.
    Zeros,
}

impl BrickFiles {
    /// The bricks of the store in a folder.
    pub fn new(root: PathBuf, store: &StoreDesc) -> Self {
        Self {
            root,
            codec: store.codec,
            brick_bytes: store.brick_bytes(),
            open: Cache::new(OPEN_SHARDS),
            bytes_read: AtomicU64::new(0),
        }
    }

    /// Reads a brick's stored voxels, little-endian, which `use_voxels` is given. `check_shard` is asked after each
    /// opening of a shard.
    ///
    /// # Errors
    /// When the brick cannot be read or is damaged; it is named.
    pub fn read<R>(
        &self,
        id: BrickId,
        check_shard: impl Fn() -> Result<(), StoreError>,
        use_voxels: impl FnOnce(Found, &[u8]) -> R,
    ) -> Result<R, StoreError> {
        let shard = self.shard(id, check_shard)?;
        ROOM.with_borrow_mut(|[encoded, voxels]| {
            voxels.resize(self.brick_bytes, 0);
            let found = match shard.index.place(id.place()) {
                Some(place) => {
                    self.read_place(id, &shard, place, encoded, voxels)?;
                    Found::Stored
                }
                None => {
                    voxels.fill(0);
                    Found::Zeros
                }
            };
            Ok(use_voxels(found, voxels))
        })
    }

    /// Reads and decodes what is stored at an offset, with a length.
    fn read_place(
        &self,
        id: BrickId,
        shard: &Shard,
        [offset, len]: [u64; 2],
        encoded: &mut Vec<u8>,
        voxels: &mut [u8],
    ) -> Result<(), StoreError> {
        let damaged = |what: &str| StoreError::DamagedBrick {
            brick: brick_name(id),
            path: shard.path.clone(),
            what: format!("from byte {offset} to {} {what}", offset + len),
        };
        if len > Codec::most_encoded_bytes(self.brick_bytes) as u64 {
            return Err(damaged("is longer than a brick"));
        }
        encoded.resize(len as usize, 0);
        platform::read_exact_at(&shard.file, encoded, offset)
            .map_err(|source| StoreError::reading(&shard.path, source))?;
        self.bytes_read.fetch_add(len, Ordering::Relaxed);
        self.codec.decode(encoded, voxels).map_err(damaged)
    }

    /// Asks the system to bring a brick's bytes into memory. `check_shard` is asked after each opening of a shard, which
    /// stays open for those who read.
    pub fn will_need(&self, id: BrickId, check_shard: impl Fn() -> Result<(), StoreError>) {
        // Whoever reads the brick is told what is wrong with it.
        if let Ok(shard) = self.shard(id, check_shard)
            && let Some([offset, len]) = shard.index.place(id.place())
        {
            platform::will_need(&shard.file, offset, len);
        }
    }

    /// Bytes read so far.
    pub fn bytes_read(&self) -> u64 {
        self.bytes_read.load(Ordering::Relaxed)
    }

    fn shard(
        &self,
        id: BrickId,
        check: impl Fn() -> Result<(), StoreError>,
    ) -> Result<Arc<Shard>, StoreError> {
        self.open.get_or_insert_with(&shard_path(id), || {
            let shard = Shard::open(&self.root.join(shard_path(id))).map_err(|error| named(error, id))?;
            check()?;
            self.bytes_read.fetch_add(Shard::OPENING_BYTES, Ordering::Relaxed);
            Ok(Arc::new(shard))
        })
    }
}

/// How messages name a brick.
pub fn brick_name(BrickId { level, x, y, z }: BrickId) -> String {
    format!("brick {x},{y},{z} of level {level}")
}

/// Damage of a shard as damage of the brick that is looked for in it.
fn named(error: StoreError, id: BrickId) -> StoreError {
    match error {
        StoreError::Damaged { path, what } => StoreError::DamagedBrick { brick: brick_name(id), path, what },
        other => other,
    }
}
