use glam::{DMat3, DVec3, UVec3};

use crate::open;
use crate::tests::{
    Folder, at_time, big, bzip2, gzip, little, native, no_change_of_a_byte_panics, refusal, voxels,
};

/// A 2×2×3 volume of i16, with more fields, attached.
fn attached(fields: &str, data: impl AsRef<[u8]>) -> Vec<u8> {
    [header(fields).as_bytes(), b"\n", data.as_ref()].concat()
}

fn header(fields: &str) -> String {
    let fields = fields.trim_end();
    format!("NRRD0004\n# a comment: of words\ntype: int16\ndimension: 3\nsizes: 2 2 3\n{fields}\n")
}

const ENDIAN: &str = "endian: little\n";

#[test]
fn every_encoding_gives_the_same_voxels() {
    let folder = Folder::new();
    let raw = little(-3..9);
    let hex: String = raw.iter().map(|byte| format!("{byte:02X}\n")).collect();
    for (encoding, data) in [
        ("raw", raw.clone()),
        ("gzip", gzip(&raw)),
        ("gz", gzip(&raw)),
        ("bzip2", bzip2(&raw)),
        ("bz2", bzip2(&raw)),
        ("ascii", b"-3 -2 -1 0\n1 2 3 4 5 6 7 8".to_vec()),
        ("text", b"-3,-2,-1,0,1,2,3,4,5,6,7,8\n".to_vec()),
        ("hex", hex.into_bytes()),
    ] {
        let reader =
            folder.open("a.nrrd", attached(&format!("encoding: {encoding}\n{ENDIAN}key:=a: b"), data));
        assert_eq!(reader.flat_placement().is_some(), encoding == "raw");
        assert_eq!(reader.desc().extent, UVec3::new(2, 2, 3));
        assert_eq!(voxels(reader), native(-3..9), "{encoding}");
    }
    let reader = folder.open("a.nrrd", attached("encoding: raw\nendian: big", big(-3..9)));
    assert_eq!(voxels(reader), native(-3..9));
}

#[test]
fn every_spelling_of_a_type_is_known() {
    let folder = Folder::new();
    for (names, bytes) in [
        ("uchar,unsigned char,uint8,uint8_t,signed char,int8,int8_t", 1),
        ("short,short int,signed short,signed short int,int16,int16_t", 2),
        ("ushort,unsigned short,unsigned short int,uint16,uint16_t", 2),
        ("int,signed int,int32,int32_t,uint,unsigned int,uint32,uint32_t,float", 4),
        ("double", 8),
    ] {
        for name in names.split(',') {
            let file = format!("NRRD0001\ntype: {name}\ndimension: 2\nsizes: 1 1\nencoding: raw\n{ENDIAN}\n");
            let reader = folder.open("a.nrrd", [file.as_bytes(), &[0; 8]].concat());
            assert_eq!(reader.desc().bytes(), bytes, "{name}");
        }
    }
    for name in ["block", "longlong", "unsigned long long", "uint64_t", "half"] {
        let file = format!("NRRD0001\ntype: {name}\ndimension: 2\nsizes: 1 1\nencoding: raw\n{ENDIAN}\n");
        assert!(folder.refusal("a.nrrd", [file.as_bytes(), &[0; 8]].concat()).contains(name));
    }
}

#[test]
fn detached_voxels_are_found_in_files_lists_and_patterns() {
    let folder = Folder::new();
    let raw = little(0..12);
    folder.write("all.raw", &raw);
    folder.write("late.raw", [b"a line\nand a second\n12345678", raw.as_slice()].concat());
    folder.write("late.gz", [b"a line\n".as_slice(), &gzip(&[b"12345", raw.as_slice()].concat())].concat());
    for slice in 0..3 {
        folder.write(&format!("s{:02}.raw", slice + 1), &raw[8 * slice..8 * slice + 8]);
    }
    for (fields, pieces) in [
        ("encoding: raw\ndata file: ./all.raw", 1),
        ("encoding: raw\nline skip: 2\nbyteskip: 8\ndatafile: late.raw", 1),
        ("encoding: raw\nbyte skip: -1\ndata file: late.raw", 1),
        ("encoding: gzip\nline skip: 1\nbyte skip: 5\ndata file: late.gz", 0),
        ("encoding: raw\ndata file: LIST\ns01.raw\ns02.raw\ns03.raw", 3),
        ("encoding: raw\ndata file: LIST 2\ns01.raw\ns02.raw\ns03.raw\n", 3),
        ("encoding: raw\ndata file: LIST 3\nall.raw", 1),
        ("encoding: raw\ndata file: s%02d.raw 1 3 1", 3),
        ("encoding: raw\ndata file: s%02d.raw 1 3 1 2", 3),
    ] {
        let reader = folder.open("a.nhdr", header(&format!("{ENDIAN}{fields}")));
        assert_eq!(reader.flat_placement().map_or(0, |placement| placement.pieces.len()), pieces, "{fields}");
        assert_eq!(voxels(reader), native(0..12), "{fields}");
    }
    let reversed =
        folder.open("a.nhdr", header(&format!("{ENDIAN}encoding: raw\ndata file: s%02d.raw 3 1 -1")));
    assert_eq!(voxels(reversed), native((8..12).chain(4..8).chain(0..4)));
}

#[test]
fn data_files_that_are_missing_outside_or_too_few_are_refused() {
    let folder = Folder::new();
    folder.write("s1.raw", [0; 8]);
    for (data_file, expected) in [
        ("missing.raw", "missing.raw"),
        ("../a.raw", "outside"),
        ("/etc/passwd", "outside"),
        ("s1.raw", "ends after 8"),
        ("LIST\ns1.raw", "1 files"),
        ("LIST 9\ns1.raw", "dimension per file"),
        ("s%d.raw 1 2 1", "2 files"),
        ("s%d.raw 1 9999999999 1", "one file per slice"),
        ("s%d%s.raw 1 3 1", "one file per slice"),
        ("s%d.raw 1 3 1", "s2.raw"),
    ] {
        let message =
            folder.refusal("a.nhdr", header(&format!("{ENDIAN}encoding: raw\ndata file: {data_file}")));
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn every_space_is_taken_to_lps() {
    let folder = Folder::new();
    for (space, signs) in [
        ("space: right-anterior-superior", [-1.0, -1.0, 1.0]),
        ("space: RAS", [-1.0, -1.0, 1.0]),
        ("space: left-anterior-superior", [1.0, -1.0, 1.0]),
        ("space: LAS", [1.0, -1.0, 1.0]),
        ("space: left-posterior-superior", [1.0, 1.0, 1.0]),
        ("space: LPS", [1.0, 1.0, 1.0]),
        ("space: scanner-xyz", [1.0, 1.0, 1.0]),
        ("space: 3D-left-handed", [1.0, 1.0, 1.0]),
        ("space dimension: 3", [1.0, 1.0, 1.0]),
    ] {
        let fields = format!(
            "{space}\nspace directions: (0,2,0) (1,0,0) (0, 0.5, 3)\nspace origin: (1,2,3)\nencoding: raw\n{ENDIAN}"
        );
        let reader = folder.open("a.nrrd", attached(&fields, little(0..12)));
        let signs = DVec3::from_array(signs);
        let columns = DMat3::from_cols(DVec3::Y * 2.0, DVec3::X, DVec3::new(0.0, 0.5, 3.0));
        let world_from_voxel = reader.desc().world_from_voxel();
        assert!(
            world_from_voxel.matrix3.abs_diff_eq(DMat3::from_diagonal(signs) * columns, 1e-12),
            "{space}"
        );
        assert_eq!(world_from_voxel.translation, signs * DVec3::new(1.0, 2.0, 3.0), "{space}");
        let says_mirrored = reader.notes().iter().any(|note| note.contains("mirrored"));
        assert_eq!(says_mirrored, space.contains("3D-left-handed"), "{space}");
    }
    assert!(
        folder
            .refusal(
                "a.nrrd",
                attached(
                    "space: moon\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nendian: big",
                    [0; 24]
                )
            )
            .contains("moon")
    );
}

#[test]
fn spacings_units_and_ends_of_axes_are_understood() {
    let folder = Folder::new();
    let grid = |fields: &str| {
        let reader =
            folder.open("a.nrrd", attached(&format!("encoding: raw\n{ENDIAN}{fields}"), little(0..12)));
        let desc = reader.desc();
        (desc.spacing_mm.to_array(), desc.origin_mm.to_array(), desc.direction.determinant())
    };
    assert_eq!(grid("spacings: 1 -2 3"), ([1.0, 2.0, 3.0], [0.0; 3], -1.0));
    assert_eq!(grid("spacings: 1 nan 3"), ([1.0, 1.0, 3.0], [0.0; 3], 1.0));
    assert_eq!(grid("axis mins: 0 2 0\naxis maxs: 4 6 9"), ([2.0, 2.0, 3.0], [1.0, 3.0, 1.5], 1.0));
    assert_eq!(
        grid("axismins: 0 2 0\naxis maxs: 4 6 9\ncenters: node node cell"),
        ([4.0, 4.0, 3.0], [0.0, 2.0, 1.5], 1.0)
    );
    assert_eq!(grid("spacings: 1 2 3\nunits: \"cm\" \"µm\" \"mm\"").0, [10.0, 0.002, 3.0]);
    let in_metres = "space: LPS\nspace units: \"m\" \"m\" \"m\"\nspace directions: (1,0,0) (0,1,0) (0,0,2)";
    assert_eq!(grid(in_metres).0, [1000.0, 1000.0, 2000.0]);
}

#[test]
fn a_grid_without_sense_is_refused() {
    let folder = Folder::new();
    for (fields, expected) in [
        ("spacings: 1 0 3", "along y is 0"),
        ("spacings: 1 inf 3", "not finite"),
        ("spacings: 1 2", "2 entries"),
        ("spacings: 1 2 x", "no fitting number"),
        ("space directions: (1,0,0) (1,0,0) (0,0,1)", "one plane"),
        ("space directions: (1,0,0) (0,1,0) 7", "no vector"),
        ("space directions: (1,0,0,0) (0,1,0,0) (0,0,1,1)", "no place in space"),
    ] {
        let message =
            folder.refusal("a.nrrd", attached(&format!("{fields}\nencoding: raw\n{ENDIAN}"), [0; 24]));
        assert!(message.contains(expected), "{message}");
    }
}

/// A 4D array of 3 steps; `step` is the axis that counts them.
fn with_steps(step: usize, fields: &str) -> Vec<u8> {
    let mut sizes = vec![2, 2, 3];
    sizes.insert(step, 3);
    let run: usize = sizes[..step].iter().product();
    let values = (0..36).map(|place| (100 * (place / run % 3) + place % run + place / run / 3 * run) as i16);
    let sizes = sizes.iter().map(usize::to_string).collect::<Vec<_>>().join(" ");
    let head =
        format!("NRRD0005\ntype: short\ndimension: 4\nsizes: {sizes}\nencoding: raw\n{ENDIAN}{fields}\n\n");
    [head.as_bytes(), &little(values)].concat()
}

#[test]
fn a_time_step_is_picked_from_any_axis() {
    let folder = Folder::new();
    for (step, fields) in [
        (0, "kinds: list domain domain domain"),
        (0, "kinds: list domain domain domain\nspace: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)"),
        (2, "kinds: domain domain time domain"),
        (3, "kinds: domain domain domain time"),
        (3, "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1) none"),
        (3, "space: left-posterior-superior-time\nspace directions: (1,0,0,0) (0,1,0,0) (0,0,1,0) (0,0,0,1)"),
        (
            3,
            "space dimension: 4\nspace directions: (1,0,0,0) (0,1,0,0) (0,0,1,0) (0,0,0,1)\nspace origin: (0,0,0,5)",
        ),
        (3, "spacings: 1 1 1 nan"),
    ] {
        let path = folder.write("a.nrrd", with_steps(step, fields));
        for time in 0..3 {
            let reader = open(&path, &at_time(time)).unwrap();
            assert_eq!(reader.flat_placement().is_some(), step == 3);
            let first = 100 * time as i16;
            assert_eq!(voxels(reader), native(first..first + 12), "{fields}");
        }
        assert!(refusal(&path, &at_time(3)).contains("0 to 2"));
        let notes = open(&path, &Default::default()).unwrap().notes().join(" ");
        assert!(notes.contains("3 volumes"), "{notes}");
    }
}

#[test]
fn voxels_of_several_numbers_are_refused() {
    let folder = Folder::new();
    for kind in ["vector", "RGB-color", "3-vector", "3D-symmetric-matrix", "complex", "quaternion"] {
        let message = folder.refusal("a.nrrd", with_steps(0, &format!("kinds: {kind} domain domain domain")));
        assert!(message.contains("save"), "{message}");
    }
    let undecided = with_steps(0, "space: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)");
    assert!(folder.refusal("a.nrrd", undecided).contains("kinds"));
}

#[test]
fn an_image_is_one_slice_and_axes_of_one_sample_are_left_out() {
    let folder = Folder::new();
    let image = "NRRD0004\ntype: uchar\ndimension: 2\nsizes: 2 3\nspacings: 2 3\nencoding: raw\n\nabcdef";
    let reader = folder.open("a.nrrd", image);
    assert_eq!(
        (reader.desc().extent, reader.desc().spacing_mm),
        (UVec3::new(2, 3, 1), DVec3::new(2.0, 3.0, 1.0))
    );
    let stub = "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 1 2 3 1\nkinds: vector domain domain domain\nencoding: raw\n\nabcdef";
    assert_eq!(folder.open("a.nrrd", stub).desc().extent, UVec3::new(2, 3, 1));
    let tilted = "NRRD0004\ntype: uchar\ndimension: 2\nsizes: 2 3\nspace: LPS\nspace directions: (0,1,0) (0,0,1)\nencoding: raw\n\nabcdef";
    assert_eq!(folder.open("a.nrrd", tilted).desc().direction.z_axis, DVec3::X);
}

#[test]
fn headers_that_lie_or_say_too_little_are_refused() {
    let folder = Folder::new();
    let body = "encoding: raw\nendian: little";
    for (head, expected) in [
        ("NRRD0009\n".to_owned(), "NRRD0009"),
        (format!("NRRD0004\ndimension: 3\nsizes: 2 2 3\n{body}\n\n"), "\"type\" is missing"),
        (format!("NRRD0004\ntype: short\nsizes: 2 2 3\n{body}\n\n"), "\"dimension\" is missing"),
        (format!("NRRD0004\ntype: short\ndimension: 3\n{body}\n\n"), "\"sizes\" is missing"),
        (format!("NRRD0004\ntype: short\ndimension: 17\nsizes: 1\n{body}\n\n"), "\"dimension\" is 17"),
        (format!("NRRD0004\ntype: short\ndimension: 3\nsizes: 2 0 3\n{body}\n\n"), "no voxels"),
        (format!("NRRD0004\ntype: short\ndimension: 3\nsizes: 2 -2 3\n{body}\n\n"), "-2"),
        (format!("NRRD0004\ntype: short\ndimension: 3\nsizes: 100000 100000 100000\n{body}\n\n"), "claims"),
        (
            format!("NRRD0004\ntype: short\ndimension: 3\nsizes: 4000000 4000000 4000000\n{body}\n\n"),
            "claims",
        ),
        (
            format!("NRRD0004\ntype: short\ndimension: 4\nsizes: 9 9 9 18446744073709551615\n{body}\n\n"),
            "claims",
        ),
        (format!("NRRD0004\ntype: short\ndimension: 4\nsizes: 2 2 3 0\n{body}\n\n"), "no volume"),
        ("NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 3\nencoding: raw\n\n".to_owned(), "byte order"),
        ("NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 3\nencoding: zrl\n\n".to_owned(), "zrl"),
        (format!("NRRD0004\ntype: short\ntype: short\n{body}\n\n"), "twice"),
        ("NRRD0004\nnonsense\n\n".to_owned(), "nonsense"),
        (header(body), "followed by no data"),
        (header(&format!("{body}\nbyte skip: -2\ndata file: a.nrrd")), "byte skip"),
        (header(&format!("{body}\nline skip: 1000\ndata file: a.nrrd")), "line skip"),
        (header(&format!("{body}\nbyte skip: 9223372036854775807\ndata file: a.nrrd")), "claims"),
    ] {
        let message = folder.refusal("a.nrrd", &head);
        assert!(message.contains(expected), "{head}\n{message}");
    }
}

#[test]
fn a_compressed_stream_that_lies_or_ends_early_is_told() {
    let folder = Folder::new();
    let huge =
        "NRRD0004\ntype: short\ndimension: 3\nsizes: 2000 2000 2000\nencoding: gzip\nendian: little\n\n";
    assert!(folder.refusal("a.nrrd", [huge.as_bytes(), &gzip(&[0; 99])].concat()).contains("can hold"));
    let raw = little(0..12);
    let fields = format!("encoding: gzip\n{ENDIAN}");
    let padded = [gzip(&raw).as_slice(), &[0; 99]].concat();
    assert_eq!(voxels(folder.open("a.nrrd", attached(&fields, padded))), native(0..12));
    let short = gzip(&raw[..20]);
    let mut damaged = gzip(&raw);
    damaged[12] ^= 0xff;
    for (data, expected) in
        [(short.as_slice(), "after 20 of 24"), (&damaged, "damaged"), (b"no gzip data here", "damaged")]
    {
        let mut reader = folder.open("a.nrrd", attached(&fields, data));
        let message = reader.read_slices(&mut [0; 24]).unwrap_err().to_string();
        assert!(message.contains(expected) && !message.contains('\n'), "{message}");
    }
}

#[test]
fn hostile_headers_do_not_panic() {
    let fields = "space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (1,2,3)\nkinds: domain domain domain\n\
                  encoding: raw\nendian: little";
    let file = attached(fields, little(0..12));
    no_change_of_a_byte_panics("a.nrrd", &file, file.len() - 24);
    no_change_of_a_byte_panics("a.nrrd", &with_steps(0, "kinds: list domain domain domain"), 200);
}
