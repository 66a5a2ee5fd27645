use super::hostile_headers::refuse;
use super::sound_files::{dicom_slice, gzip, nifti, voxels};
use super::{EXIT_FAILURE, Scratch};

#[test]
fn nifti_headers_that_claim_too_much_or_nonsense() {
    let scratch = Scratch::new();
    let refuse = |field: usize, bytes: &[u8]| {
        let mut header = nifti("n+1\0", 352.0);
        header[field..field + bytes.len()].copy_from_slice(bytes);
        header.extend([0; 4]);
        refuse(&scratch, "a.nii", &header);
        let zipped = scratch.file("a.nii.gz", &gzip(&[header, voxels()].concat()));
        scratch.refuses(EXIT_FAILURE, &zipped, "");
    };
    const DIM: usize = 40;
    for sizes in [[32767, 32767, 32767], [0, 10, 8], [-12, 10, 8], [24, 10, 8], [12, 10, -32768i16]] {
        refuse(DIM + 2, &sizes.map(i16::to_le_bytes).concat());
    }
    for dimensions in [0, -1, 8, 32767i16] {
        refuse(DIM, &dimensions.to_le_bytes());
    }
    for (datatype, bits) in [(0, 0), (1, 1), (128, 24), (32, 64), (1536, 128), (999, 16)] {
        refuse(70, &[datatype, bits].map(i16::to_le_bytes).concat());
    }
    for offset in [1e30, 1e9, -1000.0, 8.0, f32::NAN, f32::INFINITY] {
        refuse(108, &offset.to_le_bytes());
    }
}

#[test]
fn a_nifti_2_header_may_claim_any_64_bit_number() {
    let scratch = Scratch::new();
    for sizes in
        [[100_000i64; 3], [i64::MAX; 3], [1 << 32, 1 << 32, 1], [1 << 62, 4, 1], [-1, 10, 8], [0, 0, 0]]
    {
        let mut header = vec![0; 544];
        let mut put = |at: usize, bytes: &[u8]| header[at..at + bytes.len()].copy_from_slice(bytes);
        put(0, &540i32.to_le_bytes());
        put(4, b"n+2\0\r\n\x1a\n");
        put(12, &[4i16.to_le_bytes(), 16i16.to_le_bytes()].concat());
        put(16, &[3, sizes[0], sizes[1], sizes[2], 1, 1, 1, 1].map(i64::to_le_bytes).concat());
        put(104, &[1.0f64; 4].map(f64::to_le_bytes).concat());
        put(168, &544i64.to_le_bytes());
        refuse(&scratch, "a.nii", &header);
        let zipped = scratch.file("a.nii.gz", &gzip(&[header, voxels()].concat()));
        scratch.refuses(EXIT_FAILURE, &zipped, "");
    }
}

#[test]
fn dicom_elements_that_claim_too_much_or_nonsense() {
    let scratch = Scratch::new();
    let sound = dicom_slice(0);
    let element = |tag: u16| {
        let start = [0x28, 0, tag as u8, (tag >> 8) as u8, b'U', b'S', 2, 0];
        sound.windows(8).position(|bytes| bytes == start).expect("it is there") + 8
    };
    for (tag, value) in [
        (0x10, 0),
        (0x10, 65_535),
        (0x11, 0),
        (0x11, 65_535),
        (0x02, 0),
        (0x02, 3),
        (0x100, 0),
        (0x100, 7),
        (0x100, 64),
        (0x100, 65_535),
        (0x101, 0),
        (0x101, 99),
        (0x102, 99u16),
    ] {
        let mut file = sound.clone();
        file[element(tag)..element(tag) + 2].copy_from_slice(&value.to_le_bytes());
        let path = scratch.file("a.dcm", &file);
        let message = scratch.refuses(EXIT_FAILURE, &path, "");
        assert!(message.contains("a.dcm"), "{tag:#x} = {value}: {message}");
    }
    let pixel_data_length = sound.len() - 240 - 4;
    for length in [u32::MAX, 238, 0] {
        let mut file = sound.clone();
        file[pixel_data_length..pixel_data_length + 4].copy_from_slice(&length.to_le_bytes());
        let path = scratch.file("a.dcm", &file);
        scratch.refuses(EXIT_FAILURE, &path, "");
    }
}

#[test]
fn sequences_nested_a_thousand_deep_do_not_exhaust_the_stack() {
    let scratch = Scratch::new();
    let sound = dicom_slice(0);
    let pixel_data = sound.len() - 240 - 12;
    let open = [
        &[0x28, 0, 0x10, 0x30, b'S', b'Q', 0, 0, 255, 255, 255, 255][..],
        &[254, 255, 0, 224, 255, 255, 255, 255],
    ];
    let nested = open.concat().repeat(100_000);
    let path = scratch.file("a.dcm", &[&sound[..pixel_data], &nested].concat());
    scratch.refuses(EXIT_FAILURE, &path, "");
}

#[test]
fn raw_layouts_that_the_file_does_not_fill() {
    let scratch = Scratch::new();
    let path = scratch.file("a.raw", &voxels());
    for flags in [
        "--extent 100000x100000x100000 --dtype u8",
        "--extent 4294967295x4294967295x4294967295 --dtype f64",
        "--extent 12x10x9 --dtype i16",
        "--extent 12x10x8 --dtype u32",
        "--extent 12x10x8 --dtype i16 --offset 1",
        "--extent 12x10x8 --dtype i16 --offset 18446744073709551615",
    ] {
        let message = scratch.refuses(EXIT_FAILURE, &path, flags);
        assert!(message.contains("a.raw"), "{message}");
    }
}
