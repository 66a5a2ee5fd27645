use glam::{DVec3, UVec3};

use crate::open;
use crate::tests::{Folder, at_time, big, little, native, no_change_of_a_byte_panics, refusal, voxels, zlib};

/// A 2×2×3 volume of i16 with more fields, the last of which is ElementDataFile.
fn header(fields: &str) -> String {
    format!("ObjectType = Image\nNDims = 3\nDimSize = 2 2 3\nElementType = MET_SHORT\n{fields}\n")
}

fn local(fields: &str, data: impl AsRef<[u8]>) -> Vec<u8> {
    [header(&format!("{fields}\nElementDataFile = LOCAL")).as_bytes(), data.as_ref()].concat()
}

#[test]
fn every_encoding_gives_the_same_voxels() {
    let folder = Folder::new();
    for (fields, data) in [
        ("BinaryDataByteOrderMSB = False", little(-3..9)),
        ("BinaryData = True\nElementByteOrderMSB = True", big(-3..9)),
        ("CompressedData = True\nCompressedDataSize = 3\nBinaryDataByteOrderMSB = True", zlib(&big(-3..9))),
        ("BinaryData = False", b"-3 -2 -1 0 1 2\n3 4 5 6 7 8\n".to_vec()),
    ] {
        let reader = folder.open("a.mha", local(fields, data));
        assert_eq!(reader.format(), "MetaImage");
        assert_eq!(voxels(reader), native(-3..9), "{fields}");
    }
}

#[test]
fn voxels_are_found_in_files_lists_and_patterns() {
    let folder = Folder::new();
    let raw = little(0..12);
    folder.write("all voxels.raw", &raw);
    folder.write("all.zraw", zlib(&raw));
    folder.write("late.raw", [b"12345678", raw.as_slice()].concat());
    for slice in 0..3 {
        folder.write(&format!("s{}.raw", 2 * slice + 1), &raw[8 * slice..8 * slice + 8]);
        folder.write(&format!("t{:03}.raw", slice + 1), &raw[8 * slice..8 * slice + 8]);
    }
    for (fields, pieces) in [
        ("ElementDataFile = all voxels.raw", 1),
        ("CompressedData = True\nElementDataFile = all.zraw", 0),
        ("HeaderSize = 8\nElementDataFile = late.raw", 1),
        ("HeaderSize = -1\nElementDataFile = late.raw", 1),
        ("ElementDataFile = LIST\ns1.raw\ns3.raw\ns5.raw", 3),
        ("ElementDataFile = LIST 2D\ns1.raw\ns3.raw\ns5.raw\n", 3),
        ("ElementDataFile = LIST 3\nall voxels.raw", 1),
        ("ElementDataFile = s%d.raw 1 5 2", 3),
        ("ElementDataFile = t%03d.raw", 3),
        ("ElementDataFile = t%03d.raw 1 3", 3),
    ] {
        let reader = folder.open("a.mhd", header(fields));
        assert_eq!(reader.flat_placement().map_or(0, |placement| placement.pieces.len()), pieces, "{fields}");
        assert_eq!(voxels(reader), native(0..12), "{fields}");
    }
    for (file, expected) in [
        ("../all.raw", "outside"),
        ("missing.raw", "missing.raw"),
        ("s1.raw", "ends after 8"),
        ("LIST\ns1.raw", "1 files"),
        ("LIST 7\ns1.raw", "7"),
        ("s%d.raw 1 9 2", "one file per slice"),
        ("s%d.raw 1 3 2", "2 files"),
        ("s%d.raw one", "one file per slice"),
    ] {
        let message = folder.refusal("a.mhd", header(&format!("ElementDataFile = {file}")));
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn the_grid_is_read_by_any_of_its_names() {
    let folder = Folder::new();
    let desc = |fields: &str| folder.open("a.mha", local(fields, little(0..12))).desc().clone();
    for (place, matrix) in
        [("Offset", "TransformMatrix"), ("Position", "Rotation"), ("Origin", "Orientation")]
    {
        let desc = desc(&format!(
            "{place} = 1 -2 3.5\n{matrix} = 0 1 0 0 0 -1 1 0 0\nElementSpacing = 1 2 3\nCenterOfRotation = 9 9 9"
        ));
        assert_eq!(desc.origin_mm, DVec3::new(1.0, -2.0, 3.5));
        assert_eq!(desc.spacing_mm, DVec3::new(1.0, 2.0, 3.0));
        assert_eq!((desc.direction.x_axis, desc.direction.y_axis), (DVec3::Y, DVec3::NEG_Z));
    }
    assert_eq!(desc("ElementSize = 1 2 3").spacing_mm, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(desc("ElementSize = 4 4 4\nElementSpacing = 1 2 3").spacing_mm, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(
        desc("DistanceUnits = um\nElementSpacing = 1 2 3").spacing_mm,
        DVec3::new(0.001, 0.002, 0.003)
    );
    assert_eq!(desc("ElementSpacing = 1 -2 3").direction.y_axis, DVec3::NEG_Y);
    let rescaled = desc("ElementToIntensityFunctionSlope = 2\nElementToIntensityFunctionOffset = -1024");
    assert_eq!(rescaled.rescale.value(10.0), -1004.0);
}

#[test]
fn volumes_of_other_dimensions_are_read() {
    let folder = Folder::new();
    let image = "NDims = 2\nDimSize = 2 3\nElementType = MET_UCHAR\nTransformMatrix = 0 1 1 0\nElementDataFile = LOCAL\nabcdef";
    let reader = folder.open("a.mha", image);
    assert_eq!((reader.desc().extent, reader.desc().direction.x_axis), (UVec3::new(2, 3, 1), DVec3::Y));
    let head = "NDims = 4\nDimSize = 2 2 3 2\nElementType = MET_SHORT\nElementByteOrderMSB = False\nOffset = 1 2 3 4\n\
                ElementDataFile = LOCAL\n";
    let path = folder.write("t.mha", [head.as_bytes(), &little(0..24)].concat());
    let reader = open(&path, &at_time(1)).unwrap();
    assert_eq!(reader.desc().origin_mm, DVec3::new(1.0, 2.0, 3.0));
    assert!(reader.flat_placement().is_some());
    assert_eq!(voxels(reader), native(12..24));
    assert!(refusal(&path, &at_time(2)).contains("0 to 1"));
}

#[test]
fn headers_that_lie_or_hold_no_scalars_are_refused() {
    let folder = Folder::new();
    let base = |fields: &str| local(fields, [0; 24]);
    let of = |kind: &str, sizes: &str| {
        format!("NDims = 3\nDimSize = {sizes}\nElementType = {kind}\nElementDataFile = LOCAL\n").into_bytes()
    };
    for (file, expected) in [
        (base("ElementNumberOfChannels = 3"), "3 numbers"),
        (base("TransformMatrix = 0 0 0 0 0 0 0 0 0"), "spacing"),
        (base("TransformMatrix = 1 0 0 1 0 0 0 0 1"), "one plane"),
        (base("TransformMatrix = 1 0 0 1"), "9 fitting numbers"),
        (base("ElementSpacing = 1 0 1"), "along y"),
        (base("ElementSpacing = 1 nan 1"), "not finite"),
        (base("CompressedData = maybe"), "True or False"),
        (base("BinaryData = False\nCompressedData = True"), "not binary"),
        (base("HeaderSize = -2"), "HeaderSize"),
        (base("HeaderSize = 9999"), "claims 24 bytes"),
        (base("NDims = 3"), "twice"),
        (base("DistanceUnits = furlong"), "furlong"),
        (base("ElementToIntensityFunctionSlope = 0"), "slope 0"),
        (of("MET_LONG_LONG", "2 2 3"), "MET_LONG_LONG"),
        (of("MET_FLOAT_ARRAY", "2 2 3"), "MET_FLOAT_ARRAY"),
        (of("MET_SHORT", "2 0 3"), "no voxels"),
        (of("MET_SHORT", "2 -1 3"), "DimSize"),
        (of("MET_SHORT", "100000 100000 100000"), "claims"),
        (of("MET_SHORT", "4194304 4194304 4194304"), "claims"),
        (
            b"NDims = 4\nDimSize = 2 2 3 0\nElementType = MET_SHORT\nElementDataFile = LOCAL\n".to_vec(),
            "no volume",
        ),
        (
            b"NDims = 99\nDimSize = 2 2 3\nElementType = MET_SHORT\nElementDataFile = LOCAL\n".to_vec(),
            "NDims is 99",
        ),
        (b"NDims = 3\nDimSize = 2 2 3\n".to_vec(), "ElementDataFile"),
        (b"words\n".to_vec(), "words"),
    ] {
        let message = folder.refusal("a.mha", &file);
        assert!(message.contains(expected), "{}\n{message}", String::from_utf8_lossy(&file));
    }
    let mut short = folder.open("a.mha", local("CompressedData = True", zlib(&[0; 20])));
    assert!(short.read_slices(&mut [0; 24]).unwrap_err().to_string().contains("after 20 of 24"));
}

#[test]
fn hostile_headers_do_not_panic() {
    let fields =
        "Offset = 1 2 3\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nElementSpacing = 1 2 3\nHeaderSize = 0";
    let file = local(fields, little(0..12));
    no_change_of_a_byte_panics("a.mha", &file, file.len() - 24);
}
