//! The frames of a volume, decoded slice by slice.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

use glassbrick_volume::{Endian, FlatPiece, FlatPlacement, ReadError, StoredType, VolumeDesc, VolumeReader};
use rayon::prelude::*;

use super::candidate::Slice;
use super::frame_codec::{check_frame, decode_frame, read_voxels};
use super::frame_source::{Fragments, find_fragments};
use super::image::Image;
use super::transfer_syntax::FrameCoding;
use crate::FormatError;

/// Compressed volumes that claim to be this many times their files' size are refused.
const MAX_COMPRESSION: u64 = 8192;
/// Smaller volumes may be compressed to any size.
const HARMLESS_BYTES: u64 = 64 << 20;

pub(super) struct DicomReader {
    desc: VolumeDesc,
    notes: Vec<String>,
    images: Vec<Image>,
    /// The fragments of each frame of each image; none for uncompressed images.
    fragments: Vec<Vec<Fragments>>,
    slices: Vec<Slice>,
    next_slice: usize,
    placement: OnceLock<Option<FlatPlacement>>,
    bytes_read: AtomicU64,
}

impl DicomReader {
    /// A reader of these slices of `images`, once their files hold what their headers claim.
    pub(super) fn new(
        images: Vec<Image>,
        slices: Vec<Slice>,
        desc: VolumeDesc,
        notes: Vec<String>,
    ) -> Result<Self, FormatError> {
        let mut used = vec![false; images.len()];
        slices.iter().for_each(|slice| used[slice.image] = true);
        let fragments: Result<Vec<Vec<Fragments>>, FormatError> =
            images.par_iter().zip(&used).map(|(image, used)| check(image, *used)).collect();
        let reader = Self {
            desc,
            notes,
            images,
            fragments: fragments?,
            slices,
            next_slice: 0,
            placement: OnceLock::new(),
            bytes_read: AtomicU64::new(0),
        };
        reader.check_compression()?;
        reader.check_first_frame()?;
        Ok(reader)
    }

    /// Refuses a volume that is far larger than its compressed frames can be.
    fn check_compression(&self) -> Result<(), FormatError> {
        let first = &self.images[self.slices[0].image];
        if matches!(first.transfer_syntax.coding, FrameCoding::Native) || self.desc.bytes() <= HARMLESS_BYTES
        {
            return Ok(());
        }
        let fragments =
            self.slices.iter().filter_map(|slice| self.fragments[slice.image].get(slice.frame)).flatten();
        let encoded: u64 = fragments.map(|(_, bytes)| u64::from(*bytes)).sum();
        if encoded.saturating_mul(MAX_COMPRESSION) < self.desc.bytes() {
            let what = format!(
                "claims {} bytes of voxels in {encoded} bytes of compressed frames",
                self.desc.bytes()
            );
            return Err(FormatError::malformed(&first.path, what));
        }
        Ok(())
    }

    /// Refuses a volume whose first slice is coded in a way that is not decoded.
    fn check_first_frame(&self) -> Result<(), FormatError> {
        let first = self.slices[0];
        let image = &self.images[first.image];
        let checked = self.fragments[first.image]
            .get(first.frame)
            .map_or(Ok(()), |fragments| check_frame(image, fragments));
        checked.map_err(|what| FormatError::malformed(&image.path, what))
    }

    fn read_slice(&self, slice: Slice, out: &mut [u8]) -> Result<(), ReadError> {
        let image = &self.images[slice.image];
        let none = Fragments::new();
        let fragments = self.fragments[slice.image].get(slice.frame).unwrap_or(&none);
        let failure = |what| FormatError::malformed(&image.path, what);
        if self.desc.stored_type == image.format.stored_type {
            let bytes_read = decode_frame(image, slice.frame, fragments, out).map_err(failure)?;
            self.bytes_read.fetch_add(bytes_read, Ordering::Relaxed);
            return Ok(());
        }
        // The slices differ in what their stored values mean, so values are given in their place.
        let mut stored = vec![0; image.frame_bytes() as usize];
        let bytes_read = decode_frame(image, slice.frame, fragments, &mut stored).map_err(failure)?;
        self.bytes_read.fetch_add(bytes_read, Ordering::Relaxed);
        let rescale = slice.info(&self.images).rescale;
        let values = image.format.numbers(&stored).into_iter().map(|stored| rescale.value(stored) as f32);
        out.as_chunks_mut().0.iter_mut().zip(values).for_each(|(voxel, value)| *voxel = value.to_ne_bytes());
        Ok(())
    }

    fn find_placement(&self) -> Option<FlatPlacement> {
        let first = &self.images[self.slices[0].image];
        let endian = |image: &Image| {
            let big = image.transfer_syntax.encoding.big_endian && image.format.stored_type.bytes() > 1;
            if big { Endian::Big } else { Endian::Little }
        };
        let placed = |image: &Image| {
            let swapped = image.transfer_syntax.encoding.big_endian && image.pixels.words;
            image.is_plain()
                && endian(image) == endian(first)
                && image.format.stored_type == self.desc.stored_type
                && (image.format.stored_type.bytes() > 1 || !swapped)
        };
        let flat = self.slices.iter().all(|slice| placed(&self.images[slice.image]));
        if !flat || !self.slices.par_iter().all(|slice| self.holds_stored_values(*slice)) {
            return None;
        }
        let mut pieces: Vec<FlatPiece> = Vec::new();
        for slice in &self.slices {
            let image = &self.images[slice.image];
            let offset_bytes = image.pixels.offset + image.frame_bytes() * slice.frame as u64;
            match pieces.last_mut() {
                Some(piece)
                    if piece.path == image.path
                        && piece.offset_bytes + u64::from(piece.slices) * image.frame_bytes()
                            == offset_bytes =>
                {
                    piece.slices += 1;
                }
                _ => pieces.push(FlatPiece { path: image.path.clone(), offset_bytes, slices: 1 }),
            }
        }
        Some(FlatPlacement { pieces, endian: endian(first) })
    }

    /// Whether the voxels in the file are the stored values: the bits beside them hold nothing but their
    /// sign.
    fn holds_stored_values(&self, slice: Slice) -> bool {
        let image = &self.images[slice.image];
        if image.format.uses_all_bits() {
            return true;
        }
        let mut voxels = vec![0; image.frame_bytes() as usize];
        if read_voxels(image, slice.frame, &mut voxels).is_err() {
            return false;
        }
        let mut stored = voxels.clone();
        image.format.extract(image.format.bits, &mut stored);
        stored == voxels
    }
}

/// Refuses an image that cannot be read, and finds the fragments of its frames.
fn check(image: &Image, used: bool) -> Result<Vec<Fragments>, FormatError> {
    if !used {
        return Ok(Vec::new());
    }
    if let Some(damage) = &image.damage {
        return Err(FormatError::malformed(&image.path, damage.clone()));
    }
    match image.transfer_syntax.coding {
        FrameCoding::Native => return Ok(Vec::new()),
        FrameCoding::Unknown(name) => {
            let what = format!(
                "is compressed with {name} (transfer syntax {}), which is not decoded here; decompress it first, \
                 with gdcmconv say",
                image.transfer_syntax.uid.escape_debug()
            );
            return Err(FormatError::unsupported(&image.path, what));
        }
        _ => {}
    }
    if matches!(image.format.stored_type, StoredType::F32 | StoredType::F64) {
        return Err(FormatError::unsupported(&image.path, "has compressed frames of floating-point voxels"));
    }
    find_fragments(image).map_err(|what| FormatError::malformed(&image.path, what))
}

impl VolumeReader for DicomReader {
    fn desc(&self) -> &VolumeDesc {
        &self.desc
    }

    fn format(&self) -> &'static str {
        "DICOM"
    }

    fn notes(&self) -> &[String] {
        &self.notes
    }

    fn flat_placement(&self) -> Option<&FlatPlacement> {
        self.placement.get_or_init(|| self.find_placement()).as_ref()
    }

    fn read_slices(&mut self, out: &mut [u8]) -> Result<(), ReadError> {
        let slice_bytes = self.desc.slice_bytes() as usize;
        let count = out.len() / slice_bytes;
        if count * slice_bytes != out.len() {
            return Err(format!("{} bytes are no whole number of slices of {slice_bytes}", out.len()).into());
        }
        let Some(slices) = self.slices.get(self.next_slice..self.next_slice + count) else {
            return Err(format!("there are {} slices; more were asked for", self.slices.len()).into());
        };
        out.par_chunks_exact_mut(slice_bytes)
            .zip(slices)
            .try_for_each(|(out, slice)| self.read_slice(*slice, out))?;
        self.next_slice += count;
        Ok(())
    }

    fn bytes_read(&self) -> u64 {
        self.bytes_read.load(Ordering::Relaxed)
    }
}
