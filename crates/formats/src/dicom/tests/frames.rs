use std::fs;

use glassbrick_volume::{Endian, StoredType, VolumeReader};

use super::super::tag;
use super::written::{
    BIG_ENDIAN, COLUMNS, DEFLATED, EXPLICIT, Folder, HIGH_THROUGHPUT, IMPLICIT, JPEG_2000, JPEG_BASELINE,
    JPEG_LOSSLESS, RLE, ROWS, VOXELS, Written, bytes, has_note, levels, voxels,
};

/// The voxels that a volume's placement leads to, in this machine's byte order.
fn placed_bytes(reader: &dyn VolumeReader) -> Vec<u8> {
    let placement = reader.flat_placement().expect("voxels that lie as they are");
    let slice_bytes = reader.desc().slice_bytes() as usize;
    let mut placed = Vec::new();
    for piece in &placement.pieces {
        let file = fs::read(&piece.path).expect("the piece's file");
        let start = piece.offset_bytes as usize;
        placed.extend_from_slice(&file[start..start + slice_bytes * piece.slices as usize]);
    }
    if placement.endian != Endian::NATIVE {
        placed.chunks_exact_mut(reader.desc().stored_type.bytes()).for_each(<[u8]>::reverse);
    }
    placed
}

#[test]
fn a_placement_leads_to_the_very_voxels_that_are_decoded() {
    for (transfer_syntax, endian) in
        [(EXPLICIT, Endian::Little), (IMPLICIT, Endian::Little), (BIG_ENDIAN, Endian::Big)]
    {
        let folder = Folder::new();
        for level in 0..3 {
            let ramp: Vec<u16> = (0..VOXELS as u16).map(|voxel| voxel * 1000 + level).collect();
            let slice = Written::slice(f64::from(level), level as i16).voxels16(&ramp);
            folder.write_as(transfer_syntax, &format!("{level}"), slice);
        }
        let mut reader = folder.open();
        let placed = placed_bytes(reader.as_ref());
        assert_eq!(
            reader.flat_placement().map(|placement| (placement.endian, placement.pieces.len())),
            Some((endian, 3))
        );
        assert_eq!(bytes(reader.as_mut()), placed);
        assert_eq!(voxels(folder.open())[VOXELS + 2], 2001);
    }
}

#[test]
fn twelve_signed_bits_beside_others_are_extracted_and_not_read_in_place() {
    let folder = Folder::new();
    let slice = Written::slice(0.0, 0).bits(16, 12, true);
    folder.write("0", slice.voxels16(&[0x0FFF, 0x0800, 0x07FF, 0xF001, 0, 0, 0, 0, 0, 0, 0, 0]));
    let reader = folder.open();
    assert!(reader.flat_placement().is_none());
    assert_eq!(voxels(reader)[..4], [-1, -2048, 2047, 1]);
}

#[test]
fn twelve_bits_beside_nothing_but_their_sign_are_read_in_place() {
    let folder = Folder::new();
    let slice = Written::slice(0.0, 0).bits(16, 12, true);
    folder.write("0", slice.voxels16(&[0xFFFF, 0xF800, 0x07FF, 1, 0, 0, 0, 0, 0, 0, 0, 0]));
    let mut reader = folder.open();
    assert_eq!(placed_bytes(reader.as_ref()), bytes(reader.as_mut()));
    assert_eq!(voxels(folder.open())[..4], [-1, -2048, 2047, 1]);
}

#[test]
fn bytes_in_big_endian_words_are_put_in_order() {
    let folder = Folder::new();
    let ramp: Vec<u16> = (0..VOXELS as u16 / 2).map(|pair| ((2 * pair + 1) << 8) | (2 * pair)).collect();
    let slice = Written::slice(0.0, 0).bits(8, 8, false).voxels16(&ramp);
    folder.write_as(BIG_ENDIAN, "0", slice);
    let mut reader = folder.open();
    assert!(reader.flat_placement().is_none());
    assert_eq!(bytes(reader.as_mut()), (0..VOXELS as u8).collect::<Vec<_>>());
}

#[test]
fn floating_point_voxels_are_read() {
    let folder = Folder::new();
    let values: Vec<f32> = (0..VOXELS).map(|voxel| voxel as f32 * 0.5).collect();
    let slice = Written::slice(0.0, 0).without(tag::PIXEL_DATA);
    folder
        .write("0", slice.set(tag::FLOAT_PIXEL_DATA, dicom_core::PrimitiveValue::F32(values.clone().into())));
    let mut reader = folder.open();
    assert_eq!(reader.desc().stored_type, StoredType::F32);
    assert_eq!(placed_bytes(reader.as_ref()), bytes(reader.as_mut()));
    let expected: Vec<u8> = values.into_iter().flat_map(f32::to_ne_bytes).collect();
    assert_eq!(bytes(folder.open().as_mut()), expected);
}

#[test]
fn deflated_files_are_inflated() {
    let folder = Folder::new();
    for level in 0..2 {
        folder.write_as(DEFLATED, &format!("{level}"), Written::slice(f64::from(level), level));
    }
    assert!(folder.open().flat_placement().is_none());
    assert_eq!(levels(folder.open()), [0, 1]);
    let mut reader = folder.open();
    bytes(reader.as_mut());
    let files_bytes: u64 =
        (0..2).map(|level| fs::metadata(folder.path().join(format!("{level}"))).expect("a file").len()).sum();
    assert!((1..files_bytes).contains(&reader.bytes_read()), "{} of {files_bytes}", reader.bytes_read());
}

#[test]
fn run_length_frames_are_decoded_each_from_its_own_fragment() {
    let plane = |high: u8, low: u8| {
        let mut encoded = vec![0; 64];
        encoded[0] = 2;
        encoded[4] = 64;
        encoded[8] = 66;
        // A run of twelve is written as 1 - 12.
        encoded.extend_from_slice(&[0xF5, high, 0xF5, low]);
        encoded
    };
    let folder = Folder::new();
    let frames = [plane(0x12, 0x34), plane(0x01, 0x02)];
    let slice = Written::slice(0.0, 0).set(tag::NUMBER_OF_FRAMES, "2").set(tag::SPACING_BETWEEN_SLICES, "3");
    folder.write_as(RLE, "0", slice.fragments(&[], &[&frames[0], &frames[1]]));
    assert_eq!(folder.open().desc().spacing_mm.z, 3.0);
    let mut reader = folder.open();
    bytes(reader.as_mut());
    assert_eq!(reader.bytes_read(), 2 * 68, "the bytes of both fragments");
    assert_eq!(levels(folder.open()), [0x1234, 0x0102]);
}

/// 0, 300, 600 … 3300 in 12 bits, lossless JPEG.
const LOSSLESS_JPEG: &str = "ffd8ffc4001700010101010000000000000000000000000a090b0cffc3000b0c0003000401001100ffda0008010000060000\
     e7ff00a594b29669609612c258d2c12c2584b0ffd9";
/// -300, -200 … 800 in 16 bits, lossless JPEG 2000.
const LOSSLESS_JPEG_2000: &str = "ff4fff5100290000000000040000000300000000000000000000000400000003000000000000000000018f0101ff52000c00\
     000001000004040001ff5c00044080ff90000a0000000000210001ff93c07ec1e0131dd67600f195a0339dd8c3ebef99ffd9";
/// 0, 300, 600 … 3300 in 16 bits, lossless High-Throughput JPEG 2000.
const HIGH_THROUGHPUT_JPEG_2000: &str = "ff4fff5100294000000000040000000300000000000000000000000400000003000000000000000000010f0101ff50000800\
     020000000aff52000c00020001000504044001ff5c00132088909090909090909090909090888888ff90000a000000000038\
     0001ff93c00026fbf305077400000000c000134000130044fd02877400bef203877400c000270056acfc02027400ffd9";
/// 130 everywhere in 8 bits, baseline JPEG.
const BASELINE_JPEG: &str = "ffd8ffdb0043000302020302020303030304030304050805050404050a070706080c0a0c0c0b0a0b0b0d0e12100d0e110e0b\
     0b1016101113141515150c0f171816141812141514ffc0000b080003000401011100ffc4001f000001050101010101010000\
     0000000000000102030405060708090a0bffc400b5100002010303020403050504040000017d010203000411051221314106\
     13516107227114328191a1082342b1c11552d1f02433627282090a161718191a25262728292a3435363738393a4344454647\
     48494a535455565758595a636465666768696a737475767778797a838485868788898a92939495969798999aa2a3a4a5a6a7\
     a8a9aab2b3b4b5b6b7b8b9bac2c3c4c5c6c7c8c9cad2d3d4d5d6d7d8d9dae1e2e3e4e5e6e7e8e9eaf1f2f3f4f5f6f7f8f9fa\
     ffda0008010100003f0096bfffd9";

fn from_hex(text: &str) -> Vec<u8> {
    let digits: Vec<u8> = text.bytes().filter(u8::is_ascii_hexdigit).collect();
    let byte =
        |pair: &[u8]| std::str::from_utf8(pair).ok().and_then(|pair| u8::from_str_radix(pair, 16).ok());
    digits.chunks(2).map(|pair| byte(pair).expect("two digits")).collect()
}

#[test]
fn lossless_jpeg_gives_every_bit_even_from_two_fragments() {
    let encoded = from_hex(LOSSLESS_JPEG);
    let (one, other) = encoded.split_at(40);
    let folder = Folder::new();
    let slice = Written::slice(0.0, 0).bits(16, 12, false).fragments(&[0], &[one, other]);
    folder.write_as(JPEG_LOSSLESS, "0", slice);
    assert!(folder.open().flat_placement().is_none());
    assert_eq!(voxels(folder.open()), (0..12).map(|voxel| voxel * 300).collect::<Vec<_>>());
}

#[test]
fn lossless_jpeg_2000_keeps_signs() {
    let folder = Folder::new();
    let encoded = from_hex(LOSSLESS_JPEG_2000);
    folder.write_as(JPEG_2000, "0", Written::slice(0.0, 0).fragments(&[0], &[&encoded]));
    assert_eq!(voxels(folder.open()), (0..12).map(|voxel| voxel * 100 - 300).collect::<Vec<_>>());
}

#[test]
fn high_throughput_jpeg_2000_gives_every_bit() {
    let folder = Folder::new();
    let encoded = from_hex(HIGH_THROUGHPUT_JPEG_2000);
    let slice = Written::slice(0.0, 0).bits(16, 16, false).fragments(&[0], &[&encoded]);
    folder.write_as(HIGH_THROUGHPUT, "0", slice);
    assert_eq!(voxels(folder.open()), (0..12).map(|voxel| voxel * 300).collect::<Vec<_>>());
}

#[test]
fn eight_bits_of_jpeg_are_widened_to_those_allocated() {
    let encoded = from_hex(BASELINE_JPEG);
    let folder = Folder::new();
    folder.write_as(
        JPEG_BASELINE,
        "0",
        Written::slice(0.0, 0).bits(16, 8, false).fragments(&[0], &[&encoded]),
    );
    assert_eq!(voxels(folder.open()), [130; VOXELS]);
}

#[test]
fn a_compressed_frame_of_another_size_is_refused() {
    for (transfer_syntax, encoded) in
        [(JPEG_BASELINE, BASELINE_JPEG), (JPEG_LOSSLESS, LOSSLESS_JPEG), (JPEG_2000, LOSSLESS_JPEG_2000)]
    {
        let folder = Folder::new();
        let slice =
            Written::slice(0.0, 0).set(tag::ROWS, 2 * ROWS as u16).fragments(&[0], &[&from_hex(encoded)]);
        folder.write_as(transfer_syntax, "0", slice);
        let refusal = folder.refusal();
        assert!(refusal.contains(&format!("{COLUMNS}×6")), "{refusal}");
    }
}

#[test]
fn black_meant_as_white_is_told() {
    let folder = Folder::new();
    folder.write("0", Written::slice(0.0, 0).set(tag::PHOTOMETRIC_INTERPRETATION, "MONOCHROME1"));
    assert!(has_note(folder.open().as_ref(), "MONOCHROME1"));
}
