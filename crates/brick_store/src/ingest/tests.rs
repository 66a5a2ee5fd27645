use std::path::PathBuf;

use glam::{UVec3, Vec3};
use glassbrick_volume::{
    BrickId, BrickSource, Endian, FlatPlacement, ReadError, StoredType, VolumeDesc, Voxels,
};

use super::*;
use crate::{FlatSource, StoreSource, verify};

/// A volume in memory, read as a stream; it fails at a slice if it is told to.
struct Stream {
    desc: VolumeDesc,
    voxels: Vec<u8>,
    read: usize,
    fails_at: Option<u32>,
}

impl VolumeReader for Stream {
    fn desc(&self) -> &VolumeDesc {
        &self.desc
    }

    fn format(&self) -> &'static str {
        "stream"
    }

    fn notes(&self) -> &[String] {
        &[]
    }

    fn flat_placement(&self) -> Option<&FlatPlacement> {
        None
    }

    fn read_slices(&mut self, out: &mut [u8]) -> Result<(), ReadError> {
        let end = self.read + out.len();
        if self.fails_at.is_some_and(|slice| end as u64 > u64::from(slice) * self.desc.slice_bytes()) {
            return Err("the disk is on fire".into());
        }
        out.copy_from_slice(&self.voxels[self.read..end]);
        self.read = end;
        Ok(())
    }

    fn bytes_read(&self) -> u64 {
        self.read as u64
    }
}

/// Pseudo-random voxels, with a corner of zeros that holds whole bricks.
fn stream(extent: [u32; 3], stored_type: StoredType) -> Stream {
    let desc = VolumeDesc::new(UVec3::from_array(extent), stored_type);
    let mut state = 1u32;
    let voxels = (0..desc.voxels())
        .flat_map(|voxel| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let x = voxel % u64::from(extent[0]);
            let number = if x < 20 { 0 } else { state >> 8 };
            match stored_type {
                StoredType::F32 if number % 97 == 1 => f32::NAN.to_ne_bytes().to_vec(),
                StoredType::F32 => (number as f32 * 1e-3).to_ne_bytes().to_vec(),
                StoredType::F64 => (f64::from(number) * 1e-3).to_ne_bytes().to_vec(),
                _ => number.to_ne_bytes()[..stored_type.bytes()].to_vec(),
            }
        })
        .collect();
    Stream { desc, voxels, read: 0, fails_at: None }
}

fn settings(codec: Codec) -> IngestSettings {
    IngestSettings {
        layout: BrickLayout { edge: 12, halo: 2 },
        codec,
        replace: false,
        resume: false,
        input: "a stream".to_owned(),
    }
}

fn make(stream: &mut Stream, target: &Path, settings: &IngestSettings) -> Result<Ingested, StoreError> {
    ingest(stream, target, settings, &mut |_, _| {})
}

fn scratch() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let store = folder.path().join("v.zarr");
    (folder, store)
}

fn names_in(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .expect("the folder is there")
        .map(|entry| entry.expect("a name").file_name().into_string().expect("ASCII"))
        .collect();
    names.sort();
    names
}

/// Every file below a folder, with what it holds.
fn files(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut found = Vec::new();
    for name in names_in(folder) {
        let path = folder.join(name);
        if path.is_dir() {
            found.extend(files(&path));
        } else {
            found.push((path.clone(), fs::read(&path).expect("a file")));
        }
    }
    found
}

#[test]
fn a_store_holds_the_bricks_ranges_and_tables_of_its_volume() {
    for (stored_type, codec) in StoredType::ALL.into_iter().zip(Codec::ALL.into_iter().cycle()) {
        let (_folder, target) = scratch();
        let mut stream = stream([45, 30, 38], stored_type);
        let flat = FlatSource::from_array(stream.desc.clone(), stream.voxels.clone(), settings(codec).layout)
            .expect("sound");
        make(&mut stream, &target, &settings(codec)).expect("it can be stored");
        let store = StoreSource::open(&target).expect("sound");
        assert_eq!((store.desc(), store.grid(0)), (flat.desc(), flat.grid(0)));
        assert_eq!(store.ranges(0), flat.ranges(0), "{stored_type}");
        assert_eq!(store.not_finite(), flat.not_finite());
        let tables = |source: &dyn BrickSource| source.voxel_count_tables(0).expect("at hand");
        assert!(tables(&store) == tables(&flat), "{stored_type}");
        for index in 0..store.grid(0).len() {
            let UVec3 { x, y, z } = store.grid(0).brick(index);
            let id = BrickId { level: 0, x, y, z };
            let [a, b] = [&store as &dyn BrickSource, &flat].map(|source| source.brick(id).expect("at hand"));
            assert!(a.voxels == b.voxels, "{stored_type} {id:?}");
        }
        let verified = verify(&target, &|_, _| {}).expect("a store");
        assert!(verified.damage.is_empty(), "{stored_type} {:?}", verified.damage);
    }
}

#[test]
fn levels_are_box_averages_over_the_voxels_that_exist() {
    let (_folder, target) = scratch();
    let mut stream = stream([45, 30, 17], StoredType::I16);
    let extent = stream.desc.extent;
    let (voxels, _) = stream.voxels.as_chunks::<2>();
    let mut expected: Vec<i64> = voxels.iter().map(|&bytes| i16::from_ne_bytes(bytes).into()).collect();
    let mut size = extent;
    make(&mut stream, &target, &settings(Codec::Zstd)).expect("it can be stored");
    let store = StoreSource::open(&target).expect("sound");
    assert_eq!(store.levels(), 4);
    for level in 1..store.levels() {
        let half = size.map(|n| n.div_ceil(2));
        let at = |p: UVec3| expected[((p.z * size.y + p.y) * size.x + p.x) as usize];
        let averages = (0..half.element_product()).map(|index| {
            let p = UVec3::new(index % half.x, index / half.x % half.y, index / half.x / half.y);
            let covered: Vec<i64> = (0..8)
                .map(|corner| 2 * p + UVec3::new(corner & 1, corner >> 1 & 1, corner >> 2))
                .filter(|q| q.cmplt(size).all())
                .map(at)
                .collect();
            let (sum, count) = (covered.iter().sum::<i64>() as f64, covered.len() as f64);
            (sum / count + 0.5).floor() as i64
        });
        expected = averages.collect();
        size = half;
        let grid = store.grid(level);
        assert_eq!(grid.extent, size);
        for (index, &value) in expected.iter().enumerate() {
            let index = index as u32;
            let p = UVec3::new(index % size.x, index / size.x % size.y, index / size.x / size.y);
            let owner = grid.owner(p.as_vec3().min(grid.end - Vec3::splat(0.25))).expect("in the level");
            let brick = store.brick(BrickId { level, x: owner.x, y: owner.y, z: owner.z }).expect("at hand");
            let Voxels::I16(voxels) = &brick.voxels else { panic!("another type") };
            let q = (p.as_ivec3() - grid.halo_start(owner)).as_uvec3();
            let edge = grid.layout.edge;
            assert_eq!(i64::from(voxels[((q.z * edge + q.y) * edge + q.x) as usize]), value, "{level} {p}");
        }
    }
}

#[test]
fn a_resumed_run_makes_the_same_store_to_the_byte() {
    let (folder, whole) = scratch();
    make(&mut stream([40, 30, 170], StoredType::U16), &whole, &settings(Codec::Lz4)).expect("stored");
    let expected: Vec<_> = files(&whole)
        .into_iter()
        .map(|(path, bytes)| (path.strip_prefix(&whole).expect("below").to_owned(), bytes))
        .collect();
    let resumable = IngestSettings { resume: true, ..settings(Codec::Lz4) };
    for fails_at in [1, 40, 90, 169] {
        let target = folder.path().join(format!("{fails_at}.zarr"));
        let mut broken = stream([40, 30, 170], StoredType::U16);
        broken.fails_at = Some(fails_at);
        let error = make(&mut broken, &target, &resumable).expect_err("the stream fails").to_string();
        assert!(error.contains("on fire"), "{error}");
        assert!(!target.exists());
        let made = make(&mut stream([40, 30, 170], StoredType::U16), &target, &resumable).expect("stored");
        assert_eq!(made.resumed_bytes > 0, fails_at >= 90, "{fails_at}");
        let found: Vec<_> = files(&target)
            .into_iter()
            .map(|(path, bytes)| (path.strip_prefix(&target).expect("below").to_owned(), bytes))
            .collect();
        assert!(found == expected, "{fails_at}");
    }
}

#[test]
fn a_run_with_another_input_is_not_resumed() {
    let (folder, target) = scratch();
    let resumable = IngestSettings { resume: true, ..settings(Codec::None) };
    let staging = Staging::begin(&target, false, true).expect("free");
    staging
        .note(&RunState { run: "another".to_owned(), level: 0, shard_rows: 1, not_finite: 0 })
        .expect("noted");
    drop(staging);
    let error = make(&mut stream([9, 9, 9], StoredType::U8), &target, &resumable).expect_err("another run");
    assert!(matches!(error, StoreError::OtherRun { .. }), "{error}");
    let anew = settings(Codec::None);
    make(&mut stream([9, 9, 9], StoredType::U8), &target, &anew).expect("begun anew");
    assert_eq!(names_in(folder.path()), ["v.zarr"]);
}

#[test]
fn what_stands_there_is_replaced_whole_or_not_at_all() {
    let (folder, target) = scratch();
    make(&mut stream([20, 20, 20], StoredType::U8), &target, &settings(Codec::Zstd)).expect("stored");
    let old = files(&target);
    let again = make(&mut stream([9, 9, 9], StoredType::U8), &target, &settings(Codec::Zstd));
    assert!(matches!(again, Err(StoreError::Exists { .. })), "{again:?}");
    let replacing = IngestSettings { replace: true, ..settings(Codec::Zstd) };
    let mut broken = stream([30, 30, 30], StoredType::U8);
    broken.fails_at = Some(20);
    make(&mut broken, &target, &replacing).expect_err("the stream fails");
    assert!(files(&target) == old);
    assert_eq!(names_in(folder.path()), ["v.zarr"]);
    make(&mut stream([9, 9, 9], StoredType::U8), &target, &replacing).expect("stored");
    assert_eq!(StoreSource::open(&target).expect("sound").desc().extent, UVec3::splat(9));
    assert_eq!(names_in(folder.path()), ["v.zarr"]);
}

#[test]
fn a_folder_that_is_no_store_is_never_replaced() {
    let (folder, target) = scratch();
    fs::create_dir(&target).expect("a folder");
    fs::write(target.join("thesis.txt"), "years of work").expect("a file");
    let replacing = IngestSettings { replace: true, ..settings(Codec::Zstd) };
    let refused = make(&mut stream([9, 9, 9], StoredType::U8), &target, &replacing);
    assert!(matches!(refused, Err(StoreError::Target { .. })), "{refused:?}");
    assert_eq!(names_in(folder.path()), ["v.zarr"]);
    assert_eq!(names_in(&target), ["thesis.txt"]);
}

#[test]
fn two_runs_do_not_make_one_store() {
    let (_folder, target) = scratch();
    let _first = Staging::begin(&target, false, false).expect("free");
    let second = make(&mut stream([9, 9, 9], StoredType::U8), &target, &settings(Codec::Zstd));
    assert!(matches!(second, Err(StoreError::Busy { .. })), "{second:?}");
}

#[test]
fn a_store_that_is_replaced_is_not_read_on() {
    let (_folder, target) = scratch();
    make(&mut stream([45, 20, 20], StoredType::U8), &target, &settings(Codec::None)).expect("stored");
    let old = StoreSource::open(&target).expect("sound");
    let replacing = IngestSettings { replace: true, ..settings(Codec::None) };
    make(&mut stream([45, 20, 20], StoredType::U16), &target, &replacing).expect("stored");
    let error = old.brick(BrickId { level: 0, x: 4, y: 0, z: 0 }).expect_err("replaced").to_string();
    assert!(error.contains("was replaced"), "{error}");
}

#[test]
fn voxels_are_little_endian_in_a_store() {
    let (_folder, target) = scratch();
    let mut stream = stream([8, 8, 8], StoredType::U16);
    stream.voxels = (0..512u16).flat_map(u16::to_ne_bytes).collect();
    make(&mut stream, &target, &settings(Codec::None)).expect("stored");
    let shard = fs::read(target.join("levels/0/bricks/c/0/0/0/0/0/0")).expect("there");
    let first_row = ((2 * 12 + 2) * 12 + 2) * 2;
    assert_eq!(shard[first_row..first_row + 6], [0, 0, 1, 0, 2, 0]);
    assert_eq!(Endian::NATIVE == Endian::Little, cfg!(target_endian = "little"));
}
