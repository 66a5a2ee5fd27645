//! DICOM: a file, or the files of one series, as a volume.
//!
//! Headers are read by a parser of our own, which keeps the few elements that matter, knows at which byte the
//! voxels begin, and holds every length against the file's before it believes it. Then, each step knowing
//! only what the one before it made:
//!
//! - `probe`, `image`, `frame_info`: what one file's header says (on `byte_stream`, `element`, `data_set`,
//!   `data_set_reader`, `tag`);
//! - `gather`: the headers of a folder, or of a file's neighbours;
//! - `candidate`: which files belong together, and which of several volumes is meant;
//! - `steps`, `step_attribute`: the frames in order, and the time steps of those that share positions;
//! - `stack`: where they lie in the world, and whether evenly;
//! - `reader`, `frame_source`, `frame_codec`: the voxels (`pixel_format`, `rle`, `jpeg`, `jpeg2000`).

mod byte_stream;
mod candidate;
mod data_set;
mod data_set_reader;
mod element;
mod frame_codec;
mod frame_info;
mod frame_source;
mod gather;
mod image;
mod jpeg;
mod jpeg2000;
mod pixel_format;
mod probe;
mod reader;
mod rle;
mod stack;
mod step_attribute;
mod steps;
mod tag;
#[cfg(test)]
mod tests;
mod transfer_syntax;

use std::fs;
use std::path::Path;

use glassbrick_volume::VolumeReader;

use self::gather::{gather_folder, gather_series};
use self::reader::DicomReader;
use self::steps::Step;
use crate::{FormatError, OpenOptions};

/// Opens a DICOM file with its series, or a folder that holds one volume. Nothing where there is no DICOM at
/// all.
pub(crate) fn open_path(
    path: &Path,
    options: &OpenOptions,
) -> Result<Option<Box<dyn VolumeReader>>, FormatError> {
    let is_folder = fs::metadata(path).map_err(|source| FormatError::io(path, source))?.is_dir();
    let gathered = if is_folder { gather_folder(path)? } else { gather_series(path)? };
    let Some(gathered) = gathered else { return Ok(None) };
    let mut notes = Vec::new();
    let candidates = candidate::candidates(&gathered.images);
    let slices = if is_folder {
        candidate::only_volume(path, &gathered, candidates, &mut notes)?
    } else {
        candidate::of_first_image(candidates)
    };
    if let Some(error) = gathered.refused.first() {
        notes.push(format!(
            "files that are passed over: {}, the first because {error}",
            gathered.refused.len()
        ));
    }
    let images = gathered.images;
    if !is_folder && slices.iter().any(|slice| slice.image != 0) {
        notes.push(format!("the files of its series beside it are read with it: {} in all", slices.len()));
    }
    let steps =
        steps::steps(&images, slices, &mut notes).map_err(|what| FormatError::unsupported(path, what))?;
    let step = choose_step(path, steps, options.time, &mut notes)?;
    let desc = stack::describe(&images, &step.slices, &mut notes);
    for slice in &step.slices {
        for note in &images[slice.image].notes {
            if !notes.iter().any(|told| told == note) {
                notes.push((*note).to_owned());
            }
        }
    }
    Ok(Some(Box::new(DicomReader::new(images, step.slices, desc, notes)?)))
}

fn choose_step(
    path: &Path,
    mut steps: Vec<Step>,
    time: Option<u32>,
    notes: &mut Vec<String>,
) -> Result<Step, FormatError> {
    let wanted = time.unwrap_or(0) as usize;
    let count = steps.len();
    if wanted >= count {
        let what =
            format!("has no time step {wanted}; the last of its {count} is {}", count.saturating_sub(1));
        return Err(FormatError::unsupported(path, what));
    }
    let step = steps.swap_remove(wanted);
    if count > 1 {
        let label = if step.label.is_empty() { String::new() } else { format!(" ({})", step.label) };
        notes.push(format!("time step {wanted} of {count}{label} is read; 0 to {} can be chosen", count - 1));
    }
    Ok(step)
}
