//! Raw voxels, of which everything must be said by the user; gzip and bzip2 are seen through.

use std::path::Path;

use glam::{DMat3, DVec3, UVec3};
use glassbrick_volume::{Endian, Rescale, StoredType, VolumeDesc, VolumeReader};

use crate::geometry::{Grid, checked_extent};
use crate::voxels::{Encoding, Part, Start, Steps, StoredVoxels, VoxelReader};
use crate::{FormatError, OpenOptions};

/// What a raw file does not say of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct RawLayout {
    /// Voxels along x (fastest in the file), y and z.
    pub extent: UVec3,
    pub stored_type: StoredType,
    pub endian: Endian,
    /// Distance of neighbouring voxel centres, in mm; positive.
    pub spacing_mm: DVec3,
    /// Bytes before the first voxel, in a compressed file after decompression.
    pub offset_bytes: u64,
    pub rescale: Rescale,
}

/// Opens a raw file of this layout.
pub(crate) fn open(
    path: &Path,
    layout: &RawLayout,
    options: &OpenOptions,
) -> Result<Box<dyn VolumeReader>, FormatError> {
    let malformed = |what| FormatError::malformed(path, what);
    let extent = checked_extent(layout.extent.as_u64vec3().to_array()).map_err(malformed)?;
    if layout.spacing_mm.min_element() <= 0.0 {
        return Err(FormatError::unsupported(path, "--spacing must be three positive lengths in mm"));
    }
    if layout.rescale.slope == 0.0
        || !layout.rescale.slope.is_finite()
        || !layout.rescale.intercept.is_finite()
    {
        return Err(FormatError::unsupported(
            path,
            "--rescale needs a slope that is not zero and finite numbers",
        ));
    }
    let grid = Grid::from_columns(DMat3::from_diagonal(layout.spacing_mm), DVec3::ZERO).map_err(malformed)?;
    let desc = VolumeDesc {
        extent,
        stored_type: layout.stored_type,
        spacing_mm: grid.spacing_mm,
        origin_mm: grid.origin_mm,
        direction: grid.direction,
        rescale: layout.rescale,
    };

    let file_bytes = path.metadata().map_err(|error| FormatError::io(path, error))?.len();
    let encoding = encoding(path, &crate::detect::first_bytes(path)?);
    let mut notes = Vec::new();
    let (start, skip_decoded) = match encoding {
        Encoding::Raw => (layout.offset_bytes, 0),
        _ => (0, layout.offset_bytes),
    };
    let needed = layout.offset_bytes.saturating_add(desc.bytes());
    if encoding == Encoding::Raw && file_bytes < needed {
        return Err(malformed(format!(
            "{extent_name} voxels of {type_name} from byte {offset} on need {needed} bytes, but the file has \
             {file_bytes}; check --extent, --dtype and --offset",
            extent_name = extent.to_array().map(|size| size.to_string()).join("x"),
            type_name = layout.stored_type,
            offset = layout.offset_bytes,
        )));
    }
    let follow = file_bytes.saturating_sub(needed);
    if encoding == Encoding::Raw && follow > 0 {
        notes.push(format!(
            "{follow} bytes follow the voxels; check --extent, --dtype and --offset if that is odd"
        ));
    }
    if let Some(name) = crate::detect::detect(path)?.format_name() {
        notes.push(format!("the file looks like {name}, but is read as raw voxels, as asked for"));
    }
    let steps = Steps::choose(path, 1, desc.bytes(), options.time, &mut notes)?;
    let parts =
        vec![Part { path: path.to_owned(), start: Start::At(start), skip_decoded, bytes: desc.bytes() }];
    VoxelReader::open("raw", desc, StoredVoxels { parts, encoding, endian: layout.endian, steps }, notes)
}

/// Voxels may happen to look like a compressed file; only with its extension it is taken for one.
fn encoding(path: &Path, first: &[u8]) -> Encoding {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or("");
    match first {
        [0x1f, 0x8b, ..] if extension.eq_ignore_ascii_case("gz") => Encoding::Deflate,
        [b'B', b'Z', b'h', ..] if extension.eq_ignore_ascii_case("bz2") => Encoding::Bzip2,
        _ => Encoding::Raw,
    }
}
