use dicom_core::PrimitiveValue;
use dicom_object::InMemDicomObject;
use glam::DVec3;
use glassbrick_volume::{Rescale, StoredType};

use super::super::tag::{self, Tag};
use super::written::{Folder, VOXELS, Written, bytes, has_note, levels};

fn item(tag: Tag, value: impl Into<PrimitiveValue>) -> InMemDicomObject {
    Written(InMemDicomObject::new_empty()).set(tag, value).0
}

fn group(sequence: Tag, item: InMemDicomObject) -> Written {
    Written(InMemDicomObject::new_empty()).sequence(sequence, vec![item])
}

/// A file whose frame of level n is the n-th of these groups.
fn enhanced(frames: Vec<Written>) -> Written {
    let ramp: Vec<u16> = (0..frames.len() as u16).flat_map(|level| [level; VOXELS]).collect();
    let measures = Written(item(tag::PIXEL_SPACING, r"2\3")).set(tag::SLICE_THICKNESS, "9").0;
    let shared = group(tag::PIXEL_MEASURES_SEQUENCE, measures);
    let orientation = item(tag::IMAGE_ORIENTATION_PATIENT, r"1\0\0\0\1\0");
    let shared = shared.sequence(tag::PLANE_ORIENTATION_SEQUENCE, vec![orientation]);
    Written::slice(0.0, 0)
        .without(tag::IMAGE_POSITION_PATIENT)
        .without(tag::IMAGE_ORIENTATION_PATIENT)
        .without(tag::PIXEL_SPACING)
        .without(tag::RESCALE_SLOPE)
        .without(tag::RESCALE_INTERCEPT)
        .set(tag::NUMBER_OF_FRAMES, frames.len().to_string())
        .sequence(tag::SHARED_FUNCTIONAL_GROUPS_SEQUENCE, vec![shared.0])
        .sequence(
            tag::PER_FRAME_FUNCTIONAL_GROUPS_SEQUENCE,
            frames.into_iter().map(|frame| frame.0).collect(),
        )
        .voxels16(&ramp)
}

fn frame_at(z_mm: f64) -> Written {
    group(tag::PLANE_POSITION_SEQUENCE, item(tag::IMAGE_POSITION_PATIENT, format!(r"1\2\{z_mm}")))
}

#[test]
fn frames_stand_by_the_position_of_their_functional_groups() {
    let folder = Folder::new();
    folder.write("0", enhanced(vec![frame_at(8.0), frame_at(0.0), frame_at(4.0)]));
    let mut reader = folder.open();
    assert_eq!(reader.desc().spacing_mm, DVec3::new(3.0, 2.0, 4.0));
    assert_eq!(reader.desc().origin_mm, DVec3::new(1.0, 2.0, 0.0));
    assert!(reader.notes().is_empty(), "{:?}", reader.notes());
    let placement = reader.flat_placement().expect("voxels that lie as they are").clone();
    assert_eq!(placement.pieces.iter().map(|piece| piece.slices).collect::<Vec<_>>(), [2, 1]);
    assert_eq!(bytes(reader.as_mut())[0], 1);
    assert_eq!(levels(folder.open()), [1, 2, 0]);
}

#[test]
fn a_second_dimension_of_frames_is_time() {
    let frame = |z_mm: f64, time: u32| {
        let content = item(tag::DIMENSION_INDEX_VALUES, PrimitiveValue::U32([z_mm as u32 + 1, time].into()));
        frame_at(z_mm).sequence(tag::FRAME_CONTENT_SEQUENCE, vec![content])
    };
    let folder = Folder::new();
    let frames = [(0.0, 2), (0.0, 1), (1.0, 2), (1.0, 1)].map(|(z_mm, time)| frame(z_mm, time));
    folder.write("0", enhanced(frames.to_vec()));
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "time step 0 of 2 (the second dimension 1)"), "{:?}", reader.notes());
    assert_eq!(levels(reader), [1, 3]);
    assert_eq!(levels(folder.open_at(Some(1)).expect("a second step")), [0, 2]);
}

#[test]
fn stacks_of_other_directions_are_steps_of_their_own() {
    let sagittal = |x_mm: f64| {
        let position = item(tag::IMAGE_POSITION_PATIENT, format!(r"{x_mm}\0\0"));
        let orientation = item(tag::IMAGE_ORIENTATION_PATIENT, r"0\1\0\0\0\-1");
        group(tag::PLANE_POSITION_SEQUENCE, position)
            .sequence(tag::PLANE_ORIENTATION_SEQUENCE, vec![orientation])
    };
    let folder = Folder::new();
    folder.write(
        "0",
        enhanced(vec![frame_at(0.0), sagittal(0.0), frame_at(1.0), sagittal(1.0), sagittal(2.0)]),
    );
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "time step 0 of 2 (stack 1)"), "{:?}", reader.notes());
    assert_eq!(levels(reader), [0, 2]);
    assert_eq!(levels(folder.open_at(Some(1)).expect("a second stack")), [4, 3, 1]);
}

#[test]
fn rescaling_of_each_frame_is_applied_where_it_differs() {
    let rescaled = |z_mm: f64, slope: &str| {
        let transformation = Written(item(tag::RESCALE_SLOPE, slope)).set(tag::RESCALE_INTERCEPT, "0").0;
        frame_at(z_mm).sequence(tag::PIXEL_VALUE_TRANSFORMATION_SEQUENCE, vec![transformation])
    };
    let folder = Folder::new();
    folder.write("0", enhanced(vec![rescaled(0.0, "5"), rescaled(1.0, "7")]));
    assert_eq!(folder.open().desc().stored_type, StoredType::F32);
    folder.write("0", enhanced(vec![rescaled(0.0, "5"), rescaled(1.0, "5")]));
    assert_eq!(folder.open().desc().rescale, Rescale { slope: 5.0, intercept: 0.0 });
}

#[test]
fn a_dose_grid_lies_by_its_offsets_and_scales_its_values() {
    let ramp: Vec<u16> = (0..3).flat_map(|level| [level; VOXELS]).collect();
    let dose = |offsets: &str| {
        Written::slice(-50.0, 0)
            .without(tag::RESCALE_SLOPE)
            .without(tag::RESCALE_INTERCEPT)
            .set(tag::NUMBER_OF_FRAMES, "3")
            .set(tag::GRID_FRAME_OFFSET_VECTOR, offsets)
            .set(tag::DOSE_GRID_SCALING, "0.001")
            .voxels16(&ramp)
    };
    let folder = Folder::new();
    for offsets in [r"0\2.5\5", r"-50\-47.5\-45"] {
        folder.write("0", dose(offsets));
        let reader = folder.open();
        assert_eq!(reader.desc().origin_mm.z, -50.0);
        assert_eq!(reader.desc().spacing_mm.z, 2.5);
        assert_eq!(reader.desc().rescale, Rescale { slope: 0.001, intercept: 0.0 });
        assert_eq!(levels(reader), [0, 1, 2]);
    }
    folder.write("0", dose(r"0\-2.5\-5"));
    let reader = folder.open();
    assert_eq!(reader.desc().origin_mm.z, -55.0);
    assert_eq!(levels(reader), [2, 1, 0]);
}

#[test]
fn frames_that_do_not_say_where_they_lie_are_stacked_by_their_thickness() {
    let ramp: Vec<u16> = (0..2).flat_map(|level| [level; VOXELS]).collect();
    let cine =
        Written::slice(7.0, 0).set(tag::NUMBER_OF_FRAMES, "2").set(tag::SLICE_THICKNESS, "6").voxels16(&ramp);
    let folder = Folder::new();
    folder.write("0", cine);
    let reader = folder.open();
    assert_eq!((reader.desc().origin_mm.z, reader.desc().spacing_mm.z), (7.0, 6.0));
    assert!(has_note(reader.as_ref(), "do not say how far apart"), "{:?}", reader.notes());
}
