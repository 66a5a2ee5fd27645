//! The attributes that tell apart frames that lie at one position: time, echo, diffusion, kind of image.

use std::cmp::Ordering;

use super::data_set::DataSet;
use super::frame_info::Lookup;
use super::tag::{self, Tag};

/// What an attribute holds.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum KeyValue {
    Number(f64),
    Text(String),
}

impl KeyValue {
    pub(super) fn order(&self, other: &Self) -> Ordering {
        match (self, other) {
            (Self::Number(one), Self::Number(other)) => one.total_cmp(other),
            (Self::Text(one), Self::Text(other)) => one.cmp(other),
            (Self::Number(_), Self::Text(_)) => Ordering::Less,
            (Self::Text(_), Self::Number(_)) => Ordering::Greater,
        }
    }
}

impl std::fmt::Display for KeyValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number}"),
            Self::Text(text) => write!(f, "{}", text.escape_debug()),
        }
    }
}

/// Name, functional group and tag of the attributes, the one that tells steps apart most surely first.
const ATTRIBUTES: &[(&str, Option<Tag>, Tag)] = &[
    ("TemporalPositionIndex", Some(tag::FRAME_CONTENT_SEQUENCE), tag::TEMPORAL_POSITION_INDEX),
    ("TemporalPositionIdentifier", None, tag::TEMPORAL_POSITION_IDENTIFIER),
    ("TemporalPositionTimeOffset", Some(tag::TEMPORAL_POSITION_SEQUENCE), tag::TEMPORAL_POSITION_TIME_OFFSET),
    ("AcquisitionNumber", None, tag::ACQUISITION_NUMBER),
    ("FrameAcquisitionNumber", Some(tag::FRAME_CONTENT_SEQUENCE), tag::FRAME_ACQUISITION_NUMBER),
    ("TriggerTime", None, tag::TRIGGER_TIME),
    (
        "NominalCardiacTriggerDelayTime",
        Some(tag::CARDIAC_SYNCHRONIZATION_SEQUENCE),
        tag::NOMINAL_CARDIAC_TRIGGER_DELAY_TIME,
    ),
    ("EchoTime", None, tag::ECHO_TIME),
    ("EffectiveEchoTime", Some(tag::MR_ECHO_SEQUENCE), tag::EFFECTIVE_ECHO_TIME),
    ("EchoNumbers", None, tag::ECHO_NUMBERS),
    ("DiffusionBValue", Some(tag::MR_DIFFUSION_SEQUENCE), tag::DIFFUSION_B_VALUE),
    ("FrameReferenceTime", None, tag::FRAME_REFERENCE_TIME),
    ("ImageType", None, tag::IMAGE_TYPE),
    ("FrameType", Some(tag::MR_IMAGE_FRAME_TYPE_SEQUENCE), tag::FRAME_TYPE),
    ("FrameType", Some(tag::CT_IMAGE_FRAME_TYPE_SEQUENCE), tag::FRAME_TYPE),
    ("StackID", Some(tag::FRAME_CONTENT_SEQUENCE), tag::STACK_ID),
    ("AcquisitionTime", None, tag::ACQUISITION_TIME),
    ("ContentTime", None, tag::CONTENT_TIME),
];

/// A longer text is compared by its beginning.
const MAX_TEXT: usize = 200;

/// The dimensions of a multi-frame file that its own index names.
const DIMENSIONS: [&str; 6] = [
    "the first dimension",
    "the second dimension",
    "the third dimension",
    "the fourth dimension",
    "the fifth dimension",
    "the sixth dimension",
];

/// The attributes of classic multi-frame files that hold one number for each frame.
const VECTORS: &[(&str, Tag)] = &[
    ("EnergyWindowVector", tag::ENERGY_WINDOW_VECTOR),
    ("DetectorVector", tag::DETECTOR_VECTOR),
    ("PhaseVector", tag::PHASE_VECTOR),
    ("RotationVector", tag::ROTATION_VECTOR),
    ("RRIntervalVector", tag::RR_INTERVAL_VECTOR),
    ("TimeSlotVector", tag::TIME_SLOT_VECTOR),
    ("AngularViewVector", tag::ANGULAR_VIEW_VECTOR),
    ("TimeSliceVector", tag::TIME_SLICE_VECTOR),
];

/// The names under which keys may stand, the one that tells steps apart most surely first.
pub(super) fn key_names() -> impl Iterator<Item = &'static str> {
    let attributes = ATTRIBUTES.iter().map(|(name, ..)| *name);
    attributes.chain(VECTORS.iter().map(|(name, _)| *name)).chain(DIMENSIONS)
}

/// The keys of one frame.
pub(super) fn keys(lookup: Lookup) -> Vec<(&'static str, KeyValue)> {
    let value = |holder: &DataSet, tag| match holder.number(tag) {
        Some(number) => Some(KeyValue::Number(number)),
        None => holder.text(tag).map(|text| KeyValue::Text(text.chars().take(MAX_TEXT).collect())),
    };
    let mut keys = Vec::new();
    for &(name, sequence, tag) in ATTRIBUTES {
        keys.extend(
            lookup.holder(sequence, tag).and_then(|holder| value(holder, tag)).map(|key| (name, key)),
        );
    }
    let index = tag::DIMENSION_INDEX_VALUES;
    let holder = lookup.holder(Some(tag::FRAME_CONTENT_SEQUENCE), index);
    let indices = holder.and_then(|holder| holder.numbers(index)).unwrap_or_default();
    keys.extend(DIMENSIONS.into_iter().zip(indices).map(|(name, index)| (name, KeyValue::Number(index))));
    keys
}

/// The vectors that hold a number for each of a classic multi-frame file's frames.
pub(super) fn vector_keys(root: &DataSet, count: usize) -> Vec<(&'static str, Vec<f64>)> {
    let vector = |&(name, tag)| Some((name, root.numbers(tag).filter(|all| all.len() == count)?));
    VECTORS.iter().filter_map(vector).collect()
}
