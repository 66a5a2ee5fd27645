//! The data elements that a volume is made of; every other element is skipped.

/// A data element's group and element number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Tag(pub u16, pub u16);

impl Tag {
    pub(super) const ITEM: Self = Self(0xFFFE, 0xE000);
    pub(super) const ITEM_END: Self = Self(0xFFFE, 0xE00D);
    pub(super) const SEQUENCE_END: Self = Self(0xFFFE, 0xE0DD);
}

macro_rules! kept_tags {
    ($($name:ident = ($group:literal, $element:literal) $vr:literal;)*) => {
        $(pub(super) const $name: Tag = Tag($group, $element);)*

        /// The elements that are kept, in order, with the value representation that the standard gives them.
        const KEPT: &[(Tag, [u8; 2])] = &[$((Tag($group, $element), *$vr)),*];
    };
}

kept_tags! {
    TRANSFER_SYNTAX_UID = (0x0002, 0x0010) b"UI";
    IMAGE_TYPE = (0x0008, 0x0008) b"CS";
    SOP_CLASS_UID = (0x0008, 0x0016) b"UI";
    SOP_INSTANCE_UID = (0x0008, 0x0018) b"UI";
    ACQUISITION_TIME = (0x0008, 0x0032) b"TM";
    CONTENT_TIME = (0x0008, 0x0033) b"TM";
    SERIES_DESCRIPTION = (0x0008, 0x103E) b"LO";
    FRAME_TYPE = (0x0008, 0x9007) b"CS";
    SLICE_THICKNESS = (0x0018, 0x0050) b"DS";
    ECHO_TIME = (0x0018, 0x0081) b"DS";
    ECHO_NUMBERS = (0x0018, 0x0086) b"IS";
    SPACING_BETWEEN_SLICES = (0x0018, 0x0088) b"DS";
    TRIGGER_TIME = (0x0018, 0x1060) b"DS";
    IMAGER_PIXEL_SPACING = (0x0018, 0x1164) b"DS";
    NOMINAL_SCANNED_PIXEL_SPACING = (0x0018, 0x2010) b"DS";
    EFFECTIVE_ECHO_TIME = (0x0018, 0x9082) b"FD";
    DIFFUSION_B_VALUE = (0x0018, 0x9087) b"FD";
    MR_ECHO_SEQUENCE = (0x0018, 0x9114) b"SQ";
    MR_DIFFUSION_SEQUENCE = (0x0018, 0x9117) b"SQ";
    CARDIAC_SYNCHRONIZATION_SEQUENCE = (0x0018, 0x9118) b"SQ";
    MR_IMAGE_FRAME_TYPE_SEQUENCE = (0x0018, 0x9226) b"SQ";
    CT_IMAGE_FRAME_TYPE_SEQUENCE = (0x0018, 0x9329) b"SQ";
    SERIES_INSTANCE_UID = (0x0020, 0x000E) b"UI";
    SERIES_NUMBER = (0x0020, 0x0011) b"IS";
    ACQUISITION_NUMBER = (0x0020, 0x0012) b"IS";
    INSTANCE_NUMBER = (0x0020, 0x0013) b"IS";
    IMAGE_POSITION_PATIENT = (0x0020, 0x0032) b"DS";
    IMAGE_ORIENTATION_PATIENT = (0x0020, 0x0037) b"DS";
    TEMPORAL_POSITION_IDENTIFIER = (0x0020, 0x0100) b"IS";
    SLICE_LOCATION = (0x0020, 0x1041) b"DS";
    STACK_ID = (0x0020, 0x9056) b"SH";
    FRAME_CONTENT_SEQUENCE = (0x0020, 0x9111) b"SQ";
    PLANE_POSITION_SEQUENCE = (0x0020, 0x9113) b"SQ";
    PLANE_ORIENTATION_SEQUENCE = (0x0020, 0x9116) b"SQ";
    TEMPORAL_POSITION_INDEX = (0x0020, 0x9128) b"UL";
    NOMINAL_CARDIAC_TRIGGER_DELAY_TIME = (0x0020, 0x9153) b"FD";
    FRAME_ACQUISITION_NUMBER = (0x0020, 0x9156) b"US";
    DIMENSION_INDEX_VALUES = (0x0020, 0x9157) b"UL";
    TEMPORAL_POSITION_TIME_OFFSET = (0x0020, 0x930D) b"FD";
    TEMPORAL_POSITION_SEQUENCE = (0x0020, 0x9310) b"SQ";
    SAMPLES_PER_PIXEL = (0x0028, 0x0002) b"US";
    PHOTOMETRIC_INTERPRETATION = (0x0028, 0x0004) b"CS";
    NUMBER_OF_FRAMES = (0x0028, 0x0008) b"IS";
    ROWS = (0x0028, 0x0010) b"US";
    COLUMNS = (0x0028, 0x0011) b"US";
    PIXEL_SPACING = (0x0028, 0x0030) b"DS";
    BITS_ALLOCATED = (0x0028, 0x0100) b"US";
    BITS_STORED = (0x0028, 0x0101) b"US";
    HIGH_BIT = (0x0028, 0x0102) b"US";
    PIXEL_REPRESENTATION = (0x0028, 0x0103) b"US";
    RESCALE_INTERCEPT = (0x0028, 0x1052) b"DS";
    RESCALE_SLOPE = (0x0028, 0x1053) b"DS";
    MODALITY_LUT_SEQUENCE = (0x0028, 0x3000) b"SQ";
    PIXEL_MEASURES_SEQUENCE = (0x0028, 0x9110) b"SQ";
    PIXEL_VALUE_TRANSFORMATION_SEQUENCE = (0x0028, 0x9145) b"SQ";
    ENERGY_WINDOW_VECTOR = (0x0054, 0x0010) b"US";
    DETECTOR_VECTOR = (0x0054, 0x0020) b"US";
    DETECTOR_INFORMATION_SEQUENCE = (0x0054, 0x0022) b"SQ";
    PHASE_VECTOR = (0x0054, 0x0030) b"US";
    ROTATION_VECTOR = (0x0054, 0x0050) b"US";
    RR_INTERVAL_VECTOR = (0x0054, 0x0060) b"US";
    TIME_SLOT_VECTOR = (0x0054, 0x0070) b"US";
    SLICE_VECTOR = (0x0054, 0x0080) b"US";
    ANGULAR_VIEW_VECTOR = (0x0054, 0x0090) b"US";
    TIME_SLICE_VECTOR = (0x0054, 0x0100) b"US";
    FRAME_REFERENCE_TIME = (0x0054, 0x1300) b"DS";
    GRID_FRAME_OFFSET_VECTOR = (0x3004, 0x000C) b"DS";
    DOSE_GRID_SCALING = (0x3004, 0x000E) b"DS";
    SHARED_FUNCTIONAL_GROUPS_SEQUENCE = (0x5200, 0x9229) b"SQ";
    PER_FRAME_FUNCTIONAL_GROUPS_SEQUENCE = (0x5200, 0x9230) b"SQ";
    EXTENDED_OFFSET_TABLE = (0x7FE0, 0x0001) b"OV";
    FLOAT_PIXEL_DATA = (0x7FE0, 0x0008) b"OF";
    DOUBLE_FLOAT_PIXEL_DATA = (0x7FE0, 0x0009) b"OD";
    PIXEL_DATA = (0x7FE0, 0x0010) b"OW";
}

/// The value representation of an element that is kept; nothing for one that is not.
pub(super) fn kept_vr(tag: Tag) -> Option<[u8; 2]> {
    KEPT.binary_search_by_key(&tag, |&(kept, _)| kept).ok().map(|index| KEPT[index].1)
}

/// Whether this element holds the voxels.
pub(super) fn is_pixel_data(tag: Tag) -> bool {
    matches!(tag, PIXEL_DATA | FLOAT_PIXEL_DATA | DOUBLE_FLOAT_PIXEL_DATA)
}

/// Whether this element holds a number for each frame.
pub(super) fn is_vector(tag: Tag) -> bool {
    tag.0 == 0x0054 || matches!(tag, GRID_FRAME_OFFSET_VECTOR | EXTENDED_OFFSET_TABLE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_tags_stand_in_order_so_that_each_is_found() {
        assert!(KEPT.is_sorted_by(|before, after| before.0 < after.0));
        assert_eq!(kept_vr(ROWS), Some(*b"US"));
        assert_eq!(kept_vr(Tag(0x0010, 0x0010)), None);
    }
}
