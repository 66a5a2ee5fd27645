use std::fs::File;
use std::path::{Path, PathBuf};

use glam::UVec3;
use glassbrick_volume::BrickId;

use super::StoreError;
use super::codec::checked;
use super::metadata::level_path;
use crate::platform;

/// Bricks along each axis of a shard.
pub const SHARD_EDGE: u32 = 4;

const SHARD_BRICKS: usize = (SHARD_EDGE * SHARD_EDGE * SHARD_EDGE) as usize;

/// Bytes of an index: offset and length of each brick, and a checksum.
const INDEX_BYTES: usize = SHARD_BRICKS * 2 * size_of::<u64>() + size_of::<u32>();

/// Where the encoded bricks of a shard lie in its file; the index is the file's end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShardIndex {
    /// Offset and length; a brick that is not stored holds nothing but zeros.
    places: [Option<[u64; 2]>; SHARD_BRICKS],
}

impl Default for ShardIndex {
    fn default() -> Self {
        Self { places: [None; SHARD_BRICKS] }
    }
}

impl ShardIndex {
    /// Offset and length of a brick of the grid, where it is stored.
    pub fn place(&self, brick: UVec3) -> Option<[u64; 2]> {
        self.places[Self::inner(brick)]
    }

    /// Takes note of where a brick of the grid is stored.
    pub fn set_place(&mut self, brick: UVec3, offset: u64, len: u64) {
        self.places[Self::inner(brick)] = Some([offset, len]);
    }

    /// The index as it stands at the end of a shard.
    pub fn encode(&self) -> Vec<u8> {
        let numbers = self.places.iter().flat_map(|place| place.unwrap_or([u64::MAX; 2]));
        let mut bytes: Vec<u8> = numbers.flat_map(u64::to_le_bytes).collect();
        bytes.extend(crc32c::crc32c(&bytes).to_le_bytes());
        bytes
    }

    /// Reads an index that stands at the end of a shard of `shard_bytes`.
    fn decode(encoded: &[u8], shard_bytes: u64) -> Result<Self, String> {
        let bytes = checked(encoded).map_err(|what| format!("its index {what}"))?;
        let (numbers, _) = bytes.as_chunks::<{ size_of::<u64>() }>();
        let mut index = Self::default();
        for (place, pair) in index.places.iter_mut().zip(numbers.chunks_exact(2)) {
            let [offset, len] = [pair[0], pair[1]].map(u64::from_le_bytes);
            if [offset, len] == [u64::MAX; 2] {
                continue;
            }
            if offset.checked_add(len).is_none_or(|end| end > shard_bytes - INDEX_BYTES as u64) {
                return Err("its index names bytes that it does not have".to_owned());
            }
            *place = Some([offset, len]);
        }
        Ok(index)
    }

    /// The place in the index of a brick of the grid.
    fn inner(brick: UVec3) -> usize {
        let UVec3 { x, y, z } = brick % SHARD_EDGE;
        ((z * SHARD_EDGE + y) * SHARD_EDGE + x) as usize
    }
}

/// The file of the shard that a brick lies in, within its store.
pub fn shard_path(id: BrickId) -> PathBuf {
    let [x, y, z] = [id.x, id.y, id.z].map(|brick| brick / SHARD_EDGE);
    level_path(id.level).join(format!("bricks/c/{z}/{y}/{x}/0/0/0"))
}

/// An open shard.
pub struct Shard {
    pub file: File,
    pub path: PathBuf,
    pub index: ShardIndex,
}

impl Shard {
    /// Bytes that opening a shard reads.
    pub const OPENING_BYTES: u64 = INDEX_BYTES as u64;

    /// Opens a shard and reads its index.
    ///
    /// # Errors
    /// When it is missing, cut off or damaged.
    pub fn open(path: &Path) -> Result<Self, StoreError> {
        let reading = |source| StoreError::reading(path, source);
        let damaged = |what| StoreError::Damaged { path: path.to_owned(), what };
        let file = File::open(path).map_err(reading)?;
        let shard_bytes = file.metadata().map_err(reading)?.len();
        let Some(offset) = shard_bytes.checked_sub(INDEX_BYTES as u64) else {
            return Err(damaged("was cut off".to_owned()));
        };
        let mut encoded = [0; INDEX_BYTES];
        platform::read_exact_at(&file, &mut encoded, offset).map_err(reading)?;
        let index = ShardIndex::decode(&encoded, shard_bytes).map_err(damaged)?;
        Ok(Self { file, path: path.to_owned(), index })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_index_goes_there_and_back() {
        let mut index = ShardIndex::default();
        index.set_place(UVec3::new(5, 2, 7), 0, 10);
        index.set_place(UVec3::new(4, 0, 4), 10, 90);
        let encoded = index.encode();
        assert_eq!(encoded.len(), INDEX_BYTES);
        assert_eq!(ShardIndex::decode(&encoded, 100 + INDEX_BYTES as u64), Ok(index));
    }

    #[test]
    fn an_index_that_names_bytes_beyond_its_shard_is_refused() {
        for [offset, len] in [[91, 10], [u64::MAX - 4, 10], [0, u64::MAX]] {
            let mut index = ShardIndex::default();
            index.set_place(UVec3::ONE, offset, len);
            assert!(ShardIndex::decode(&index.encode(), 100 + INDEX_BYTES as u64).is_err());
        }
    }
}
