//! What a file is, by its first bytes, and by its name where those leave it open.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use crate::{FormatError, metaimage, nifti, nrrd};

/// As much as any format needs to be known by.
const FIRST_BYTES: u64 = 4096;

/// What a file turns out to be.
#[derive(Debug, PartialEq)]
pub(crate) enum Found {
    Nrrd,
    MetaImage,
    /// With the first bytes of its header, decompressed.
    Nifti(Vec<u8>),
    /// The voxels of a pair, whose header is this file.
    NiftiVoxels(PathBuf),
    Dicom,
    /// Something with a name that is not read.
    Foreign(&'static str),
    Nothing,
}

impl Found {
    /// The format, if it is one that is read.
    pub fn format_name(&self) -> Option<&'static str> {
        match self {
            Self::Nrrd => Some("NRRD"),
            Self::MetaImage => Some("MetaImage"),
            Self::Nifti(_) => Some("NIfTI"),
            Self::Dicom => Some("DICOM"),
            Self::NiftiVoxels(_) | Self::Foreign(_) | Self::Nothing => None,
        }
    }
}

/// The first bytes of a file.
pub(crate) fn first_bytes(path: &Path) -> Result<Vec<u8>, FormatError> {
    let failed = |error| FormatError::io(path, error);
    let mut first = Vec::new();
    File::open(path).map_err(failed)?.take(FIRST_BYTES).read_to_end(&mut first).map_err(failed)?;
    Ok(first)
}

/// Finds out what a file is.
pub(crate) fn detect(path: &Path) -> Result<Found, FormatError> {
    let first = first_bytes(path)?;
    let extension =
        path.extension().and_then(|extension| extension.to_str()).unwrap_or("").to_ascii_lowercase();
    if nrrd::is_nrrd(&first) {
        return Ok(Found::Nrrd);
    }
    if first.get(128..132) == Some(b"DICM") {
        return Ok(Found::Dicom);
    }
    if nifti::is_nifti(&first) {
        return Ok(Found::Nifti(first));
    }
    if first.starts_with(&[0x1f, 0x8b]) {
        let inside = first_decompressed(&first);
        if nifti::is_nifti(&inside) {
            return Ok(Found::Nifti(inside));
        }
    }
    if metaimage::is_metaimage(&first) || matches!(extension.as_str(), "mhd" | "mha") {
        return Ok(Found::MetaImage);
    }
    if let Some(header) = nifti::header_beside(path) {
        return Ok(Found::NiftiVoxels(header));
    }
    if extension == "hdr" && nifti::is_analyze(&first) {
        return Ok(Found::Foreign(
            "an Analyze 7.5 header, which does not tell left from right; convert it to NIfTI",
        ));
    }
    Ok(foreign(&first, &extension).map_or(Found::Nothing, Found::Foreign))
}

/// What the first bytes of a gzip file hold, as far as they go.
fn first_decompressed(first: &[u8]) -> Vec<u8> {
    let mut inside = Vec::new();
    // The first bytes end in the middle of the stream, so an error at their end says nothing.
    let _ = flate2::read::MultiGzDecoder::new(first).take(FIRST_BYTES).read_to_end(&mut inside);
    inside
}

/// The name of something that is known but not read.
fn foreign(first: &[u8], extension: &str) -> Option<&'static str> {
    const MAGICS: &[(usize, &[u8], &str)] = &[
        (0, b"II*\0", "a TIFF image"),
        (0, b"MM\0*", "a TIFF image"),
        (0, b"II+\0", "a BigTIFF image"),
        (0, b"MM\0+", "a BigTIFF image"),
        (0, b"\x89PNG", "a PNG image"),
        (0, b"\xff\xd8\xff", "a JPEG image"),
        (0, b"GIF8", "a GIF image"),
        (0, b"\0\0\0\x0cjP  ", "a JPEG 2000 image"),
        (0, b"PK\x03\x04", "a zip archive; unpack it"),
        (0, b"7z\xbc\xaf\x27\x1c", "a 7z archive; unpack it"),
        (0, b"\xfd7zXZ", "xz-compressed data; decompress it"),
        (0, b"\x28\xb5\x2f\xfd", "zstd-compressed data; decompress it"),
        (257, b"ustar", "a tar archive; unpack it"),
        (0, b"ZISRAWFILE", "a Zeiss CZI image"),
        (0, b"\x89HDF\r\n\x1a\n", "an HDF5 file (MINC, Imaris or other)"),
        (0, b"CDF", "a NetCDF file"),
        (0, b"\x93NUMPY", "a NumPy array"),
        (0, b"# vtk DataFile", "a legacy VTK file"),
        (0, b"mrtrix image", "an MRtrix image"),
        (208, b"MAP ", "an MRC map"),
        (0, b"%PDF", "a PDF document"),
        (252, b"\xef\xff\xe9\xb0", "a GIPL image"),
    ];
    if first.is_empty() {
        return Some("an empty file");
    }
    let known = MAGICS
        .iter()
        .find(|(offset, magic, _)| first.get(*offset..).is_some_and(|bytes| bytes.starts_with(magic)));
    if let Some((_, _, name)) = known {
        return Some(name);
    }
    match (first, extension) {
        ([0x1f, 0x8b, ..], _) => Some("gzip-compressed data, but not NIfTI; decompress it"),
        ([b'B', b'Z', b'h', ..], _) => Some("bzip2-compressed data; decompress it"),
        (_, "slc") => Some("a VolVis SLC volume"),
        (_, "den") => Some("a VolPack density volume"),
        _ if contains(first, b"<VTKFile") => Some("a VTK XML file (VTI)"),
        _ if is_text(first) && first.trim_ascii_start().starts_with(b"<") => Some("an XML or HTML file"),
        _ if is_text(first) => Some("a text file"),
        _ => None,
    }
}

fn is_text(first: &[u8]) -> bool {
    first.iter().all(|&byte| byte >= 0x20 || byte.is_ascii_whitespace()) && first.is_ascii()
}

fn contains(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}
