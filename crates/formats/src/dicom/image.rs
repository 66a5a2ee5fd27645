//! What the header of one DICOM file says of its voxels.

use std::path::{Path, PathBuf};

use super::byte_stream::Parsed;
use super::data_set::DataSet;
use super::data_set_reader::PixelElement;
use super::frame_info::{FrameInfo, read_frames};
use super::pixel_format::PixelFormat;
use super::tag;
use super::transfer_syntax::{FrameCoding, TransferSyntax};

/// More frames than any real file has.
const MAX_FRAMES: u32 = 65_536;

/// A file with scalar frames.
#[derive(Clone, Debug)]
pub(super) struct Image {
    pub path: PathBuf,
    pub file_bytes: u64,
    pub series: Series,
    pub sop_instance_uid: String,
    pub transfer_syntax: TransferSyntax,
    pub columns: u32,
    pub rows: u32,
    pub format: PixelFormat,
    pub pixels: PixelElement,
    pub frames: Vec<FrameInfo>,
    /// Where encapsulated frames start after the first fragment's item, if the file says it for each.
    pub extended_offsets: Vec<u64>,
    /// Whether it is a scout, made to plan the scan.
    pub is_localizer: bool,
    pub notes: Vec<&'static str>,
    /// Why its voxels cannot be read, although the header can.
    pub damage: Option<String>,
}

/// The series that a file belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Series {
    pub uid: String,
    pub number: String,
    pub description: String,
}

impl Image {
    /// Reads the header. The error says why this image is none that can be part of a volume.
    pub(super) fn read(
        path: &Path,
        file_bytes: u64,
        transfer_syntax: TransferSyntax,
        root: &DataSet,
        pixels: PixelElement,
    ) -> Parsed<Self> {
        check_scalar(root)?;
        let size = |tag| root.whole(tag).filter(|size| (1..=0xFFFF).contains(size));
        let columns = size(tag::COLUMNS).ok_or("has no Columns, or 0")?;
        let rows = size(tag::ROWS).ok_or("has no Rows, or 0")?;
        let count = root.whole(tag::NUMBER_OF_FRAMES).unwrap_or(1).max(1);
        if count > MAX_FRAMES {
            return Err(format!("claims {count} frames; {MAX_FRAMES} are the most that are read"));
        }
        let mut image = Self {
            path: path.to_owned(),
            file_bytes,
            series: Series::read(root),
            sop_instance_uid: root.text(tag::SOP_INSTANCE_UID).unwrap_or_default().to_owned(),
            columns,
            rows,
            format: PixelFormat::read(root, &pixels)?,
            pixels,
            frames: Vec::new(),
            extended_offsets: Vec::new(),
            is_localizer: image_type(root).any(|part| part == "LOCALIZER"),
            notes: Vec::new(),
            damage: None,
            transfer_syntax,
        };
        image.damage = image.check_length(count).err();
        let frames_there = if image.damage.is_some() { 1 } else { count as usize };
        image.frames = read_frames(root, frames_there, &mut image.notes);
        if let Some(offsets) = root.numbers(tag::EXTENDED_OFFSET_TABLE) {
            image.extended_offsets = offsets.into_iter().map(|offset| offset as u64).collect();
        }
        if root.text(tag::PHOTOMETRIC_INTERPRETATION) == Some("MONOCHROME1") {
            image.notes.push("the images are MONOCHROME1: their largest values are meant to be shown black");
        }
        Ok(image)
    }

    /// Size of one decoded frame.
    pub(super) fn frame_bytes(&self) -> u64 {
        u64::from(self.columns) * u64::from(self.rows) * self.format.stored_type.bytes() as u64
    }

    /// Whether the frames stand in the file as they are.
    pub(super) fn is_plain(&self) -> bool {
        self.transfer_syntax.coding == FrameCoding::Native && !self.transfer_syntax.deflated
    }

    /// Holds the size that the header claims against what the file has.
    fn check_length(&self, frames: u32) -> Parsed<()> {
        let claimed = self.frame_bytes() * u64::from(frames);
        let held = match (self.transfer_syntax.coding, self.pixels.bytes) {
            (FrameCoding::Native, Some(bytes)) => u64::from(bytes),
            (FrameCoding::Native, None) => {
                return Err("has compressed frames, against its transfer syntax".to_owned());
            }
            (FrameCoding::Unknown(_), _) | (_, None) => return Ok(()),
            (_, Some(_)) => return Err("has no fragments, against its transfer syntax".to_owned()),
        };
        if held < claimed {
            return Err(format!(
                "claims {frames} frames of {}×{} voxels, {claimed} bytes, but its PixelData has {held}",
                self.columns, self.rows
            ));
        }
        // Deflate shrinks no run of bytes to less than 1 in 1032.
        let most = if self.transfer_syntax.deflated {
            self.file_bytes.saturating_mul(1032)
        } else {
            self.file_bytes.saturating_sub(self.pixels.offset)
        };
        if most < claimed {
            return Err(format!(
                "is cut off: its voxels take {claimed} bytes, of which {most} are there; fetch it again"
            ));
        }
        Ok(())
    }
}

impl Series {
    fn read(root: &DataSet) -> Self {
        let short = |tag| root.text(tag).unwrap_or_default().chars().take(40).collect::<String>();
        Self {
            uid: root.text(tag::SERIES_INSTANCE_UID).unwrap_or_default().to_owned(),
            number: short(tag::SERIES_NUMBER).escape_debug().to_string(),
            description: short(tag::SERIES_DESCRIPTION).escape_debug().to_string(),
        }
    }
}

fn image_type(root: &DataSet) -> impl Iterator<Item = &str> {
    root.text(tag::IMAGE_TYPE).unwrap_or_default().split('\\').map(str::trim)
}

/// Refuses colours and tiles: what has not one value at each voxel of a slice.
fn check_scalar(root: &DataSet) -> Parsed<()> {
    let samples = root.whole(tag::SAMPLES_PER_PIXEL).unwrap_or(1);
    let photometric = root.text(tag::PHOTOMETRIC_INTERPRETATION).unwrap_or("MONOCHROME2");
    if samples != 1 || photometric == "PALETTE COLOR" {
        let photometric = photometric.escape_debug();
        return Err(format!(
            "has {samples} samples per pixel, {photometric}; one grey value for each is read"
        ));
    }
    if image_type(root).any(|part| part == "MOSAIC") {
        return Err(
            "is a mosaic of many slices in one image; take it apart first, with dcm2niix say".to_owned()
        );
    }
    Ok(())
}
