//! One small volume in every format, to be broken.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::{GzEncoder, ZlibEncoder};

/// Voxels along x, y and z.
pub const EXTENT: [usize; 3] = [12, 10, 8];
const VOXELS: usize = EXTENT[0] * EXTENT[1] * EXTENT[2];
const BYTES: usize = 2 * VOXELS;

/// A volume in files.
pub struct SoundFile {
    /// The file to open.
    pub path: PathBuf,
    /// The one to break, which may be a companion.
    pub breakable: PathBuf,
    /// What must be said on the command line.
    pub flags: &'static str,
    pub is_compressed: bool,
}

/// Whole numbers of 16 bits, little endian, in which nothing repeats for long.
pub fn voxels() -> Vec<u8> {
    (0..VOXELS as u64).flat_map(|voxel| ((voxel * 7919 % 3001) as i16).to_le_bytes()).collect()
}

/// The volume in every format, in `folder`.
pub fn all(folder: &Path) -> Vec<SoundFile> {
    let write = |name: &str, bytes: Vec<u8>| {
        let path = folder.join(name);
        fs::write(&path, bytes).expect("a scratch file");
        path
    };
    let alone = |path: PathBuf| SoundFile { breakable: path.clone(), path, flags: "", is_compressed: false };
    let compressed = |path: PathBuf| SoundFile { is_compressed: true, ..alone(path) };
    let attached = |header: &str, data: Vec<u8>| [header.as_bytes(), &data].concat();
    let beside = |header: PathBuf, data: PathBuf| SoundFile { path: header, ..alone(data) };

    let raw = write("plain.raw", voxels());
    let mut files = vec![SoundFile { flags: "--extent 12x10x8 --dtype i16", ..alone(raw) }];
    files.push(alone(write("attached.nrrd", attached(&nrrd("raw", ""), voxels()))));
    files.push(compressed(write("gzip.nrrd", attached(&nrrd("gzip", ""), gzip(&voxels())))));
    files.push(beside(
        write("detached.nhdr", nrrd("raw", "data file: detached.raw\n").into_bytes()),
        write("detached.raw", voxels()),
    ));
    files.push(alone(write("local.mha", attached(&metaimage("LOCAL", ""), voxels()))));
    files.push(compressed(write(
        "compressed.mha",
        attached(&metaimage("LOCAL", "CompressedData = True\n"), zlib(&voxels())),
    )));
    files.push(beside(
        write("beside.mhd", metaimage("beside.raw", "").into_bytes()),
        write("beside.raw", voxels()),
    ));
    let single = || [nifti("n+1\0", 352.0), vec![0; 4], voxels()].concat();
    files.push(alone(write("single.nii", single())));
    files.push(compressed(write("gzip.nii.gz", gzip(&single()))));
    files.push(beside(write("pair.hdr", nifti("ni1\0", 0.0)), write("pair.img", voxels())));
    files.push(alone(write("slice.dcm", dicom_slice(3))));
    files
}

/// The headers among them, which are broken too.
pub fn headers(folder: &Path) -> Vec<SoundFile> {
    let companions = all(folder).into_iter().filter(|file| file.breakable != file.path);
    companions.map(|file| SoundFile { breakable: file.path.clone(), ..file }).collect()
}

pub fn nrrd(encoding: &str, more: &str) -> String {
    format!(
        "NRRD0004\ntype: short\ndimension: 3\nsizes: 12 10 8\nendian: little\nencoding: {encoding}\n\
         spacings: 1 1 2\n{more}\n"
    )
}

pub fn metaimage(data_file: &str, more: &str) -> String {
    format!(
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 12 10 8\nElementSpacing = 1 1 2\n{more}\
         ElementType = MET_SHORT\nElementDataFile = {data_file}\n"
    )
}

/// A NIfTI-1 header of 348 bytes.
pub fn nifti(magic: &str, vox_offset: f32) -> Vec<u8> {
    let mut header = vec![0; 348];
    let mut put = |at: usize, bytes: &[u8]| header[at..at + bytes.len()].copy_from_slice(bytes);
    put(0, &348i32.to_le_bytes());
    for (number, size) in [3, 12, 10, 8, 1, 1, 1, 1i16].into_iter().enumerate() {
        put(40 + 2 * number, &size.to_le_bytes());
    }
    put(70, &4i16.to_le_bytes());
    put(72, &16i16.to_le_bytes());
    for (number, size) in [1.0, 1.0, 1.0, 2.0f32].into_iter().enumerate() {
        put(76 + 4 * number, &size.to_le_bytes());
    }
    put(108, &vox_offset.to_le_bytes());
    put(112, &1.0f32.to_le_bytes());
    put(344, magic.as_bytes());
    header
}

/// One slice of the volume as DICOM, Explicit VR Little Endian.
pub fn dicom_slice(number: usize) -> Vec<u8> {
    let slice_bytes = BYTES / EXTENT[2];
    let position = format!("0\\0\\{}", 2 * number);
    let (rows, columns) = (EXTENT[1] as u16, EXTENT[0] as u16);
    let group_2 = element(2, 0x10, b"UI", b"1.2.840.10008.1.2.1\0");
    let mut file = vec![0; 128];
    file.extend(b"DICM");
    file.extend(element(2, 0, b"UL", &(group_2.len() as u32).to_le_bytes()));
    file.extend(group_2);
    file.extend(element(0x08, 0x16, b"UI", b"1.2.840.10008.5.1.4.1.1.2\0"));
    file.extend(element(0x08, 0x60, b"CS", b"CT"));
    file.extend(element(0x20, 0x0e, b"UI", b"1.2.3.4\0"));
    file.extend(element(0x20, 0x13, b"IS", format!("{:<2}", number + 1).as_bytes()));
    file.extend(element(0x20, 0x32, b"DS", padded(&position).as_bytes()));
    file.extend(element(0x20, 0x37, b"DS", padded("1\\0\\0\\0\\1\\0").as_bytes()));
    for (tag, value) in [(2, 1), (0x10, rows), (0x11, columns)] {
        file.extend(element(0x28, tag, b"US", &value.to_le_bytes()));
        if tag == 2 {
            file.extend(element(0x28, 4, b"CS", b"MONOCHROME2 "));
        }
    }
    file.extend(element(0x28, 0x30, b"DS", b"1\\1 "));
    for (tag, value) in [(0x100, 16), (0x101, 16), (0x102, 15), (0x103, 1u16)] {
        file.extend(element(0x28, tag, b"US", &value.to_le_bytes()));
    }
    let voxels = &voxels()[number * slice_bytes..(number + 1) * slice_bytes];
    file.extend(element(0x7fe0, 0x10, b"OW", voxels));
    file
}

fn padded(text: &str) -> String {
    if text.len().is_multiple_of(2) { text.to_owned() } else { format!("{text} ") }
}

/// A data element in Explicit VR Little Endian; its value has an even length.
pub fn element(group: u16, tag: u16, vr: &[u8; 2], value: &[u8]) -> Vec<u8> {
    let mut element = [group.to_le_bytes(), tag.to_le_bytes(), *vr].concat();
    if matches!(vr, b"OW" | b"OB") {
        element.extend([0; 2]);
        element.extend((value.len() as u32).to_le_bytes());
    } else {
        element.extend((value.len() as u16).to_le_bytes());
    }
    element.extend(value);
    element
}

pub fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).expect("memory takes it");
    encoder.finish().expect("memory takes it")
}

pub fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::fast());
    encoder.write_all(bytes).expect("memory takes it");
    encoder.finish().expect("memory takes it")
}
