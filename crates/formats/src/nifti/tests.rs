use glam::{DMat3, DVec3, UVec3};
use glassbrick_volume::{StoredType, VolumeReader};

use crate::open;
use crate::tests::{Folder, at_time, big, gzip, little, native, no_change_of_a_byte_panics, refusal, voxels};

/// A header that is changed field by field.
struct Fields {
    bytes: Vec<u8>,
    big: bool,
}

impl Fields {
    fn put<const N: usize>(&mut self, offset: usize, mut little_endian: [u8; N]) -> &mut Self {
        if self.big {
            little_endian.reverse();
        }
        self.bytes[offset..offset + N].copy_from_slice(&little_endian);
        self
    }

    fn i16s(&mut self, offset: usize, values: &[i16]) -> &mut Self {
        for (place, value) in values.iter().enumerate() {
            self.put(offset + 2 * place, value.to_le_bytes());
        }
        self
    }

    fn f32s(&mut self, offset: usize, values: &[f32]) -> &mut Self {
        for (place, value) in values.iter().enumerate() {
            self.put(offset + 4 * place, value.to_le_bytes());
        }
        self
    }

    fn file(&self, voxels: &[u8]) -> Vec<u8> {
        [self.bytes.as_slice(), &[0; 4], voxels].concat()
    }
}

/// A NIfTI-1 header of 2×2×3 voxels of i16, spaced 1, 2 and 3 mm.
fn nifti1(big: bool) -> Fields {
    let mut fields = Fields { bytes: vec![0; 348], big };
    fields.put(0, 348i32.to_le_bytes());
    fields.i16s(40, &[3, 2, 2, 3, 1, 1, 1, 1]).i16s(70, &[4, 16]);
    fields.f32s(76, &[1.0, 1.0, 2.0, 3.0]).f32s(108, &[352.0]);
    fields.bytes[344..348].copy_from_slice(b"n+1\0");
    fields
}

/// The same as NIfTI-2.
fn nifti2(big: bool) -> Fields {
    let mut fields = Fields { bytes: vec![0; 540], big };
    fields.put(0, 540i32.to_le_bytes()).i16s(12, &[4, 16]).put(168, 544i64.to_le_bytes());
    for (axis, size) in [3i64, 2, 2, 3, 1, 1, 1, 1].into_iter().enumerate() {
        fields.put(16 + 8 * axis, size.to_le_bytes());
    }
    for (axis, spacing) in [1.0f64, 1.0, 2.0, 3.0].into_iter().enumerate() {
        fields.put(104 + 8 * axis, spacing.to_le_bytes());
    }
    fields.bytes[4..12].copy_from_slice(b"n+2\0\r\n\x1a\n");
    fields
}

fn open_fields(folder: &Folder, fields: &Fields) -> Box<dyn VolumeReader> {
    folder.open("a.nii", fields.file(&little(0..12)))
}

fn columns(reader: &dyn VolumeReader) -> DMat3 {
    reader.desc().world_from_voxel().matrix3
}

#[test]
fn both_versions_are_read_in_both_byte_orders_plain_and_compressed() {
    let folder = Folder::new();
    for big_endian in [false, true] {
        let data = if big_endian { big(-3..9) } else { little(-3..9) };
        for (name, fields) in [("NIfTI-1", nifti1(big_endian)), ("NIfTI-2", nifti2(big_endian))] {
            let file = fields.file(&data);
            let plain = folder.open("a.nii", &file);
            assert_eq!((plain.format(), plain.desc().extent), (name, UVec3::new(2, 2, 3)));
            assert_eq!(plain.desc().spacing_mm, DVec3::new(1.0, 2.0, 3.0));
            let offset = plain.flat_placement().unwrap().pieces[0].offset_bytes;
            assert_eq!(offset, fields.bytes.len() as u64 + 4);
            assert_eq!(voxels(plain), native(-3..9));
            let packed = folder.open("a.nii.gz", gzip(&file));
            assert!(packed.flat_placement().is_none());
            assert_eq!(voxels(packed), native(-3..9));
        }
    }
}

#[test]
fn a_pair_opens_by_either_name() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.f32s(108, &[0.0]).bytes[344..348].copy_from_slice(b"ni1\0");
    let alone = folder.write("alone.hdr", &fields.bytes);
    assert!(refusal(&alone, &Default::default()).contains(".img"));
    for (header, image, packed) in
        [("a.hdr", "a.img", false), ("B.HDR", "B.IMG", false), ("c.hdr.gz", "c.img.gz", true)]
    {
        let pack = |bytes: &[u8]| if packed { gzip(bytes) } else { bytes.to_vec() };
        let paths = [folder.write(header, pack(&fields.bytes)), folder.write(image, pack(&little(0..12)))];
        for path in paths {
            assert_eq!(voxels(open(&path, &Default::default()).unwrap()), native(0..12));
        }
    }
}

#[test]
fn the_sform_is_preferred_and_keeps_shear() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.i16s(252, &[1, 1]).f32s(280, &[2.0, 0.0, 0.0, 5.0, 0.0, 2.0, 1.0, 6.0, 0.0, 0.0, 3.0, 7.0]);
    let reader = open_fields(&folder, &fields);
    assert_eq!(reader.desc().origin_mm, DVec3::new(-5.0, -6.0, 7.0));
    let expected = DMat3::from_cols(DVec3::X * -2.0, DVec3::Y * -2.0, DVec3::new(0.0, -1.0, 3.0));
    assert!(columns(reader.as_ref()).abs_diff_eq(expected, 1e-12));
}

#[test]
fn the_qform_is_a_rotation_with_a_sign() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    fields.i16s(252, &[1, 0]).f32s(76, &[-1.0]).f32s(256, &[0.0, 0.0, half, 5.0, 6.0, 7.0]);
    let reader = open_fields(&folder, &fields);
    assert_eq!(reader.desc().origin_mm, DVec3::new(-5.0, -6.0, 7.0));
    let expected = DMat3::from_cols(DVec3::NEG_Y, DVec3::X * 2.0, DVec3::Z * -3.0);
    assert!(columns(reader.as_ref()).abs_diff_eq(expected, 1e-6));
}

#[test]
fn an_sform_of_no_use_gives_way_to_the_qform() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.i16s(252, &[1, 1]);
    let reader = open_fields(&folder, &fields);
    assert!(reader.notes()[0].contains("qform is taken"));
    assert_eq!(columns(reader.as_ref()), DMat3::from_diagonal(DVec3::new(-1.0, -2.0, 3.0)));
    fields.i16s(252, &[0, 1]);
    assert!(folder.refusal("a.nii", fields.file(&[0; 24])).contains("sform"));
    fields.f32s(280, &[f32::NAN]);
    assert!(folder.refusal("a.nii", fields.file(&[0; 24])).contains("NaN"));
}

#[test]
fn spacing_alone_is_repaired_as_the_nifti_library_does() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.f32s(80, &[-2.0, 0.0, 3.0]);
    let reader = open_fields(&folder, &fields);
    assert_eq!(reader.desc().spacing_mm, DVec3::new(2.0, 1.0, 3.0));
    assert_eq!(reader.notes().len(), 3);
    fields.f32s(80, &[f32::INFINITY]);
    assert!(folder.refusal("a.nii", fields.file(&[0; 24])).contains("pixdim[1]"));
}

#[test]
fn units_and_rescale_are_applied() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.bytes[123] = 3 | 8;
    fields.f32s(112, &[2.0, -10.0]);
    let reader = open_fields(&folder, &fields);
    assert_eq!(reader.desc().spacing_mm, DVec3::new(0.001, 0.002, 0.003));
    assert_eq!(reader.desc().rescale.value(4.0), -2.0);
    for slope in [0.0, f32::NAN] {
        fields.f32s(112, &[slope, 5.0]);
        assert_eq!(open_fields(&folder, &fields).desc().rescale.value(4.0), 4.0);
    }
    fields.f32s(112, &[1.0, f32::NAN]);
    assert!(folder.refusal("a.nii", fields.file(&[0; 24])).contains("scl_inter"));
}

#[test]
fn a_time_step_is_picked() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.i16s(40, &[5, 2, 2, 3, 2, 2]);
    let path = folder.write("a.nii.gz", gzip(&fields.file(&little(0..48))));
    for time in 0..4 {
        let first = 12 * time as i16;
        assert_eq!(voxels(open(&path, &at_time(time)).unwrap()), native(first..first + 12));
    }
    assert!(refusal(&path, &at_time(4)).contains("0 to 3"));
    fields.i16s(68, &[1007]);
    assert!(folder.refusal("a.nii", fields.file(&little(0..48))).contains("vector"));
}

#[test]
fn header_extensions_are_passed_over() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.f32s(108, &[400.0]);
    let file = [fields.bytes.as_slice(), &[1; 52], &little(0..12)].concat();
    assert_eq!(voxels(folder.open("a.nii", file)), native(0..12));
}

#[test]
fn every_stored_type_is_read_and_others_are_refused() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    for (code, stored_type) in [
        (2, StoredType::U8),
        (256, StoredType::I8),
        (512, StoredType::U16),
        (4, StoredType::I16),
        (768, StoredType::U32),
        (8, StoredType::I32),
        (16, StoredType::F32),
        (64, StoredType::F64),
    ] {
        fields.i16s(70, &[code]);
        assert_eq!(folder.open("a.nii", fields.file(&[0; 96])).desc().stored_type, stored_type);
    }
    for (code, name) in [
        (0, "unknown"),
        (1, "binary"),
        (32, "complex"),
        (128, "RGB"),
        (1024, "64-bit integer"),
        (1536, "128-bit float"),
        (2304, "RGBA"),
        (-7, "unknown"),
    ] {
        fields.i16s(70, &[code]);
        assert!(folder.refusal("a.nii", fields.file(&[0; 999])).contains(name));
    }
}

#[test]
fn headers_that_lie_are_refused() {
    let folder = Folder::new();
    let refused = |change: &dyn Fn(&mut Fields), expected: &str| {
        let mut fields = nifti1(false);
        change(&mut fields);
        let message = folder.refusal("a.nii", fields.file(&[0; 24]));
        assert!(message.contains(expected), "{message}");
    };
    refused(&|fields| _ = fields.put(0, 7i32.to_le_bytes()), "sizeof_hdr");
    refused(&|fields| _ = fields.i16s(40, &[0]), "dim[0]");
    refused(&|fields| _ = fields.i16s(40, &[8]), "dim[0]");
    refused(&|fields| _ = fields.i16s(42, &[-2]), "dim[1]");
    refused(&|fields| _ = fields.i16s(42, &[0]), "dim[1]");
    refused(&|fields| _ = fields.i16s(42, &[32767, 32767, 32767]), "claims");
    refused(&|fields| _ = fields.i16s(40, &[7, 32767, 32767, 32767, 32767, 32767, 32767, 32767]), "claims");
    refused(&|fields| _ = fields.i16s(46, &[4]), "ends after 24");
    refused(&|fields| _ = fields.f32s(108, &[353.5]), "vox_offset");
    refused(&|fields| _ = fields.f32s(108, &[-1.0]), "vox_offset");
    refused(&|fields| _ = fields.f32s(108, &[f32::NAN]), "vox_offset");
    refused(&|fields| _ = fields.f32s(108, &[100.0]), "vox_offset");
    refused(&|fields| _ = fields.f32s(108, &[1e15]), "claims");
    refused(&|fields| fields.bytes[344] = b'x', "no known format");
    let mut huge = nifti2(false);
    huge.put(24, i64::MAX.to_le_bytes());
    assert!(folder.refusal("a.nii", huge.file(&[0; 24])).contains("claims"));
    let mut bomb = nifti1(false);
    bomb.i16s(42, &[2000, 2000, 2000]);
    assert!(folder.refusal("a.nii.gz", gzip(&bomb.file(&[0; 24]))).contains("can hold"));
}

#[test]
fn analyze_is_refused_by_name() {
    let folder = Folder::new();
    let mut fields = nifti1(false);
    fields.bytes[344..348].fill(0);
    folder.write("a.img", [0; 24]);
    assert!(folder.refusal("a.hdr", &fields.bytes).contains("Analyze"));
    assert!(refusal(&folder.path().join("a.img"), &Default::default()).contains("Analyze"));
}

#[test]
fn hostile_headers_do_not_panic() {
    let file = nifti1(false).file(&little(0..12));
    no_change_of_a_byte_panics("a.nii", &file, 352);
    let file = nifti2(true).file(&big(0..12));
    no_change_of_a_byte_panics("a.nii", &file, 544);
    let mut placed = nifti1(false);
    placed.i16s(252, &[1, 1]);
    no_change_of_a_byte_panics("a.nii", &placed.file(&little(0..12)), 352);
}
