use glam::{DMat3, DVec3, UVec3};
use glassbrick_volume::{Rescale, StoredType};

use super::super::tag;
use super::written::{Folder, Written, has_note, levels, try_open, voxels};

#[test]
fn slices_stand_by_position_whatever_their_names_and_numbers() {
    let folder = Folder::of_slices(&[30.0, 10.0, 20.0, 0.0]);
    let reader = folder.open();
    let desc = reader.desc();
    assert_eq!(desc.extent, UVec3::new(4, 3, 4));
    assert_eq!(desc.stored_type, StoredType::I16);
    assert_eq!(desc.origin_mm, DVec3::new(10.0, 20.0, 0.0));
    assert_eq!(desc.direction, DMat3::IDENTITY);
    assert_eq!(desc.rescale, Rescale { slope: 2.0, intercept: -1024.0 });
    assert!(reader.notes().is_empty(), "{:?}", reader.notes());
    assert_eq!(levels(reader), [3, 1, 2, 0]);
}

#[test]
fn pixel_spacing_is_of_rows_then_of_columns() {
    let reader = Folder::of_slices(&[0.0, 10.0]).open();
    assert_eq!(reader.desc().spacing_mm, DVec3::new(0.25, 0.5, 10.0));
}

#[test]
fn slices_can_be_asked_for_in_parts_and_no_further_than_the_last() {
    let folder = Folder::of_slices(&[0.0, 1.0, 2.0]);
    let mut reader = folder.open();
    let mut one = [0; 24];
    let mut two = [0; 48];
    reader.read_slices(&mut one).expect("the first slice");
    assert!(reader.read_slices(&mut [0; 23]).is_err());
    assert!(reader.read_slices(&mut [0; 72]).is_err());
    reader.read_slices(&mut two).expect("the second and third");
    assert_eq!((one[0], two[0], two[24]), (0, 1, 2));
    assert!(reader.read_slices(&mut one).is_err());
}

#[test]
fn a_named_file_opens_its_series_and_says_so() {
    let folder = Folder::of_slices(&[0.0, 1.0, 2.0]);
    for level in 0..2 {
        let other = Written::slice(f64::from(level), level).set(tag::SERIES_INSTANCE_UID, "1.2.3.9");
        folder.write(&format!("other{level}.dcm"), other);
    }
    let reader = try_open(&folder.path().join("1.dcm"), None).expect("a sound file").expect("DICOM");
    assert!(has_note(reader.as_ref(), "3 in all"), "{:?}", reader.notes());
    assert_eq!(levels(reader), [0, 1, 2]);
    let refusal = folder.refusal();
    for part in ["2 volumes", "\"Head\" (series 7), 3 slices of 4×3, for example 0.dcm", "other0.dcm"] {
        assert!(refusal.contains(part), "{refusal}");
    }
}

#[test]
fn a_scout_beside_a_volume_is_left_out_and_said() {
    let folder = Folder::of_slices(&[0.0, 1.0, 2.0]);
    folder.write("scout.dcm", Written::slice(5.0, 9).set(tag::IMAGE_TYPE, r"ORIGINAL\PRIMARY\LOCALIZER"));
    let sagittal = Written::slice(5.0, 9).set(tag::IMAGE_ORIENTATION_PATIENT, r"0\1\0\0\0\-1");
    folder.write("sagittal.dcm", sagittal.set(tag::SOP_INSTANCE_UID, "1.2.3.77"));
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "not read: 2"), "{:?}", reader.notes());
    assert_eq!(levels(reader), [0, 1, 2]);
}

#[test]
fn missing_slices_are_told_with_numbers() {
    let reader = Folder::of_slices(&[0.0, 1.0, 2.0, 5.0, 6.0]).open();
    assert_eq!(reader.desc().spacing_mm.z, 1.5);
    assert!(has_note(reader.as_ref(), "slices missing: 2, the first after slice 3"), "{:?}", reader.notes());
}

#[test]
fn uneven_distances_are_told_and_drawn_by_their_mean() {
    let reader = Folder::of_slices(&[0.0, 1.0, 2.0, 3.4]).open();
    assert!((reader.desc().spacing_mm.z - 3.4 / 3.0).abs() < 1e-12);
    assert!(has_note(reader.as_ref(), "1.0000 to 1.4000 mm apart"), "{:?}", reader.notes());
    let even = Folder::of_slices(&[0.0, 1.0, 2.001, 3.0]).open();
    assert!(even.notes().is_empty(), "{:?}", even.notes());
}

#[test]
fn gantry_tilt_is_a_slanting_axis() {
    let folder = Folder::new();
    for level in 0..3 {
        let step = f64::from(level);
        let slice = Written::slice(step * 4.0, level).at(0.0, step * 3.0, step * 4.0);
        folder.write(&format!("{level}.dcm"), slice);
    }
    let reader = folder.open();
    assert_eq!(reader.desc().spacing_mm.z, 5.0);
    assert!(reader.desc().direction.z_axis.abs_diff_eq(DVec3::new(0.0, 0.6, 0.8), 1e-12));
    assert!(has_note(reader.as_ref(), "36.87°"), "{:?}", reader.notes());
}

#[test]
fn an_oblique_series_is_ordered_along_its_normal() {
    let folder = Folder::new();
    for (level, x_mm) in [(0, 6.0), (1, 3.0), (2, 0.0)] {
        let slice = Written::slice(0.0, level)
            .at(x_mm, 0.0, 0.0)
            .set(tag::IMAGE_ORIENTATION_PATIENT, r"0\1\0\0\0\-1");
        folder.write(&format!("{level}.dcm"), slice.set(tag::SOP_INSTANCE_UID, format!("1.2.{level}")));
    }
    let reader = folder.open();
    // The normal of rows to the back and columns downwards is to the right: x falls from slice to slice.
    assert_eq!(reader.desc().direction.z_axis, DVec3::new(-1.0, 0.0, 0.0));
    assert_eq!(reader.desc().origin_mm.x, 6.0);
    assert_eq!(levels(reader), [0, 1, 2]);
}

#[test]
fn slices_without_positions_stand_by_location_or_else_by_number() {
    let slice = |level: i16| Written::slice(0.0, level).without(tag::IMAGE_POSITION_PATIENT);
    let folder = Folder::new();
    for level in 0..3 {
        let located = slice(level).set(tag::SLICE_LOCATION, format!("{}", -3 * level));
        folder.write(&format!("{level}.dcm"), located);
    }
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "by their location"), "{:?}", reader.notes());
    assert_eq!(reader.desc().spacing_mm.z, 3.0);
    assert_eq!(levels(reader), [2, 1, 0]);

    let folder = Folder::new();
    for (name, level) in [("a", 2), ("b", 10), ("c", 1)] {
        folder.write(name, slice(level).set(tag::SLICE_THICKNESS, "1.5"));
    }
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "by InstanceNumber"), "{:?}", reader.notes());
    assert_eq!(reader.desc().spacing_mm.z, 1.5);
    assert_eq!(levels(reader), [1, 2, 10]);
}

#[test]
fn copies_of_a_file_are_left_out() {
    let folder = Folder::of_slices(&[0.0, 1.0, 2.0]);
    folder.write("copy.dcm", Written::slice(1.0, 1));
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "copies of others and left out: 1"), "{:?}", reader.notes());
    assert_eq!(levels(reader), [0, 1, 2]);
}

#[test]
fn a_series_whose_rescaling_differs_by_slice_is_read_as_values() {
    let folder = Folder::new();
    for level in 0..2 {
        let slice = Written::slice(f64::from(level), level).set(tag::RESCALE_SLOPE, format!("{}", level + 1));
        folder.write(&format!("{level}.dcm"), slice.set(tag::RESCALE_INTERCEPT, "0.5"));
    }
    let mut reader = folder.open();
    assert_eq!(reader.desc().stored_type, StoredType::F32);
    assert_eq!(reader.desc().rescale, Rescale::IDENTITY);
    assert!(reader.flat_placement().is_none());
    let bytes = super::written::bytes(reader.as_mut());
    let values: Vec<f32> = bytes.as_chunks().0.iter().map(|&voxel| f32::from_ne_bytes(voxel)).collect();
    assert_eq!((values[0], values[12]), (0.5, 2.5));
}

#[test]
fn a_series_in_a_subfolder_is_found() {
    let folder = Folder::new();
    let inner = folder.path().join("study/series");
    std::fs::create_dir_all(&inner).expect("a writable folder");
    folder.write("study/series/0.dcm", Written::slice(0.0, 0));
    folder.write("study/series/1.dcm", Written::slice(1.0, 1));
    assert_eq!(voxels(folder.open()).len(), 24);
}

#[cfg(unix)]
#[test]
fn links_out_of_the_folder_are_not_followed() {
    let outside = Folder::of_slices(&[0.0, 1.0, 2.0]);
    let folder = Folder::new();
    folder.write("0.dcm", Written::slice(0.0, 0));
    std::os::unix::fs::symlink(outside.path().join("1.dcm"), folder.path().join("1.dcm")).expect("a link");
    assert_eq!(levels(folder.open()), [0]);
}

#[test]
fn what_is_no_dicom_is_left_to_other_formats() {
    let folder = Folder::new();
    assert!(try_open(folder.path(), None).expect("an empty folder").is_none());
    std::fs::write(folder.path().join("text"), "NRRD0004\n# a header\n").expect("a writable folder");
    std::fs::write(folder.path().join("zeros"), [0; 4096]).expect("a writable folder");
    std::fs::write(folder.path().join("almost"), [8, 0, 5, 0, b'C', b'S', 4, 0, 1, 2])
        .expect("a writable folder");
    assert!(try_open(folder.path(), None).expect("a folder of others").is_none());
    assert!(try_open(&folder.path().join("zeros"), None).expect("another file").is_none());
    assert!(try_open(&folder.path().join("absent"), None).is_err());
}

#[test]
fn a_data_set_without_file_meta_information_is_dicom_too() {
    let folder = Folder::new();
    let whole = folder.write("whole.dcm", Written::slice(0.0, 5));
    let bytes = std::fs::read(&whole).expect("the file");
    // The data set begins with SOPClassUID, in explicit VR.
    let first = [8, 0, 0x16, 0, b'U', b'I'];
    let start = bytes.windows(6).position(|window| window == first).expect("the first element");
    std::fs::write(&whole, &bytes[start..]).expect("a writable folder");
    assert_eq!(levels(folder.open()), [5]);
}
