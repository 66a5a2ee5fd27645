use glam::{DVec3, UVec3};
use glassbrick::{Endian, OpenOptions, OpenSettings, RawLayout, Rescale, StoredType, Volume};
use glassbrick_volume::{BrickId, Voxels};

use super::{data, open};

/// Name and the other columns of each file.
pub fn table() -> impl Iterator<Item = (&'static str, Vec<&'static str>)> {
    let rows = include_str!("volumes.txt").lines().filter(|line| !line.starts_with('#'));
    rows.map(|row| {
        let mut columns = row.split('|').map(str::trim);
        (columns.next().expect("a row begins with a name"), columns.collect())
    })
}

fn numbers(column: &str) -> Vec<f64> {
    column.split_whitespace().map(|number| number.parse().expect("a number")).collect()
}

fn vector(column: &str) -> DVec3 {
    DVec3::from_slice(&numbers(column))
}

fn assert_near(name: &str, what: &str, found: f64, expected: f64) {
    let off = (found - expected).abs();
    assert!(off <= 1e-6 * expected.abs().max(1e-3), "{name}: {what} is {found}, not {expected}");
}

#[test]
fn volumes_are_what_other_programs_read_of_them() {
    let Some(data) = data() else { return };
    for (name, columns) in table() {
        let volume = open(&data, name);
        let [format, extent, spacing, origin, range, mean] = columns[..] else {
            panic!("{name}: a row has seven columns")
        };
        let desc = volume.desc();
        assert!(volume.format().starts_with(format), "{name} is read as {}", volume.format());
        assert_eq!(desc.extent.as_dvec3(), vector(extent), "{name}");
        for axis in 0..3 {
            assert_near(name, "spacing", desc.spacing_mm[axis], vector(spacing)[axis]);
            assert!((desc.origin_mm - vector(origin)).length() < 1e-4, "{name}: {}", desc.origin_mm);
        }
        for (found, expected) in volume.value_range().into_iter().zip(numbers(range)) {
            assert_near(name, "an end of the range", found, expected);
        }
        assert_near(name, "the mean", mean_of(&volume), mean.parse().expect("a number"));
    }
}

/// The mean of all values, through the bricks.
fn mean_of(volume: &Volume) -> f64 {
    let (bricks, desc) = (volume.bricks(), volume.desc());
    let grid = bricks.grid(0);
    let edge = grid.layout.edge as usize;
    let sum: f64 = (0..grid.len())
        .map(|index| {
            let place = grid.brick(index);
            let UVec3 { x, y, z } = place;
            let brick = bricks.brick(BrickId { level: 0, x, y, z }).expect("it is at hand");
            let size = (grid.core_end(place) - grid.core_start(place)).as_usizevec3();
            let halo = grid.layout.halo as usize;
            let rows = (0..size.z).flat_map(|z| (0..size.y).map(move |y| (y, z)));
            rows.map(|(y, z)| row_sum(&brick.voxels, ((z + halo) * edge + y + halo) * edge + halo, size.x))
                .sum::<f64>()
        })
        .sum();
    desc.rescale.value(sum / desc.voxels() as f64)
}

fn row_sum(voxels: &Voxels, start: usize, count: usize) -> f64 {
    let row = start..start + count;
    match voxels {
        Voxels::U8(voxels) => voxels[row].iter().map(|&voxel| f64::from(voxel)).sum(),
        Voxels::I8(voxels) => voxels[row].iter().map(|&voxel| f64::from(voxel)).sum(),
        Voxels::U16(voxels) => voxels[row].iter().map(|&voxel| f64::from(voxel)).sum(),
        Voxels::I16(voxels) => voxels[row].iter().map(|&voxel| f64::from(voxel)).sum(),
        Voxels::F32(voxels) => voxels[row].iter().map(|&voxel| f64::from(voxel)).sum(),
    }
}

#[test]
fn raw_voxels_are_read_as_they_are_said_to_be() {
    let Some(data) = data() else { return };
    for (name, extent, stored_type, endian, range, mean) in [
        (
            "vismale-head-256x256x128-u8.raw.bz2",
            [256, 256, 128],
            StoredType::U8,
            Endian::Little,
            [1.0, 254.0],
            35.24965,
        ),
        ("tooth.raw", [103, 94, 161], StoredType::U16, Endian::Big, [0.0, 1300.0], 526.871014),
    ] {
        let raw = RawLayout {
            extent: UVec3::from_array(extent),
            stored_type,
            endian,
            spacing_mm: DVec3::ONE,
            offset_bytes: 0,
            rescale: Rescale::IDENTITY,
        };
        let format = OpenOptions { raw: Some(raw), time: None };
        let settings = OpenSettings { format, ..OpenSettings::default() };
        let path = data.join("classic-volumes").join(name);
        let volume = Volume::open(&path, &settings, |_, _| ()).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(volume.value_range(), range, "{name}");
        assert_near(name, "the mean", mean_of(&volume), mean);
    }
}

/// Slices of 5.3 mm, tilted and unevenly spaced.
#[test]
fn a_tilted_gantry_is_followed_and_told() {
    let Some(data) = data() else { return };
    let volume = open(&data, "dicom-odd/ge-gantry-tilt-28.tar.xz:GE");
    let desc = volume.desc();
    assert_eq!(desc.extent, UVec3::new(512, 512, 28));
    let tilt_deg = desc.direction.y_axis.dot(desc.direction.z_axis).asin().to_degrees();
    assert!((tilt_deg.abs() - 18.5).abs() < 0.1, "{tilt_deg}");
    assert!(volume.notes().iter().any(|note| note.contains("gantry tilt")), "{:?}", volume.notes());
}
