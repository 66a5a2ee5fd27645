//! The front door, and what no file may do to any reader.

use std::io::Write;
use std::path::{Path, PathBuf};

use glam::{DVec3, UVec3};
use glassbrick_volume::{Endian, Rescale, StoredType, VolumeReader};

use crate::{OpenOptions, RawLayout, open};

/// A folder that is removed with its files.
pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub fn path(&self) -> &Path {
        self.0.path()
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    /// Writes a file, and opens it at its first time step.
    pub fn open(&self, name: &str, bytes: impl AsRef<[u8]>) -> Box<dyn VolumeReader> {
        let path = self.write(name, bytes);
        open(&path, &OpenOptions::default()).unwrap_or_else(|error| panic!("{error}"))
    }

    /// Writes a file that must be refused, and gives the message.
    pub fn refusal(&self, name: &str, bytes: impl AsRef<[u8]>) -> String {
        refusal(&self.write(name, bytes), &OpenOptions::default())
    }
}

pub(crate) fn refusal(path: &Path, options: &OpenOptions) -> String {
    let message = match open(path, options) {
        Ok(_) => panic!("{} is read, but should not be", path.display()),
        Err(error) => error.to_string(),
    };
    assert!(
        !message.contains('\n') && message.starts_with(path.parent().unwrap().to_str().unwrap()),
        "{message}"
    );
    message
}

pub(crate) fn at_time(time: u32) -> OpenOptions {
    OpenOptions { raw: None, time: Some(time) }
}

/// All voxels, read slice by slice.
pub(crate) fn voxels(mut reader: Box<dyn VolumeReader>) -> Vec<u8> {
    let mut voxels = vec![0; reader.desc().bytes() as usize];
    for slice in voxels.chunks_mut(reader.desc().slice_bytes() as usize) {
        reader.read_slices(slice).unwrap_or_else(|error| panic!("{error}"));
    }
    assert!(reader.read_slices(&mut vec![0; reader.desc().slice_bytes() as usize]).is_err());
    voxels
}

pub(crate) fn native(values: impl IntoIterator<Item = i16>) -> Vec<u8> {
    values.into_iter().flat_map(i16::to_ne_bytes).collect()
}

pub(crate) fn big(values: impl IntoIterator<Item = i16>) -> Vec<u8> {
    values.into_iter().flat_map(i16::to_be_bytes).collect()
}

pub(crate) fn little(values: impl IntoIterator<Item = i16>) -> Vec<u8> {
    values.into_iter().flat_map(i16::to_le_bytes).collect()
}

pub(crate) fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

pub(crate) fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

pub(crate) fn bzip2(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::fast());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

/// Changes each byte of a header to a few others, and opens and reads what comes out; nothing may panic.
pub(crate) fn no_change_of_a_byte_panics(name: &str, file: &[u8], header_bytes: usize) {
    let folder = Folder::new();
    for byte in 0..header_bytes.min(file.len()) {
        for value in [0, 1, b'9', b'-', b' ', b'\n', 0x7f, 0xff, file[byte] ^ 0x80] {
            let mut changed = file.to_vec();
            changed[byte] = value;
            read_if_small(&folder.write(name, &changed));
        }
    }
    for length in 0..file.len() {
        read_if_small(&folder.write(name, &file[..length]));
    }
}

fn read_if_small(path: &Path) {
    if let Ok(mut reader) = open(path, &OpenOptions::default())
        && reader.desc().bytes() < 1 << 20
    {
        let mut voxels = vec![0; reader.desc().bytes() as usize];
        let _ = reader.read_slices(&mut voxels);
    }
}

fn raw_options(layout: RawLayout) -> OpenOptions {
    OpenOptions { raw: Some(layout), time: None }
}

fn raw_layout() -> RawLayout {
    RawLayout {
        extent: UVec3::new(2, 2, 3),
        stored_type: StoredType::I16,
        endian: Endian::Big,
        spacing_mm: DVec3::new(1.0, 2.0, 3.0),
        offset_bytes: 5,
        rescale: Rescale { slope: 2.0, intercept: -1.0 },
    }
}

#[test]
fn raw_voxels_are_read_as_the_user_says() {
    let folder = Folder::new();
    let file = [b"skip!".as_slice(), &big(0..12), b"tail"].concat();
    let path = folder.write("a.raw", &file);
    let reader = open(&path, &raw_options(raw_layout())).unwrap();
    assert_eq!(reader.desc().spacing_mm, DVec3::new(1.0, 2.0, 3.0));
    assert_eq!(reader.desc().rescale.value(3.0), 5.0);
    assert!(reader.notes()[0].starts_with("4 bytes follow"));
    let placement = reader.flat_placement().unwrap();
    assert_eq!((placement.pieces[0].offset_bytes, placement.pieces[0].slices), (5, 3));
    assert_eq!(placement.endian, Endian::Big);
    assert_eq!(voxels(reader), native(0..12));

    for (name, packed) in [("a.raw.gz", gzip(&file)), ("a.raw.bz2", bzip2(&file))] {
        let reader = open(&folder.write(name, packed), &raw_options(raw_layout())).unwrap();
        assert!(reader.flat_placement().is_none());
        assert_eq!(voxels(reader), native(0..12));
    }
}

/// A compressed NRRD of 32 by 16 by 3 voxels, but for its data.
fn noise_header(encoding: &str) -> Vec<u8> {
    format!("NRRD0004\ntype: short\nendian: little\ndimension: 3\nsizes: 32 16 3\nencoding: {encoding}\n\n")
        .into_bytes()
}

/// Voxels for it in which nothing repeats for long.
fn noise() -> Vec<u8> {
    little((0..32 * 16 * 3).map(|voxel| (voxel * 7919 % 3001) as i16))
}

fn try_voxels(path: &Path) -> Option<Vec<u8>> {
    let mut reader = open(path, &OpenOptions::default()).ok()?;
    let mut voxels = vec![0; reader.desc().bytes() as usize];
    reader.read_slices(&mut voxels).ok().map(|()| voxels)
}

#[test]
fn damage_anywhere_in_a_compressed_stream_is_seen() {
    let folder = Folder::new();
    let voxels = noise();
    let sound = try_voxels(&folder.write("raw.nrrd", [noise_header("raw"), noise()].concat()));
    for (encoding, packed) in [
        ("gzip", gzip(&voxels)),
        ("gzip", zlib(&voxels)),
        ("bzip2", bzip2(&voxels)),
        ("gzip", gzip(&[voxels.as_slice(), &voxels].concat())),
    ] {
        let header = noise_header(encoding);
        let file = [header.as_slice(), &packed].concat();
        let path = folder.write("a.nrrd", &file);
        assert!(sound.is_some() && try_voxels(&path) == sound, "{encoding} is sound");
        for byte in header.len()..file.len() {
            let mut damaged = file.clone();
            damaged[byte] ^= 0x55;
            folder.write("a.nrrd", damaged);
            let read = try_voxels(&path);
            assert!(read.is_none() || read == sound, "{encoding}: byte {byte} of {}", file.len());
        }
    }
}

#[test]
fn what_was_read_is_counted_before_decoding() {
    let folder = Folder::new();
    for (encoding, packed) in [("gzip", gzip(&noise())), ("bzip2", bzip2(&noise()))] {
        let bytes = packed.len() as u64;
        let mut reader = folder.open("a.nrrd", [noise_header(encoding), packed].concat());
        assert_eq!(reader.bytes_read(), 0);
        reader.read_slices(&mut vec![0; noise().len()]).unwrap();
        assert_eq!(reader.bytes_read(), bytes, "{encoding}");
    }
}

#[test]
fn what_follows_far_behind_the_voxels_is_not_looked_at() {
    let folder = Folder::new();
    let mut packed = gzip(&[noise(), vec![0; 4 << 20]].concat());
    let sum = packed.len() - 8;
    packed[sum] ^= 1;
    assert!(try_voxels(&folder.write("a.nrrd", [noise_header("gzip"), packed].concat())).is_some());
}

#[test]
fn a_raw_file_too_short_or_a_layout_without_sense_is_refused() {
    let folder = Folder::new();
    let path = folder.write("a.raw", [0; 28]);
    assert!(
        refusal(&path, &raw_options(raw_layout()))
            .contains("2x2x3 voxels of i16 from byte 5 on need 29 bytes, but the file has 28")
    );
    for layout in [
        RawLayout { extent: UVec3::ZERO, ..raw_layout() },
        RawLayout { extent: UVec3::MAX, ..raw_layout() },
        RawLayout { extent: UVec3::splat(1 << 22), ..raw_layout() },
        RawLayout { offset_bytes: u64::MAX, ..raw_layout() },
        RawLayout { spacing_mm: DVec3::ZERO, ..raw_layout() },
        RawLayout { spacing_mm: DVec3::NAN, ..raw_layout() },
        RawLayout { rescale: Rescale { slope: 0.0, intercept: 0.0 }, ..raw_layout() },
    ] {
        refusal(&path, &raw_options(layout));
    }
    let path = folder.write("a.raw", [0; 29]);
    assert!(
        refusal(&path, &OpenOptions { time: Some(1), ..raw_options(raw_layout()) }).contains("one volume")
    );
}

#[test]
fn a_file_that_looks_like_a_format_is_raw_when_the_user_says_so() {
    let folder = Folder::new();
    let path = folder.write("a.nrrd", "NRRD0004\n and twenty bytes and more of voxels");
    let reader = open(&path, &raw_options(raw_layout())).unwrap();
    assert!(reader.notes().iter().any(|note| note.contains("looks like NRRD")));
}

#[test]
fn what_is_not_read_is_named() {
    let folder = Folder::new();
    for (name, bytes, expected) in [
        ("a.tif", b"II*\0\x08\0\0\0".as_slice(), "TIFF"),
        ("a.vti", b"<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\">", "VTI"),
        ("a.png", b"\x89PNG\r\n\x1a\n", "PNG"),
        ("a.zip", b"PK\x03\x04", "zip"),
        ("a.slc", b"\x01\xff\x80", "SLC"),
        ("a.czi", b"ZISRAWFILE", "CZI"),
        ("a.txt", b"words", "text"),
        ("a.raw", b"", "empty"),
        ("a.gz", &gzip(b"words"), "gzip"),
        ("a.dat", b"\x01\xff\x80", "--extent and --dtype"),
    ] {
        let message = folder.refusal(name, bytes);
        assert!(message.contains(expected), "{message}");
    }
    let missing = refusal(&folder.path().join("missing.nrrd"), &OpenOptions::default());
    assert!(missing.contains("cannot be read") && missing.ends_with("; check the path"), "{missing}");
}

#[test]
fn a_folder_without_a_volume_is_refused() {
    let folder = Folder::new();
    folder.write("readme", "words");
    assert!(refusal(folder.path(), &OpenOptions::default()).contains("no DICOM file"));
    folder.write("zarr.json", "{}");
    assert!(refusal(folder.path(), &OpenOptions::default()).contains("save one of its arrays"));
}

#[test]
fn a_reader_refuses_parts_of_slices_and_too_many() {
    let folder = Folder::new();
    let path = folder.write("a.raw", [0; 29]);
    let mut reader = open(&path, &raw_options(raw_layout())).unwrap();
    assert!(reader.read_slices(&mut [0; 7]).is_err());
    assert!(reader.read_slices(&mut [0; 32]).is_err());
    assert!(reader.read_slices(&mut [0; 24]).is_ok());
    assert!(reader.read_slices(&mut [0; 8]).is_err());
}
