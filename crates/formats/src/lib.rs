//! Readers of volume files: raw, NRRD, MetaImage, NIfTI and DICOM.
//!
//! [`open`] looks at a file or folder, finds out what it is, and gives a [`VolumeReader`] that streams its slices
//! in the stored type. Every header is held against the length of the files before anything is allocated by it.
//!
//! This crate knows nothing about bricks, stores or pictures.

mod dicom;
mod error;
mod raw;

use std::path::Path;

use glassbrick_volume::VolumeReader;

pub use error::FormatError;
pub use raw::RawLayout;

/// What the user says of an input beyond its path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpenOptions {
    /// What a raw file holds; nothing is read as raw without it.
    pub raw: Option<RawLayout>,
    /// The time step to read, from 0, where there are several; the first where nothing is said.
    pub time: Option<u32>,
}

/// Opens a volume file or a folder of slices, whatever its format.
///
/// # Errors
/// When it cannot be read, is of no known format, contradicts itself, or holds what is not a scalar volume.
pub fn open(path: &Path, options: &OpenOptions) -> Result<Box<dyn VolumeReader>, FormatError> {
    match dicom::open_path(path, options)? {
        Some(reader) => Ok(reader),
        None => Err(FormatError::Unknown {
            path: path.to_owned(),
            what: "this is no volume format that glassbrick reads".to_owned(),
        }),
    }
}
