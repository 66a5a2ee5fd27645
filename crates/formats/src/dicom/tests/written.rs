//! Small DICOM files in a folder that goes when the test ends.

use std::path::{Path, PathBuf};

use dicom_core::value::{DataSetSequence, PixelFragmentSequence};
use dicom_core::{DataElement, Length, PrimitiveValue, VR};
use dicom_object::{FileMetaTableBuilder, InMemDicomObject};
use glassbrick_volume::VolumeReader;
use tempfile::TempDir;

use super::super::open_path;
use super::super::tag::{self, Tag};
use crate::{FormatError, OpenOptions};

pub(super) const IMPLICIT: &str = "1.2.840.10008.1.2";
pub(super) const EXPLICIT: &str = "1.2.840.10008.1.2.1";
pub(super) const DEFLATED: &str = "1.2.840.10008.1.2.1.99";
pub(super) const BIG_ENDIAN: &str = "1.2.840.10008.1.2.2";
pub(super) const RLE: &str = "1.2.840.10008.1.2.5";
pub(super) const JPEG_BASELINE: &str = "1.2.840.10008.1.2.4.50";
pub(super) const JPEG_LOSSLESS: &str = "1.2.840.10008.1.2.4.70";
pub(super) const JPEG_LS: &str = "1.2.840.10008.1.2.4.80";
pub(super) const JPEG_2000: &str = "1.2.840.10008.1.2.4.90";
pub(super) const HIGH_THROUGHPUT: &str = "1.2.840.10008.1.2.4.201";

/// Columns and rows of every frame that is written here.
pub(super) const COLUMNS: usize = 4;
pub(super) const ROWS: usize = 3;
pub(super) const VOXELS: usize = COLUMNS * ROWS;

/// A data set in the making.
#[derive(Clone)]
pub(super) struct Written(pub InMemDicomObject);

impl Written {
    /// An axial slice of 4×3 signed 16-bit voxels at this height, each of which is `level`.
    pub(super) fn slice(z_mm: f64, level: i16) -> Self {
        let written = Self(InMemDicomObject::new_empty())
            .set(tag::SOP_CLASS_UID, "1.2.840.10008.5.1.4.1.1.2")
            .set(tag::SOP_INSTANCE_UID, format!("1.2.3.{}.{level}", (z_mm * 1000.0) as i64))
            .set(tag::SERIES_INSTANCE_UID, "1.2.3.4")
            .set(tag::SERIES_NUMBER, "7")
            .set(tag::SERIES_DESCRIPTION, "Head")
            .set(tag::INSTANCE_NUMBER, format!("{level}"))
            .set(tag::IMAGE_ORIENTATION_PATIENT, r"1\0\0\0\1\0")
            .set(tag::PIXEL_SPACING, r"0.5\0.25")
            .set(tag::RESCALE_SLOPE, "2")
            .set(tag::RESCALE_INTERCEPT, "-1024")
            .set(tag::SAMPLES_PER_PIXEL, 1_u16)
            .set(tag::PHOTOMETRIC_INTERPRETATION, "MONOCHROME2")
            .set(tag::ROWS, ROWS as u16)
            .set(tag::COLUMNS, COLUMNS as u16)
            .bits(16, 16, true);
        written.at(10.0, 20.0, z_mm).voxels16(&[level as u16; VOXELS])
    }

    pub(super) fn at(self, x_mm: f64, y_mm: f64, z_mm: f64) -> Self {
        self.set(tag::IMAGE_POSITION_PATIENT, format!(r"{x_mm}\{y_mm}\{z_mm}"))
    }

    pub(super) fn bits(self, allocated: u16, stored: u16, signed: bool) -> Self {
        self.set(tag::BITS_ALLOCATED, allocated)
            .set(tag::BITS_STORED, stored)
            .set(tag::HIGH_BIT, stored - 1)
            .set(tag::PIXEL_REPRESENTATION, u16::from(signed))
    }

    pub(super) fn set(mut self, tag: Tag, value: impl Into<PrimitiveValue>) -> Self {
        let vr = tag::kept_vr(tag).and_then(VR::from_binary).expect("a tag that is kept");
        self.0.put(DataElement::new(name(tag), vr, value.into()));
        self
    }

    pub(super) fn sequence(mut self, tag: Tag, items: Vec<InMemDicomObject>) -> Self {
        let items = DataSetSequence::new(items, Length::UNDEFINED);
        self.0.put(DataElement::new(name(tag), VR::SQ, items));
        self
    }

    pub(super) fn without(mut self, tag: Tag) -> Self {
        self.0.remove_element(name(tag));
        self
    }

    pub(super) fn voxels16(self, voxels: &[u16]) -> Self {
        self.set(tag::PIXEL_DATA, PrimitiveValue::U16(voxels.into()))
    }

    pub(super) fn fragments(mut self, offsets: &[u32], fragments: &[&[u8]]) -> Self {
        let fragments: Vec<Vec<u8>> = fragments.iter().map(|fragment| fragment.to_vec()).collect();
        let fragments = PixelFragmentSequence::new(offsets.to_vec(), fragments);
        self.0.put(DataElement::new(name(tag::PIXEL_DATA), VR::OB, fragments));
        self
    }
}

fn name(tag: Tag) -> dicom_core::Tag {
    dicom_core::Tag(tag.0, tag.1)
}

/// A folder of DICOM files.
pub(super) struct Folder(pub TempDir);

impl Folder {
    pub(super) fn new() -> Self {
        Self(TempDir::new().expect("a temporary folder"))
    }

    /// A folder with slices of level 0, 1, 2 … at these heights.
    pub(super) fn of_slices(heights_mm: &[f64]) -> Self {
        let folder = Self::new();
        for (level, height) in heights_mm.iter().enumerate() {
            folder.write(&format!("{level}.dcm"), Written::slice(*height, level as i16));
        }
        folder
    }

    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(super) fn write(&self, name: &str, written: Written) -> PathBuf {
        self.write_as(EXPLICIT, name, written)
    }

    pub(super) fn write_as(&self, transfer_syntax: &str, name: &str, written: Written) -> PathBuf {
        let path = self.path().join(name);
        let meta = FileMetaTableBuilder::new()
            .transfer_syntax(transfer_syntax)
            .media_storage_sop_class_uid("1.2.840.10008.5.1.4.1.1.2")
            .media_storage_sop_instance_uid("1.2.3.5");
        let object = written.0.with_meta(meta).expect("whole file meta information");
        object.write_to_file(&path).expect("a writable folder");
        path
    }

    pub(super) fn open(&self) -> Box<dyn VolumeReader> {
        self.open_at(None).expect("a sound folder")
    }

    pub(super) fn open_at(&self, time: Option<u32>) -> Result<Box<dyn VolumeReader>, FormatError> {
        try_open(self.path(), time).map(|reader| reader.expect("a folder with DICOM files"))
    }

    /// The one line that says why the folder is refused.
    pub(super) fn refusal(&self) -> String {
        let line = self.open_at(None).err().expect("a folder that is refused").to_string();
        assert!(!line.contains('\n'), "{line}");
        line
    }
}

pub(super) fn try_open(path: &Path, time: Option<u32>) -> Result<Option<Box<dyn VolumeReader>>, FormatError> {
    open_path(path, &OpenOptions { time, ..OpenOptions::default() })
}

/// All voxels of a volume of signed 16-bit voxels.
pub(super) fn voxels(mut reader: Box<dyn VolumeReader>) -> Vec<i16> {
    bytes(reader.as_mut()).as_chunks().0.iter().map(|&voxel| i16::from_ne_bytes(voxel)).collect()
}

/// All voxels of a volume, as stored.
pub(super) fn bytes(reader: &mut dyn VolumeReader) -> Vec<u8> {
    let mut out = vec![0; reader.desc().bytes() as usize];
    reader.read_slices(&mut out).expect("sound frames");
    out
}

/// The first voxel of each slice of a volume of signed 16-bit voxels.
pub(super) fn levels(reader: Box<dyn VolumeReader>) -> Vec<i16> {
    voxels(reader).into_iter().step_by(VOXELS).collect()
}

pub(super) fn has_note(reader: &dyn VolumeReader, part: &str) -> bool {
    reader.notes().iter().any(|note| note.contains(part))
}
