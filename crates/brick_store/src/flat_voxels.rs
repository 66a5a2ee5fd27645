use std::fs::File;
use std::path::PathBuf;

use glassbrick_volume::{Endian, FlatPlacement, VolumeDesc};
use memmap2::Mmap;

use crate::SourceError;
use crate::brick_cut::Slices;

/// The voxels of a whole volume, slice by slice, as bytes of their stored type.
pub struct FlatVoxels {
    storage: Storage,
    slice_bytes: usize,
    pub(crate) endian: Endian,
}

enum Storage {
    /// Pieces of mapped files; `first_slice` ascends.
    Mapped(Vec<MappedPiece>),
    Array(Vec<u8>),
}

struct MappedPiece {
    map: Mmap,
    offset: usize,
    first_slice: u32,
}

impl FlatVoxels {
    /// Maps the files in which the voxels lie.
    ///
    /// A mapped file must not be cut while it is open: the operating system then ends the process.
    pub fn map(desc: &VolumeDesc, placement: &FlatPlacement) -> Result<Self, SourceError> {
        let slice_bytes = desc.slice_bytes();
        let mut first_slice = 0;
        let mut pieces = Vec::with_capacity(placement.pieces.len());
        for piece in &placement.pieces {
            let at = |source| SourceError::Io { path: piece.path.clone(), source };
            let file = File::open(&piece.path).map_err(at)?;
            let len = file.metadata().map_err(at)?.len();
            let needed = u64::from(piece.slices) * slice_bytes;
            if len.checked_sub(piece.offset_bytes).is_none_or(|rest| rest < needed) {
                let (path, offset) = (piece.path.clone(), piece.offset_bytes);
                return Err(SourceError::TooShort { path, offset, needed, len });
            }
            // SAFETY: the map is read only; that the file is not cut meanwhile is the caller's promise, as documented.
            let map = unsafe { Mmap::map(&file) }.map_err(at)?;
            pieces.push(MappedPiece { map, offset: piece.offset_bytes as usize, first_slice });
            first_slice += piece.slices;
        }
        if first_slice < desc.extent.z {
            let path = placement.pieces.last().map_or_else(PathBuf::new, |piece| piece.path.clone());
            return Err(SourceError::TooShort { path, offset: 0, needed: desc.bytes(), len: 0 });
        }
        let slice_bytes = slice_bytes as usize;
        Ok(Self { storage: Storage::Mapped(pieces), slice_bytes, endian: placement.endian })
    }

    /// Takes an array of stored voxels in this machine's byte order, x fastest.
    pub fn array(desc: &VolumeDesc, bytes: Vec<u8>) -> Result<Self, SourceError> {
        if bytes.len() as u64 != desc.bytes() {
            return Err(SourceError::WrongArrayLength { needed: desc.bytes(), len: bytes.len() as u64 });
        }
        Ok(Self {
            storage: Storage::Array(bytes),
            slice_bytes: desc.slice_bytes() as usize,
            endian: Endian::NATIVE,
        })
    }

    /// Whether reading voxels reads a file.
    pub fn is_mapped(&self) -> bool {
        matches!(self.storage, Storage::Mapped(_))
    }
}

impl Slices for FlatVoxels {
    fn slice(&self, z: u32) -> &[u8] {
        let (bytes, start) = match &self.storage {
            Storage::Array(bytes) => (bytes.as_slice(), z as usize * self.slice_bytes),
            Storage::Mapped(pieces) => {
                let piece = &pieces[pieces.partition_point(|piece| piece.first_slice <= z) - 1];
                (&piece.map[..], piece.offset + (z - piece.first_slice) as usize * self.slice_bytes)
            }
        };
        &bytes[start..start + self.slice_bytes]
    }
}
