use std::fs;

use dicom_object::InMemDicomObject;

use super::super::tag::{self, Tag};
use super::written::{EXPLICIT, Folder, IMPLICIT, JPEG_LS, RLE, Written, has_note, levels, try_open};

/// Opens and reads what is there; damaged files may be refused, and nothing else may happen.
fn open_and_read(folder: &Folder) {
    if let Ok(Some(mut reader)) = try_open(folder.path(), None) {
        let bytes = reader.desc().bytes();
        assert!(bytes < 1 << 20, "{bytes} bytes are claimed of a file of a few hundred");
        reader.flat_placement();
        let _ = reader.read_slices(&mut vec![0; bytes as usize]);
    }
}

fn refused(written: Written) -> String {
    let folder = Folder::new();
    folder.write("0.dcm", written);
    folder.refusal()
}

#[test]
fn files_cut_off_anywhere_are_refused() {
    for transfer_syntax in [EXPLICIT, IMPLICIT] {
        let folder = Folder::new();
        let path = folder.write_as(transfer_syntax, "0.dcm", Written::slice(0.0, 1));
        let whole = fs::read(&path).expect("the file");
        for length in 132..whole.len() {
            fs::write(&path, &whole[..length]).expect("a writable folder");
            assert!(try_open(&path, None).is_err(), "cut off at {length} of {}", whole.len());
        }
    }
}

#[test]
fn no_byte_of_a_header_can_be_changed_to_anything_but_an_error_or_a_volume() {
    let sequence = |tag: Tag| vec![Written(InMemDicomObject::new_empty()).set(tag, r"1\2\3").0];
    let written = Written::slice(0.0, 1)
        .set(tag::NUMBER_OF_FRAMES, "2")
        .sequence(tag::PLANE_POSITION_SEQUENCE, sequence(tag::IMAGE_POSITION_PATIENT))
        .voxels16(&[7; 24]);
    let encoded = [&[2, 0, 0, 0, 64, 0, 0, 0, 66, 0, 0, 0][..], &[0; 52], &[0xF5, 1, 0xF5, 2]].concat();
    let compressed = written.clone().fragments(&[0, 76], &[&encoded, &encoded]);
    for (transfer_syntax, written) in [(EXPLICIT, written.clone()), (IMPLICIT, written), (RLE, compressed)] {
        let folder = Folder::new();
        let path = folder.write_as(transfer_syntax, "0.dcm", written);
        let whole = fs::read(&path).expect("the file");
        for at in 128..whole.len() {
            for change in [0xFF, 0x80, 0x01] {
                let mut damaged = whole.clone();
                damaged[at] ^= change;
                fs::write(&path, &damaged).expect("a writable folder");
                open_and_read(&folder);
            }
        }
    }
}

#[test]
fn a_truncated_slice_names_its_file() {
    let folder = Folder::of_slices(&[0.0, 1.0, 2.0]);
    let path = folder.path().join("1.dcm");
    let whole = fs::read(&path).expect("the file");
    fs::write(&path, &whole[..whole.len() - 2]).expect("a writable folder");
    let refusal = folder.refusal();
    assert!(refusal.contains("1.dcm") && refusal.contains("is cut off"), "{refusal}");
}

#[test]
fn a_file_that_is_no_slice_is_passed_over_and_said() {
    let folder = Folder::of_slices(&[0.0, 1.0]);
    folder.write("colour.dcm", Written::slice(0.0, 0).set(tag::SAMPLES_PER_PIXEL, 3_u16));
    folder.write("report.dcm", Written::slice(0.0, 0).without(tag::PIXEL_DATA));
    let whole = fs::read(folder.path().join("0.dcm")).expect("the file");
    fs::write(folder.path().join("short.dcm"), &whole[..400]).expect("a writable folder");
    let reader = folder.open();
    assert!(has_note(reader.as_ref(), "passed over: 2"), "{:?}", reader.notes());
    assert!(has_note(reader.as_ref(), "without an image, which are not read: 1"), "{:?}", reader.notes());
    assert_eq!(levels(reader), [0, 1]);
}

#[test]
fn what_has_not_one_value_for_each_voxel_is_refused() {
    let slice = || Written::slice(0.0, 0);
    assert!(refused(slice().set(tag::SAMPLES_PER_PIXEL, 3_u16)).contains("samples per pixel"));
    assert!(
        refused(slice().set(tag::PHOTOMETRIC_INTERPRETATION, "PALETTE COLOR")).contains("samples per pixel")
    );
    assert!(refused(slice().set(tag::IMAGE_TYPE, r"ORIGINAL\PRIMARY\M\MOSAIC")).contains("mosaic"));
    assert!(refused(slice().bits(1, 1, false)).contains("1-bit"));
    assert!(refused(slice().bits(64, 64, false)).contains("BitsAllocated 64"));
    assert!(refused(slice().bits(16, 17, false)).contains("BitsStored 17"));
    assert!(refused(slice().set(tag::ROWS, 0_u16)).contains("Rows"));
    assert!(refused(slice().without(tag::PIXEL_DATA)).contains("image"));
}

#[test]
fn an_image_larger_than_its_file_is_refused() {
    let slice = || Written::slice(0.0, 0);
    assert!(refused(slice().set(tag::ROWS, 4_u16)).contains("32 bytes"));
    assert!(refused(slice().set(tag::NUMBER_OF_FRAMES, "60000")).contains("60000 frames"));
    assert!(refused(slice().set(tag::NUMBER_OF_FRAMES, "2000000000")).contains("claims 2000000000"));
    let folder = Folder::new();
    let huge = slice().set(tag::ROWS, 65535_u16).set(tag::COLUMNS, 65535_u16).fragments(&[], &[&[0; 80]]);
    folder.write_as(RLE, "0.dcm", huge);
    let refusal = folder.refusal();
    assert!(refusal.contains("in 80 bytes of compressed"), "{refusal}");
}

#[test]
fn a_compression_that_is_not_decoded_is_named() {
    let folder = Folder::new();
    folder.write_as(JPEG_LS, "0.dcm", Written::slice(0.0, 0).fragments(&[], &[&[0; 16]]));
    let refusal = folder.refusal();
    assert!(refusal.contains("JPEG-LS lossless (transfer syntax 1.2.840.10008.1.2.4.80)"), "{refusal}");
}

#[test]
fn places_that_are_none_are_told_and_replaced() {
    for (tag, value, told) in [
        (tag::IMAGE_POSITION_PATIENT, r"nan\0\0", "holds no position"),
        (tag::IMAGE_POSITION_PATIENT, r"1e300\0\0", "holds no position"),
        (tag::IMAGE_ORIENTATION_PATIENT, r"0\0\0\0\0\0", "holds no two directions"),
        (tag::IMAGE_ORIENTATION_PATIENT, r"1\0\0\1\0\0", "holds no two directions"),
        (tag::IMAGE_ORIENTATION_PATIENT, r"2\0\0\0\2\0", "not of length 1"),
        (tag::IMAGE_ORIENTATION_PATIENT, r"1\0\0\0.6\0.8\0", "not perpendicular"),
        (tag::PIXEL_SPACING, r"0\0", "PixelSpacing is missing"),
        (tag::PIXEL_SPACING, r"inf\1", "PixelSpacing is missing"),
        (tag::RESCALE_SLOPE, "0", "RescaleSlope is 0"),
    ] {
        let folder = Folder::new();
        for level in 0..2 {
            folder.write(&format!("{level}.dcm"), Written::slice(f64::from(level), level).set(tag, value));
        }
        let reader = folder.open();
        assert!(has_note(reader.as_ref(), told), "{value}: {:?}", reader.notes());
        let desc = reader.desc();
        assert!(
            desc.world_from_voxel().is_finite() && desc.voxel_from_world().is_finite(),
            "{value}: {desc:?}"
        );
        assert_eq!(levels(reader), [0, 1]);
    }
}

#[test]
fn sequences_nested_without_end_are_refused() {
    let folder = Folder::new();
    let path = folder.write("0.dcm", Written::slice(0.0, 0));
    let whole = fs::read(&path).expect("the file");
    let start = whole.windows(4).position(|window| window == [8, 0, 0x16, 0]).expect("the first element");
    // Sequences of undefined length, each the first element of an item of the one before; kept ones, and
    // others.
    for tag in [[0x20, 0, 0x13, 0x91], [0x40, 0, 0x75, 0x02]] {
        let mut nested = whole[..start].to_vec();
        for _ in 0..100_000 {
            nested.extend_from_slice(&tag);
            nested.extend_from_slice(&[b'S', b'Q', 0, 0, 0xFF, 0xFF, 0xFF, 0xFF]);
            nested.extend_from_slice(&[0xFE, 0xFF, 0x00, 0xE0, 0xFF, 0xFF, 0xFF, 0xFF]);
        }
        fs::write(&path, &nested).expect("a writable folder");
        assert!(folder.refusal().contains("deep"), "{}", folder.refusal());
    }
}
