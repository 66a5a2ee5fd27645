use super::super::tag::{self, Tag};
use super::written::{Folder, Written, has_note, levels};

/// Two steps of three slices: level 10·step + slice, told apart by one attribute.
fn two_steps(attribute: Option<(Tag, [&str; 2])>) -> Folder {
    let folder = Folder::new();
    for step in 0..2_i16 {
        for slice in 0..3_i16 {
            let mut written = Written::slice(f64::from(slice), 10 * step + slice);
            if let Some((tag, values)) = attribute {
                written = written.set(tag, values[step as usize]);
            }
            folder.write(&format!("{slice}-{}.dcm", 1 - step), written);
        }
    }
    folder
}

#[test]
fn frames_of_one_position_are_time_steps_and_the_first_is_read() {
    for attribute in [
        (tag::TEMPORAL_POSITION_IDENTIFIER, ["1", "2"]),
        (tag::ACQUISITION_NUMBER, ["4", "11"]),
        (tag::TRIGGER_TIME, ["0", "62.5"]),
        (tag::ECHO_TIME, ["4.92", "12.1"]),
        (tag::CONTENT_TIME, ["093000", "101500.25"]),
        (tag::IMAGE_TYPE, [r"ORIGINAL\PRIMARY\M", r"ORIGINAL\PRIMARY\P"]),
    ] {
        let folder = two_steps(Some(attribute));
        let reader = folder.open();
        assert!(has_note(reader.as_ref(), "time step 0 of 2"), "{:?}", reader.notes());
        assert_eq!(levels(reader), [0, 1, 2]);
        assert_eq!(levels(folder.open_at(Some(1)).expect("a second step")), [10, 11, 12]);
        let refusal = folder.open_at(Some(2)).err().expect("no third step").to_string();
        assert!(refusal.contains("no time step 2; the last of its 2 is 1"), "{refusal}");
    }
}

#[test]
fn the_attribute_and_its_value_are_told() {
    let reader = two_steps(Some((tag::ECHO_TIME, ["4.92", "12.1"]))).open();
    assert!(has_note(reader.as_ref(), "EchoTime 4.92"), "{:?}", reader.notes());
}

#[test]
fn steps_without_an_attribute_of_their_own_follow_instance_numbers() {
    let folder = two_steps(None);
    assert_eq!(levels(folder.open_at(Some(1)).expect("a second step")), [10, 11, 12]);
}

#[test]
fn a_few_doubled_positions_are_no_time_steps() {
    let folder = Folder::of_slices(&[0.0, 1.0, 2.0, 3.0, 4.0]);
    folder.write("again.dcm", Written::slice(2.0, 20));
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "at 1 of 5 positions lie several slices"), "{:?}", reader.notes());
    assert_eq!(levels(reader), [0, 1, 2, 3, 4]);
}

#[test]
fn a_volume_without_time_steps_has_one() {
    let folder = Folder::of_slices(&[0.0, 1.0]);
    assert_eq!(levels(folder.open_at(Some(0)).expect("the only step")), [0, 1]);
    assert!(folder.open_at(Some(1)).is_err());
}
