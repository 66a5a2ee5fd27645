//! NRRD 1 to 5, attached and detached.

mod axes;
mod data_files;
mod grid;
mod header;
#[cfg(test)]
mod tests;

use std::path::Path;

use glassbrick_volume::{Endian, Rescale, StoredType, VolumeDesc, VolumeReader};

use self::axes::Axes;
use self::header::Header;
use crate::geometry::checked_extent;
use crate::header_text::quoted;
use crate::voxels::{Encoding, Steps, StoredVoxels, VoxelReader};
use crate::{FormatError, OpenOptions};

/// Whether a file that starts so is NRRD.
pub(crate) fn is_nrrd(first: &[u8]) -> bool {
    first.starts_with(b"NRRD")
}

pub(crate) fn open(path: &Path, options: &OpenOptions) -> Result<Box<dyn VolumeReader>, FormatError> {
    let malformed = |what: String| FormatError::malformed(path, what);
    let header = Header::read(path)?;
    let stored_type = stored_type(&header).map_err(|what| FormatError::unsupported(path, what))?;
    let encoding = encoding(&header).map_err(|what| FormatError::unsupported(path, what))?;
    let endian = endian(&header, stored_type, encoding).map_err(malformed)?;

    let mut notes = Vec::new();
    let axes = Axes::read(&header, &mut notes).map_err(|what| FormatError::unsupported(path, what))?;
    let extent = checked_extent(axes.spatial_sizes()).map_err(malformed)?;
    let grid = grid::read(&header, &axes, &mut notes).map_err(malformed)?;
    let desc = VolumeDesc {
        extent,
        stored_type,
        spacing_mm: grid.spacing_mm,
        origin_mm: grid.origin_mm,
        direction: grid.direction,
        rescale: Rescale::IDENTITY,
    };

    let too_large = || malformed("the header claims more voxels than any file has".to_owned());
    let run_bytes = axes.run_voxels().checked_mul(stored_type.bytes() as u64).ok_or_else(too_large)?;
    let steps = Steps::choose(path, axes.steps(), run_bytes, options.time, &mut notes)?;
    let total_bytes = desc.bytes().checked_mul(steps.count).ok_or_else(too_large)?;
    let parts = data_files::find(path, &header, encoding, total_bytes)?;
    VoxelReader::open("NRRD", desc, StoredVoxels { parts, encoding, endian, steps }, notes)
}

fn stored_type(header: &Header) -> Result<StoredType, String> {
    let name = header.field("type").ok_or("the field \"type\" is missing")?;
    Ok(match name.to_ascii_lowercase().split_whitespace().collect::<Vec<_>>().join(" ").as_str() {
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => StoredType::U8,
        "signed char" | "int8" | "int8_t" => StoredType::I8,
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => StoredType::U16,
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => StoredType::I16,
        "uint" | "unsigned int" | "uint32" | "uint32_t" => StoredType::U32,
        "int" | "signed int" | "int32" | "int32_t" => StoredType::I32,
        "float" => StoredType::F32,
        "double" => StoredType::F64,
        _ => {
            return Err(format!(
                "voxels of type {} are not read; convert them to 8, 16 or 32 bit integers, float or double",
                quoted(name)
            ));
        }
    })
}

fn encoding(header: &Header) -> Result<Encoding, String> {
    let name = header.field("encoding").ok_or("the field \"encoding\" is missing")?;
    Ok(match name.to_ascii_lowercase().as_str() {
        "raw" => Encoding::Raw,
        "gz" | "gzip" => Encoding::Deflate,
        "bz2" | "bzip2" => Encoding::Bzip2,
        "txt" | "text" | "ascii" => Encoding::Text,
        "hex" => Encoding::Hex,
        _ => return Err(format!("encoding {} is not read; save it as raw or gzip", quoted(name))),
    })
}

fn endian(header: &Header, stored_type: StoredType, encoding: Encoding) -> Result<Endian, String> {
    match header.field("endian").map(str::to_ascii_lowercase).as_deref() {
        Some("little") => Ok(Endian::Little),
        Some("big") => Ok(Endian::Big),
        Some(other) => Err(format!("the field \"endian\" is {}; it must be little or big", quoted(other))),
        None if stored_type.bytes() == 1 || encoding == Encoding::Text => Ok(Endian::NATIVE),
        None => Err(format!(
            "the field \"endian\" is missing, so the byte order of {stored_type} voxels is not known; add \
             \"endian: little\" or \"endian: big\" to the header"
        )),
    }
}
