//! Readers of volume files: raw, NRRD, MetaImage, NIfTI and DICOM.
//!
//! [`open`] looks at a file or folder, finds out what it is, and gives a [`VolumeReader`] that streams its slices
//! in the stored type. Every header is held against the length of the files before anything is allocated by it.
//!
//! This crate knows nothing about bricks, stores or pictures.
//!
//! ```
//! use glassbrick_formats::{OpenOptions, open};
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("tiny.mha");
//! std::fs::write(
//!     &path,
//!     "NDims = 3\nDimSize = 2 2 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nabcd",
//! )?;
//! let mut reader = open(&path, &OpenOptions::default())?;
//! let mut voxels = vec![0; reader.desc().bytes() as usize];
//! reader.read_slices(&mut voxels)?;
//! assert_eq!(voxels, b"abcd");
//! # Ok::<(), Box<dyn std::error::Error + Send + Sync>>(())
//! ```

mod detect;
mod dicom;
mod error;
mod geometry;
mod header_text;
mod metaimage;
mod nifti;
mod nrrd;
mod raw;
mod voxels;

#[cfg(test)]
mod tests;

use std::path::Path;

use glassbrick_volume::VolumeReader;

use detect::Found;
pub use error::FormatError;
pub use raw::RawLayout;

/// What the user says of an input beyond its path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OpenOptions {
    /// What a raw file holds; nothing is read as raw without it, and everything with it.
    pub raw: Option<RawLayout>,
    /// The time step to read, from 0, where there are several; the first where nothing is said.
    pub time: Option<u32>,
}

/// Opens a volume file or a folder of slices, whatever its format.
///
/// # Errors
/// When it cannot be read, is of no known format, contradicts itself, or holds what is not a scalar volume.
pub fn open(path: &Path, options: &OpenOptions) -> Result<Box<dyn VolumeReader>, FormatError> {
    let metadata = path.metadata().map_err(|error| FormatError::io(path, error))?;
    if metadata.is_dir() {
        return open_folder(path, options);
    }
    if !metadata.is_file() {
        return Err(FormatError::unknown(path, "is neither a file nor a folder"));
    }
    if let Some(layout) = &options.raw {
        return raw::open(path, layout, options);
    }
    match detect::detect(path)? {
        Found::Nrrd => nrrd::open(path, options),
        Found::MetaImage => metaimage::open(path, options),
        Found::Nifti(first) => nifti::open(path, &first, options),
        Found::NiftiVoxels(header) => match detect::detect(&header)? {
            Found::Nifti(first) => nifti::open(&header, &first, options),
            Found::Foreign(name) => Err(not_read(&header, name)),
            _ => {
                Err(FormatError::unknown(&header, "is no NIfTI header, and NIfTI-like voxels are beside it"))
            }
        },
        Found::Foreign(name) => Err(not_read(path, name)),
        Found::Dicom | Found::Nothing => match dicom::open_path(path, options)? {
            Some(reader) => Ok(reader),
            None => Err(FormatError::unknown(
                path,
                "is of no known format; glassbrick reads NRRD, MetaImage, NIfTI, DICOM, and raw voxels with \
                 --extent and --dtype",
            )),
        },
    }
}

fn open_folder(path: &Path, options: &OpenOptions) -> Result<Box<dyn VolumeReader>, FormatError> {
    if let Some(reader) = dicom::open_path(path, options)? {
        return Ok(reader);
    }
    let is_zarr = ["zarr.json", ".zgroup", ".zattrs", ".zarray"].iter().any(|name| path.join(name).exists());
    let what = if is_zarr {
        "is a Zarr folder, which glassbrick does not read; save one of its arrays as NRRD, MetaImage or NIfTI, and \
         open that"
    } else {
        "holds no DICOM file; name a folder of DICOM slices, or a single NRRD, MetaImage, NIfTI or raw file"
    };
    Err(FormatError::unknown(path, what))
}

fn not_read(path: &Path, name: &str) -> FormatError {
    let what = format!(
        "looks like {name}; glassbrick reads NRRD, MetaImage, NIfTI and DICOM, and anything as raw voxels with \
         --extent and --dtype"
    );
    FormatError::unsupported(path, what)
}
