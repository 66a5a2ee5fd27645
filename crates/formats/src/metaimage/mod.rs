//! MetaImage: a text header `.mhd` beside its voxels, or `.mha` before them.

mod data_files;
mod grid;
mod header;
#[cfg(test)]
mod tests;

use std::path::Path;

use glassbrick_volume::{Endian, Rescale, StoredType, VolumeDesc, VolumeReader};

use self::header::Header;
use crate::geometry::checked_extent;
use crate::header_text::quoted;
use crate::voxels::{Encoding, Steps, StoredVoxels, VoxelReader};
use crate::{FormatError, OpenOptions};

/// Whether a file that starts so is MetaImage: it has no magic, but `NDims = …` is in every header.
pub(crate) fn is_metaimage(first: &[u8]) -> bool {
    let mut keys = first.split(|&byte| byte == b'\n').map_while(|line| {
        let line = std::str::from_utf8(line).ok()?;
        Some(line.split_once('=')?.0.trim())
    });
    keys.any(|key| key == "NDims")
}

pub(crate) fn open(path: &Path, options: &OpenOptions) -> Result<Box<dyn VolumeReader>, FormatError> {
    let malformed = |what: String| FormatError::malformed(path, what);
    let unsupported = |what: String| FormatError::unsupported(path, what);
    let header = Header::read(path)?;
    let mut notes = Vec::new();

    let stored_type = stored_type(&header).map_err(unsupported)?;
    refuse_components(&header).map_err(unsupported)?;
    let sizes = sizes(&header).map_err(malformed)?;
    let extent = checked_extent(std::array::from_fn(|axis| sizes.get(axis).copied().unwrap_or(1)));
    let extent = extent.map_err(malformed)?;
    let grid = grid::read(&header, sizes.len(), &mut notes).map_err(malformed)?;
    let desc = VolumeDesc {
        extent,
        stored_type,
        spacing_mm: grid.spacing_mm,
        origin_mm: grid.origin_mm,
        direction: grid.direction,
        rescale: rescale(&header).map_err(malformed)?,
    };

    let encoding = encoding(&header).map_err(malformed)?;
    let endian = endian(&header, stored_type, encoding, &mut notes).map_err(malformed)?;
    let count = sizes.iter().skip(3).fold(1, |product: u64, &size| product.saturating_mul(size));
    let steps = Steps::choose(path, count, desc.bytes(), options.time, &mut notes)?;
    let total_bytes = desc.bytes().checked_mul(count);
    let total_bytes =
        total_bytes.ok_or_else(|| malformed("the header claims more voxels than any file has".to_owned()))?;
    let parts = data_files::find(path, &header, &sizes, encoding, total_bytes)?;
    VoxelReader::open("MetaImage", desc, StoredVoxels { parts, encoding, endian, steps }, notes)
}

fn stored_type(header: &Header) -> Result<StoredType, String> {
    let name = header.field("ElementType").ok_or("the field ElementType is missing")?;
    Ok(match name {
        "MET_UCHAR" | "MET_ASCII_CHAR" => StoredType::U8,
        "MET_CHAR" => StoredType::I8,
        "MET_USHORT" => StoredType::U16,
        "MET_SHORT" => StoredType::I16,
        // MetaImage's long is of 4 bytes everywhere.
        "MET_UINT" | "MET_ULONG" => StoredType::U32,
        "MET_INT" | "MET_LONG" => StoredType::I32,
        "MET_FLOAT" => StoredType::F32,
        "MET_DOUBLE" => StoredType::F64,
        _ => {
            return Err(format!(
                "voxels of type {} are not read; convert them to 8, 16 or 32 bit integers, float or double",
                quoted(name)
            ));
        }
    })
}

fn refuse_components(header: &Header) -> Result<(), String> {
    match header.number::<u64>(&["ElementNumberOfChannels", "ElementNChannels"])? {
        None | Some(1) => Ok(()),
        Some(channels) => Err(format!(
            "each voxel holds {channels} numbers (ElementNumberOfChannels); only scalar volumes are read, save one \
             component"
        )),
    }
}

fn sizes(header: &Header) -> Result<Vec<u64>, String> {
    let dimensions = header.number::<usize>(&["NDims"])?.ok_or("the field NDims is missing")?;
    if !(2..=10).contains(&dimensions) {
        return Err(format!("the field NDims is {dimensions}; volumes have 3, or 4 with time, images 2"));
    }
    header.numbers(&["DimSize"], dimensions)?.ok_or_else(|| "the field DimSize is missing".to_owned())
}

/// `ElementToIntensityFunction`, which turns stored values into values.
fn rescale(header: &Header) -> Result<Rescale, String> {
    let slope = header.number::<f64>(&["ElementToIntensityFunctionSlope"])?.unwrap_or(1.0);
    let intercept = header.number::<f64>(&["ElementToIntensityFunctionOffset"])?.unwrap_or(0.0);
    if slope == 0.0 || !slope.is_finite() || !intercept.is_finite() {
        return Err(format!(
            "ElementToIntensityFunction with slope {slope}, offset {intercept} gives no values"
        ));
    }
    Ok(Rescale { slope, intercept })
}

fn encoding(header: &Header) -> Result<Encoding, String> {
    let (binary, compressed) = (header.truth(&["BinaryData"])?, header.truth(&["CompressedData"])?);
    Ok(match (binary.unwrap_or(true), compressed.unwrap_or(false)) {
        (true, false) => Encoding::Raw,
        (true, true) => Encoding::Deflate,
        (false, false) => Encoding::Text,
        (false, true) => return Err("the voxels are said to be compressed, but not binary".to_owned()),
    })
}

fn endian(
    header: &Header,
    stored_type: StoredType,
    encoding: Encoding,
    notes: &mut Vec<String>,
) -> Result<Endian, String> {
    match header.truth(&["BinaryDataByteOrderMSB", "ElementByteOrderMSB"])? {
        Some(true) => Ok(Endian::Big),
        Some(false) => Ok(Endian::Little),
        None => {
            if stored_type.bytes() > 1 && encoding != Encoding::Text {
                notes.push("the header does not say the byte order; it is taken as little-endian".to_owned());
            }
            Ok(Endian::Little)
        }
    }
}
