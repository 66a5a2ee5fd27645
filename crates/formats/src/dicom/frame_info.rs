//! Where each frame lies and what its values mean, from the header of its file.

use glam::DVec3;
use glassbrick_volume::Rescale;

use super::data_set::DataSet;
use super::step_attribute::{KeyValue, keys, vector_keys};
use super::tag::{self, Tag};

/// One frame of a file; a file without `NumberOfFrames` has one.
#[derive(Clone, Debug)]
pub(super) struct FrameInfo {
    /// World position of the centre of the first voxel.
    pub position_mm: Option<DVec3>,
    pub orientation: Option<Orientation>,
    /// Distance of voxel centres along x and y.
    pub pixel_spacing_mm: [f64; 2],
    /// Where the frame lies along the normal, where it has no position.
    pub location_mm: Option<f64>,
    /// The distance of frames that the header claims.
    pub claimed_spacing_mm: Option<f64>,
    pub instance_number: Option<f64>,
    pub rescale: Rescale,
    /// What may tell apart frames of one position, by attribute.
    pub keys: Vec<(&'static str, KeyValue)>,
}

/// Unit directions of a frame's rows (x) and columns (y).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Orientation {
    pub x: DVec3,
    pub y: DVec3,
}

impl Orientation {
    pub(super) const AXIAL: Self = Self { x: DVec3::X, y: DVec3::Y };

    pub(super) fn normal(self) -> DVec3 {
        self.x.cross(self.y).normalize()
    }
}

/// A header's sequences, in the order in which a frame's attributes are looked for.
#[derive(Clone, Copy)]
pub(super) struct Lookup<'a> {
    pub root: &'a DataSet,
    pub groups: [Option<&'a DataSet>; 2],
}

impl<'a> Lookup<'a> {
    /// The data set that holds an attribute: the frame's functional group, the one shared by all frames, or
    /// the root.
    pub(super) fn holder(self, sequence: Option<Tag>, tag: Tag) -> Option<&'a DataSet> {
        let in_group = |group: &'a DataSet| group.items(sequence?).first().filter(|item| item.has(tag));
        let found = self.groups.into_iter().flatten().find_map(in_group);
        found.or_else(|| Some(self.root).filter(|root| root.has(tag)))
    }

    fn numbers(self, sequence: Tag, tag: Tag) -> Option<Vec<f64>> {
        self.holder(Some(sequence), tag)?.numbers(tag)
    }

    fn number(self, sequence: Tag, tag: Tag) -> Option<f64> {
        self.holder(Some(sequence), tag)?.number(tag)
    }
}

/// Reads what the header says of each of its `count` frames. Repairs are told in `notes`.
pub(super) fn read_frames(root: &DataSet, count: usize, notes: &mut Vec<&'static str>) -> Vec<FrameInfo> {
    let shared = root.items(tag::SHARED_FUNCTIONAL_GROUPS_SEQUENCE).first();
    let per_frame = root.items(tag::PER_FRAME_FUNCTIONAL_GROUPS_SEQUENCE);
    let offsets_mm = frame_offsets_mm(root, count, notes);
    let vectors = vector_keys(root, count);
    let mut frames = Vec::with_capacity(count);
    for index in 0..count {
        let lookup = Lookup { root, groups: [per_frame.get(index), shared] };
        let mut frame = read_frame(lookup, notes);
        frame.keys.extend(vectors.iter().map(|(name, values)| (*name, KeyValue::Number(values[index]))));
        if let Some(offsets_mm) = &offsets_mm {
            let orientation = frame.orientation.unwrap_or(Orientation::AXIAL);
            frame.position_mm =
                frame.position_mm.map(|first| first + orientation.normal() * offsets_mm[index]);
            frame.location_mm = Some(offsets_mm[index]);
        }
        frames.push(frame);
    }
    frames
}

/// How far along the normal the frames of a classic multi-frame file lie from its position: dose grids,
/// nuclear medicine, and stacks that do not say it.
fn frame_offsets_mm(root: &DataSet, count: usize, notes: &mut Vec<&'static str>) -> Option<Vec<f64>> {
    if let Some(offsets) = root.numbers(tag::GRID_FRAME_OFFSET_VECTOR).filter(|all| all.len() == count) {
        return Some(offsets.iter().map(|offset| offset - offsets[0]).collect());
    }
    if count < 2 || !root.items(tag::PER_FRAME_FUNCTIONAL_GROUPS_SEQUENCE).is_empty() {
        return None;
    }
    let length = |tag| root.number(tag).filter(|spacing| is_length(spacing.abs()));
    let spacing = length(tag::SPACING_BETWEEN_SLICES).unwrap_or_else(|| {
        remember(
            notes,
            "the frames do not say how far apart they lie; SliceThickness, or else 1 mm, is assumed",
        );
        length(tag::SLICE_THICKNESS).unwrap_or(1.0)
    });
    let slices = root.numbers(tag::SLICE_VECTOR).filter(|all| all.len() == count);
    let slices = slices.unwrap_or_else(|| (1..=count).map(|slice| slice as f64).collect());
    Some(slices.iter().map(|slice| (slice - 1.0) * spacing).collect())
}

fn read_frame(lookup: Lookup, notes: &mut Vec<&'static str>) -> FrameInfo {
    FrameInfo {
        position_mm: position(lookup, notes),
        orientation: orientation(lookup, notes),
        pixel_spacing_mm: pixel_spacing(lookup, notes),
        location_mm: lookup.root.number(tag::SLICE_LOCATION),
        claimed_spacing_mm: [tag::SPACING_BETWEEN_SLICES, tag::SLICE_THICKNESS].into_iter().find_map(|tag| {
            lookup.number(tag::PIXEL_MEASURES_SEQUENCE, tag).map(f64::abs).filter(|&length| is_length(length))
        }),
        instance_number: lookup.root.number(tag::INSTANCE_NUMBER),
        rescale: rescale(lookup, notes),
        keys: keys(lookup),
    }
}

fn position(lookup: Lookup, notes: &mut Vec<&'static str>) -> Option<DVec3> {
    let tag = tag::IMAGE_POSITION_PATIENT;
    let detector =
        || lookup.root.items(tag::DETECTOR_INFORMATION_SEQUENCE).first().filter(|item| item.has(tag));
    let holder = lookup.holder(Some(tag::PLANE_POSITION_SEQUENCE), tag).or_else(detector)?;
    let usable = |numbers: &Vec<f64>| numbers.len() == 3 && numbers.iter().all(|x| x.abs() < 1e7);
    match holder.numbers(tag).filter(usable) {
        Some(numbers) => Some(DVec3::new(numbers[0], numbers[1], numbers[2])),
        None => {
            remember(notes, "ImagePositionPatient holds no position and is passed over");
            None
        }
    }
}

fn orientation(lookup: Lookup, notes: &mut Vec<&'static str>) -> Option<Orientation> {
    let tag = tag::IMAGE_ORIENTATION_PATIENT;
    let detector =
        || lookup.root.items(tag::DETECTOR_INFORMATION_SEQUENCE).first().filter(|item| item.has(tag));
    let holder = lookup.holder(Some(tag::PLANE_ORIENTATION_SEQUENCE), tag).or_else(detector)?;
    let numbers = holder.numbers(tag).filter(|numbers| numbers.len() == 6).unwrap_or_default();
    let axis = |at: usize| {
        let axis = DVec3::from_slice(numbers.get(at..at + 3)?);
        axis.try_normalize().map(|unit| (unit, (axis.length() - 1.0).abs() > 1e-3))
    };
    let axes = axis(0).zip(axis(3)).filter(|((x, _), (y, _))| x.dot(*y).abs() < 0.9);
    let Some(((x, x_changed), (y, y_changed))) = axes else {
        remember(notes, "ImageOrientationPatient holds no two directions; the patient's own axes are used");
        return None;
    };
    if x_changed || y_changed {
        remember(notes, "the directions of ImageOrientationPatient were not of length 1 and are normalised");
    }
    if x.dot(y).abs() <= 1e-3 {
        return Some(Orientation { x, y });
    }
    remember(notes, "the directions of ImageOrientationPatient are not perpendicular; the second is turned");
    Some(Orientation { x, y: (y - x * x.dot(y)).normalize() })
}

fn pixel_spacing(lookup: Lookup, notes: &mut Vec<&'static str>) -> [f64; 2] {
    let spacing = |tag| {
        let numbers = lookup.numbers(tag::PIXEL_MEASURES_SEQUENCE, tag)?;
        let usable = numbers.len() == 2 && numbers.iter().all(|&length| is_length(length));
        usable.then(|| [numbers[1], numbers[0]])
    };
    if let Some(spacing) = spacing(tag::PIXEL_SPACING) {
        return spacing;
    }
    if let Some(spacing) = spacing(tag::IMAGER_PIXEL_SPACING) {
        remember(notes, "PixelSpacing is missing; ImagerPixelSpacing, measured at the detector, is used");
        return spacing;
    }
    if let Some(spacing) = spacing(tag::NOMINAL_SCANNED_PIXEL_SPACING) {
        remember(notes, "PixelSpacing is missing; NominalScannedPixelSpacing is used");
        return spacing;
    }
    remember(notes, "PixelSpacing is missing; 1 mm is assumed");
    [1.0, 1.0]
}

fn rescale(lookup: Lookup, notes: &mut Vec<&'static str>) -> Rescale {
    let sequence = tag::PIXEL_VALUE_TRANSFORMATION_SEQUENCE;
    if !lookup.root.items(tag::MODALITY_LUT_SEQUENCE).is_empty() {
        remember(
            notes,
            "a Modality LUT stands beside the voxels; it is not applied, values are the stored ones",
        );
    }
    let slope =
        lookup.number(sequence, tag::RESCALE_SLOPE).or_else(|| lookup.root.number(tag::DOSE_GRID_SCALING));
    let slope = slope.unwrap_or(1.0);
    let intercept = lookup.number(sequence, tag::RESCALE_INTERCEPT).unwrap_or(0.0);
    if slope == 0.0 {
        remember(notes, "RescaleSlope is 0 and passed over; values are the stored ones");
        return Rescale::IDENTITY;
    }
    Rescale { slope, intercept }
}

/// Whether this can be a distance of voxels in mm.
fn is_length(length_mm: f64) -> bool {
    (1e-9..1e6).contains(&length_mm)
}

fn remember(notes: &mut Vec<&'static str>, note: &'static str) {
    if !notes.contains(&note) {
        notes.push(note);
    }
}
