//! Voxels in files: where they lie, how they are encoded, and the reader that streams them.
//!
//! A format says with [`StoredVoxels`] what its header says; everything after that is the same for all of them.

mod counted_file;
mod part;
mod steps;
mod stream;
mod swap;
mod text;

use glassbrick_volume::{Endian, FlatPiece, FlatPlacement, ReadError, VolumeDesc, VolumeReader};

use crate::FormatError;
pub(crate) use part::{Encoding, Part, Start, equal_parts};
pub(crate) use steps::Steps;
use stream::PartStream;
use swap::swap_bytes;

/// Where a volume's voxels lie and how.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct StoredVoxels {
    /// Files or stretches of them; their voxels follow each other.
    pub parts: Vec<Part>,
    pub encoding: Encoding,
    pub endian: Endian,
    /// Which of the volumes that lie in there is meant.
    pub steps: Steps,
}

/// A volume in files as a stream of slices.
pub(crate) struct VoxelReader {
    format: &'static str,
    desc: VolumeDesc,
    notes: Vec<String>,
    placement: Option<FlatPlacement>,
    stream: PartStream,
    steps: Steps,
    /// Bytes of voxels read so far, between the steps too.
    position: u64,
    slices_left: u64,
    swapped: bool,
}

impl VoxelReader {
    /// A reader of the volume, once its files are found long enough for it. The parts must hold all steps.
    pub fn open(
        format: &'static str,
        desc: VolumeDesc,
        voxels: StoredVoxels,
        notes: Vec<String>,
    ) -> Result<Box<dyn VolumeReader>, FormatError> {
        let StoredVoxels { mut parts, encoding, endian, mut steps } = voxels;
        for part in &mut parts {
            part.settle(encoding, desc.stored_type)?;
        }
        let claimed = parts.iter().try_fold(0, |sum: u64, part| sum.checked_add(part.bytes));
        assert_eq!(claimed, desc.bytes().checked_mul(steps.count), "parts are made for all steps");
        let mut placement = None;
        if encoding == Encoding::Raw && steps.follow_each_other(desc.bytes()) {
            let start = steps.index * desc.bytes();
            parts = part::window(parts, start, start + desc.bytes());
            steps = Steps::single(desc.bytes());
            placement = flat_placement(&parts, desc.slice_bytes(), endian);
        }
        let swapped = endian != Endian::NATIVE && encoding != Encoding::Text && desc.stored_type.bytes() > 1;
        Ok(Box::new(Self {
            format,
            slices_left: u64::from(desc.extent.z),
            stream: PartStream::new(parts, encoding, desc.stored_type),
            desc,
            notes,
            placement,
            steps,
            position: 0,
            swapped,
        }))
    }

    /// Fills `out` with the next voxels of the chosen step, and passes over those of the others.
    fn read_step(&mut self, out: &mut [u8]) -> Result<(), FormatError> {
        let mut filled = 0;
        while filled < out.len() {
            let (stretch, wanted) = self.steps.stretch(self.position);
            let buffer = self.stream.buffer()?;
            let mut taken = usize::try_from(stretch).unwrap_or(usize::MAX).min(buffer.len());
            if wanted {
                taken = taken.min(out.len() - filled);
                out[filled..filled + taken].copy_from_slice(&buffer[..taken]);
                filled += taken;
            }
            self.stream.consume(taken);
            self.position += taken as u64;
        }
        Ok(())
    }
}

/// The pieces of uncompressed voxels, if each file holds whole slices.
fn flat_placement(parts: &[Part], slice_bytes: u64, endian: Endian) -> Option<FlatPlacement> {
    let piece = |part: &Part| {
        let whole = part.bytes.is_multiple_of(slice_bytes);
        whole.then(|| FlatPiece {
            path: part.path.clone(),
            offset_bytes: part.offset_bytes(),
            slices: (part.bytes / slice_bytes) as u32,
        })
    };
    Some(FlatPlacement { pieces: parts.iter().map(piece).collect::<Option<_>>()?, endian })
}

impl VolumeReader for VoxelReader {
    fn desc(&self) -> &VolumeDesc {
        &self.desc
    }

    fn format(&self) -> &'static str {
        self.format
    }

    fn notes(&self) -> &[String] {
        &self.notes
    }

    fn flat_placement(&self) -> Option<&FlatPlacement> {
        self.placement.as_ref()
    }

    fn read_slices(&mut self, out: &mut [u8]) -> Result<(), ReadError> {
        let slice_bytes = self.desc.slice_bytes();
        let (slices, rest) = (out.len() as u64 / slice_bytes, out.len() as u64 % slice_bytes);
        if rest != 0 || slices > self.slices_left {
            return Err(format!(
                "asked for {} bytes, which are not whole slices of {slice_bytes} bytes within the {} that remain",
                out.len(),
                self.slices_left
            )
            .into());
        }
        self.read_step(out)?;
        self.slices_left -= slices;
        if self.slices_left == 0 {
            self.stream.check_end()?;
        }
        if self.swapped {
            swap_bytes(out, self.desc.stored_type.bytes());
        }
        Ok(())
    }

    fn bytes_read(&self) -> u64 {
        self.stream.bytes_read()
    }
}
