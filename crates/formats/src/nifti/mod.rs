//! NIfTI-1 and NIfTI-2, as one file or as a pair `.hdr` and `.img`, plain or gzip-compressed.

mod grid;
mod header;
mod pair;
#[cfg(test)]
mod tests;

use std::path::Path;

use glassbrick_volume::{Rescale, StoredType, VolumeDesc, VolumeReader};

use self::header::Header;
pub(crate) use self::header::{is_analyze, is_nifti};
pub(crate) use self::pair::header_beside;
use crate::geometry::checked_extent;
use crate::voxels::{Encoding, Part, Start, Steps, StoredVoxels, VoxelReader};
use crate::{FormatError, OpenOptions};

/// Opens a file that starts with a NIfTI header. `first` are its first bytes, decompressed.
pub(crate) fn open(
    path: &Path,
    first: &[u8],
    options: &OpenOptions,
) -> Result<Box<dyn VolumeReader>, FormatError> {
    let malformed = |what: String| FormatError::malformed(path, what);
    let header = Header::parse(first).map_err(malformed)?;
    let mut notes = Vec::new();
    let stored_type = stored_type(header.datatype).map_err(|what| FormatError::unsupported(path, what))?;
    let sizes = header.sizes().map_err(malformed)?;
    let extent = checked_extent([sizes[0], sizes[1], sizes[2]]).map_err(malformed)?;
    if let Some(kind) = components(header.intent_code).filter(|_| sizes[4..].iter().any(|&size| size > 1)) {
        let what = format!("each voxel is {kind}; only scalar volumes are read, save one component");
        return Err(FormatError::unsupported(path, what));
    }
    let grid = grid::read(&header, &sizes, &mut notes).map_err(malformed)?;
    let desc = VolumeDesc {
        extent,
        stored_type,
        spacing_mm: grid.spacing_mm,
        origin_mm: grid.origin_mm,
        direction: grid.direction,
        rescale: rescale(&header).map_err(malformed)?,
    };

    let count = sizes[3..].iter().fold(1, |product: u64, &size| product.saturating_mul(size));
    let steps = Steps::choose(path, count, desc.bytes(), options.time, &mut notes)?;
    let bytes = desc.bytes().checked_mul(count);
    let bytes =
        bytes.ok_or_else(|| malformed("the header claims more voxels than any file has".to_owned()))?;
    let (voxel_path, offset) = match header.is_pair {
        true => (pair::voxels_beside(path)?, header.voxel_offset(0).map_err(malformed)?),
        false => {
            if header.vox_offset == 0.0 {
                notes.push(
                    "the header gives no place for the voxels; they are taken right after it".to_owned(),
                );
            }
            (path.to_owned(), header.voxel_offset(header.bytes + 4).map_err(malformed)?)
        }
    };
    let compressed = crate::detect::first_bytes(&voxel_path)?.starts_with(&[0x1f, 0x8b]);
    let (encoding, start, skip_decoded) = match compressed && pair::is_gz(&voxel_path) {
        true => (Encoding::Deflate, Start::At(0), offset),
        false => (Encoding::Raw, Start::At(offset), 0),
    };
    let parts = vec![Part { path: voxel_path, start, skip_decoded, bytes }];
    let voxels = StoredVoxels { parts, encoding, endian: header.endian, steps };
    VoxelReader::open(header.format_name(), desc, voxels, notes)
}

fn stored_type(datatype: i16) -> Result<StoredType, String> {
    let what = match datatype {
        2 => return Ok(StoredType::U8),
        4 => return Ok(StoredType::I16),
        8 => return Ok(StoredType::I32),
        16 => return Ok(StoredType::F32),
        64 => return Ok(StoredType::F64),
        256 => return Ok(StoredType::I8),
        512 => return Ok(StoredType::U16),
        768 => return Ok(StoredType::U32),
        1 => "binary",
        32 | 1792 | 2048 => "complex",
        128 => "RGB",
        2304 => "RGBA",
        1024 | 1280 => "64-bit integer",
        1536 => "128-bit float",
        _ => "unknown",
    };
    Err(format!(
        "holds {what} voxels (datatype {datatype}), which are not read; save one component as 8, 16 or 32 bit \
         integers, float or double"
    ))
}

/// What several numbers per voxel mean by the header's intent, if it says so.
fn components(intent_code: i32) -> Option<&'static str> {
    match intent_code {
        1004 | 1005 => Some("a matrix"),
        1006 => Some("a displacement"),
        1007..=1009 => Some("a vector"),
        1010 => Some("a quaternion"),
        2003 | 2004 => Some("a colour"),
        _ => None,
    }
}

/// A slope of zero, or one that is no number, says that stored values are the values.
fn rescale(header: &Header) -> Result<Rescale, String> {
    if header.scl_slope == 0.0 || !header.scl_slope.is_finite() {
        return Ok(Rescale::IDENTITY);
    }
    if !header.scl_inter.is_finite() {
        return Err(format!("scl_inter is {}; it must be a finite number", header.scl_inter));
    }
    Ok(Rescale { slope: header.scl_slope, intercept: header.scl_inter })
}
