use std::io;
use std::path::PathBuf;

use crate::VolumeDesc;

/// Why voxels could not be read: one line that says what is wrong, in which file or field, and what to do.
pub type ReadError = Box<dyn std::error::Error + Send + Sync>;

/// What the user can do about a file that cannot be read, in the words that end the message.
pub fn io_advice(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => "check the path",
        io::ErrorKind::PermissionDenied => "check who may read it",
        _ => "check the disk that it lies on",
    }
}

/// A volume in a file format, read as a stream of slices from the first to the last.
///
/// A reader has checked its header against the length of its files before it exists, so that `desc` can be
/// trusted to allocate by.
pub trait VolumeReader: Send {
    /// The volume that this reader reads.
    fn desc(&self) -> &VolumeDesc;

    /// The format's name as people know it, such as `NRRD`.
    fn format(&self) -> &'static str;

    /// What the user should know of how the files were understood: a time step that was chosen, missing slices,
    /// gantry tilt. One sentence each.
    fn notes(&self) -> &[String];

    /// Where the voxels lie uncompressed in files, if they do: they can then be read in place.
    fn flat_placement(&self) -> Option<&FlatPlacement>;

    /// Reads the next `out.len() / slice_bytes` slices: voxels as stored, x fastest, in this machine's byte order.
    ///
    /// # Errors
    /// When the files end early, hold damaged data, or `out` reaches beyond the last slice.
    fn read_slices(&mut self, out: &mut [u8]) -> Result<(), ReadError>;

    /// Bytes of voxels that `read_slices` read from files so far, before decoding.
    fn bytes_read(&self) -> u64;
}

/// Byte order of stored voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Endian {
    Little,
    Big,
}

impl Endian {
    /// This machine's byte order.
    pub const NATIVE: Self = if cfg!(target_endian = "big") { Self::Big } else { Self::Little };
}

/// Uncompressed voxels in one or more files: the pieces follow each other along z.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlatPlacement {
    pub pieces: Vec<FlatPiece>,
    pub endian: Endian,
}

/// A run of whole slices that lie one after the other in one file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FlatPiece {
    pub path: PathBuf,
    /// Where the first voxel starts.
    pub offset_bytes: u64,
    /// How many slices follow from there.
    pub slices: u32,
}
