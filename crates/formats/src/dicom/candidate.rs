//! Which frames belong to one volume, and which of several volumes is meant.

use std::collections::HashMap;
use std::path::Path;

use super::frame_info::{FrameInfo, Orientation};
use super::gather::Gathered;
use super::image::Image;
use crate::FormatError;

/// No more volumes than this are listed in a message.
const MAX_LISTED: usize = 6;

/// A frame of one of the images: their indices.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Slice {
    pub image: usize,
    pub frame: usize,
}

impl Slice {
    pub(super) fn info(self, images: &[Image]) -> &FrameInfo {
        &images[self.image].frames[self.frame]
    }
}

/// The files that may be one volume, or several time steps of one: one series and one kind of image. A
/// multi-frame file stands for itself.
pub(super) fn candidates(images: &[Image]) -> Vec<Vec<Slice>> {
    let mut candidates: Vec<Vec<Slice>> = Vec::new();
    let mut of_series: HashMap<&str, Vec<usize>> = HashMap::new();
    for (index, image) in images.iter().enumerate() {
        let slices = (0..image.frames.len()).map(|frame| Slice { image: index, frame });
        let of_series = of_series.entry(image.series.uid.as_str()).or_default();
        let joins = |candidate: &usize| {
            let first = candidates[*candidate][0];
            let other = &images[first.image];
            let single = image.frames.len() == 1 && other.frames.len() == 1;
            single && same_kind(image, other) && same_grid(&image.frames[0], first.info(images))
        };
        match of_series.iter().copied().find(joins) {
            Some(candidate) => candidates[candidate].extend(slices),
            None => {
                of_series.push(candidates.len());
                candidates.push(slices.collect());
            }
        }
    }
    candidates
}

/// Whether two images of one series can be slices of one volume.
fn same_kind(one: &Image, other: &Image) -> bool {
    (one.columns, one.rows, one.format) == (other.columns, other.rows, other.format)
        && one.is_localizer == other.is_localizer
}

/// Whether two frames can be slices of one volume: parallel, of equal spacing, and both with or without a
/// position.
pub(super) fn same_grid(one: &FrameInfo, other: &FrameInfo) -> bool {
    let near = |one: f64, other: f64| (one - other).abs() <= 1e-3 * one.max(other);
    let axes = |frame: &FrameInfo| frame.orientation.unwrap_or(Orientation::AXIAL);
    let ([one_x, one_y], [other_x, other_y]) = (one.pixel_spacing_mm, other.pixel_spacing_mm);
    one.position_mm.is_some() == other.position_mm.is_some()
        && one.orientation.is_some() == other.orientation.is_some()
        && axes(one).x.abs_diff_eq(axes(other).x, 1e-3)
        && axes(one).y.abs_diff_eq(axes(other).y, 1e-3)
        && near(one_x, other_x)
        && near(one_y, other_y)
}

/// The volume to which a named file belongs.
pub(super) fn of_first_image(candidates: Vec<Vec<Slice>>) -> Vec<Slice> {
    let is_named = |slices: &Vec<Slice>| slices.iter().any(|slice| slice.image == 0);
    candidates.into_iter().find(is_named).unwrap_or_default()
}

/// The volume that a folder holds, if it is clear which one is meant.
pub(super) fn only_volume(
    folder: &Path,
    gathered: &Gathered,
    mut candidates: Vec<Vec<Slice>>,
    notes: &mut Vec<String>,
) -> Result<Vec<Slice>, FormatError> {
    let images = &gathered.images;
    candidates.sort_by_key(|slices| std::cmp::Reverse(slices.len()));
    let is_volume = |slices: &[Slice]| slices.len() > 1;
    let is_scout = |slices: &[Slice]| images[slices[0].image].is_localizer;
    let volumes = candidates.iter().filter(|slices| is_volume(slices)).count();
    let scans = candidates.iter().filter(|slices| is_volume(slices) && !is_scout(slices)).count();
    let chosen = match (candidates.len(), volumes, scans) {
        (0, ..) => return Err(no_image(folder, gathered)),
        (1, ..) | (_, 1, _) => 0,
        (_, _, 1) => candidates.iter().position(|slices| is_volume(slices) && !is_scout(slices)).unwrap_or(0),
        _ => return Err(FormatError::unsupported(folder, ambiguity(images, &candidates))),
    };
    let slices = candidates.swap_remove(chosen);
    let left: usize = candidates.iter().map(Vec::len).sum();
    if left > 0 {
        notes.push(format!("beside the volume, scouts or single images are not read: {left}"));
    }
    if gathered.others > 0 {
        notes.push(format!("DICOM files without an image, which are not read: {}", gathered.others));
    }
    Ok(slices)
}

fn no_image(folder: &Path, gathered: &Gathered) -> FormatError {
    let files = gathered.others + gathered.refused.len();
    let what = match gathered.refused.first() {
        Some(error) => format!("none of {files} DICOM files can be read as a slice; {error}"),
        None => format!("none of {files} DICOM files holds an image; name the folder of an image series"),
    };
    FormatError::unsupported(folder, what)
}

fn ambiguity(images: &[Image], candidates: &[Vec<Slice>]) -> String {
    let volumes: Vec<&Vec<Slice>> =
        match candidates.iter().filter(|slices| slices.len() > 1).collect::<Vec<_>>() {
            volumes if volumes.is_empty() => candidates.iter().collect(),
            volumes => volumes,
        };
    let describe = |slices: &&Vec<Slice>| {
        let image = &images[slices[0].image];
        format!(
            "\"{}\" (series {}), {} slices of {}×{}, for example {}",
            image.series.description,
            if image.series.number.is_empty() { "without a number" } else { &image.series.number },
            slices.len(),
            image.columns,
            image.rows,
            image.path.file_name().unwrap_or_default().to_string_lossy().escape_debug(),
        )
    };
    let listed: Vec<String> = volumes.iter().take(MAX_LISTED).map(describe).collect();
    let more = volumes.len().saturating_sub(MAX_LISTED);
    let more = if more > 0 { format!("; and {more} more") } else { String::new() };
    format!(
        "holds {} volumes; name a file of the one to open instead: {}{more}",
        volumes.len(),
        listed.join("; ")
    )
}
