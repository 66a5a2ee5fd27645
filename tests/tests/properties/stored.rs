//! Volumes of every stored type, filled by a number.

use glam::{IVec3, UVec3};
use glassbrick_brick_store::FlatSource;
use glassbrick_volume::{BrickLayout, StoredType, VolumeDesc};
use proptest::prelude::*;
use proptest::sample::select;

use super::any::{extent, layout, rescale};

/// A volume with its voxels, as stored and as they are kept.
#[derive(Clone)]
pub struct Stored {
    pub desc: VolumeDesc,
    pub layout: BrickLayout,
    pub bytes: Vec<u8>,
    /// As they are kept: rounded to `f32`, zero where they are not finite.
    pub kept: Vec<f32>,
    pub not_finite: u64,
    filling: Option<Filling>,
}

/// What makes the voxels.
#[derive(Clone, Copy, Debug)]
pub struct Filling {
    kind: Kind,
    seed: u64,
}

#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Anything that the type can hold.
    Everything,
    /// Few enough whole numbers for tables to be exact.
    Narrow,
    /// Regions of one value each.
    Plateaus,
}

pub fn filling() -> impl Strategy<Value = Filling> {
    let kind = select(vec![Kind::Everything, Kind::Narrow, Kind::Plateaus]);
    (kind, any::<u64>()).prop_map(|(kind, seed)| Filling { kind, seed })
}

/// A volume of any stored type.
pub fn stored(most: u32) -> impl Strategy<Value = Stored> {
    let stored_type = select(StoredType::ALL.to_vec());
    (extent(most), stored_type, rescale(), layout(), filling()).prop_map(
        |(extent, stored_type, rescale, layout, filling)| {
            let desc = VolumeDesc { rescale, ..VolumeDesc::new(extent, stored_type) };
            let (mut bytes, mut kept, mut not_finite) = (Vec::new(), Vec::new(), 0);
            for index in 0..desc.voxels() as usize {
                let number = filling.number(index, extent);
                let value = store(stored_type, number, filling.kind, &mut bytes);
                not_finite += u64::from(!value.is_finite());
                kept.push(if value.is_finite() { value } else { 0.0 });
            }
            Stored { not_finite, filling: Some(filling), ..Stored::of(desc, layout, bytes, kept) }
        },
    )
}

impl Filling {
    /// The number that a voxel is made of.
    fn number(self, index: usize, extent: UVec3) -> u64 {
        match self.kind {
            Kind::Everything | Kind::Narrow => hash(self.seed, index as u64),
            Kind::Plateaus => {
                let place = voxel_at(index, extent) / 5;
                hash(self.seed, u64::from(place.x + 64 * (place.y + 64 * place.z)))
            }
        }
    }
}

/// The voxel at a place in memory.
pub fn voxel_at(index: usize, extent: UVec3) -> UVec3 {
    let (index, [nx, ny, _]) = (index as u32, extent.to_array());
    UVec3::new(index % nx, index / nx % ny, index / (nx * ny))
}

/// A well mixed number (the finaliser of SplitMix64).
pub fn hash(seed: u64, index: u64) -> u64 {
    let mut z = seed.wrapping_add(index.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Appends a voxel made of a number; returns it rounded to `f32`.
fn store(stored_type: StoredType, number: u64, kind: Kind, bytes: &mut Vec<u8>) -> f32 {
    let number = if matches!(kind, Kind::Narrow) { number % 97 } else { number };
    macro_rules! keep {
        ($voxel:expr) => {{
            let voxel = $voxel;
            bytes.extend(voxel.to_ne_bytes());
            voxel as f32
        }};
    }
    match stored_type {
        StoredType::U8 => keep!(number as u8),
        StoredType::I8 => keep!(number as i8),
        StoredType::U16 => keep!(number as u16),
        StoredType::I16 => keep!(number as i16),
        StoredType::U32 => keep!(number as u32),
        StoredType::I32 => keep!(number as i32),
        StoredType::F32 => keep!(real(number, kind) as f32),
        StoredType::F64 => keep!(real(number, kind)),
    }
}

/// A real number, now and then one that is not finite or not a normal `f32`.
fn real(number: u64, kind: Kind) -> f64 {
    let fraction = number as f64 / u64::MAX as f64;
    match (kind, number % 61) {
        (Kind::Narrow, _) => number as f64 / 8.0 - 3.0,
        (_, 0) => f64::NAN,
        (_, 1) => f64::INFINITY,
        (_, 2) => -1e300,
        (_, 3) => 1e-42,
        _ => (fraction - 0.4) * 5000.0,
    }
}

impl Stored {
    /// A volume of finite voxels.
    pub fn of(desc: VolumeDesc, layout: BrickLayout, bytes: Vec<u8>, kept: Vec<f32>) -> Self {
        Self { desc, layout, bytes, kept, not_finite: 0, filling: None }
    }

    pub fn source(&self) -> FlatSource {
        FlatSource::from_array(self.desc.clone(), self.bytes.clone(), self.layout).expect("a sound array")
    }

    /// The kept voxel at a position, which beyond the volume is its edge's.
    pub fn at(&self, voxel: IVec3) -> f32 {
        let extent = self.desc.extent;
        let voxel = voxel.clamp(IVec3::ZERO, extent.as_ivec3() - 1).as_uvec3();
        self.kept[((voxel.z * extent.y + voxel.y) * extent.x + voxel.x) as usize]
    }

    /// The kept voxels from `low` up to, not including, `high`.
    pub fn voxels_in(&self, low: UVec3, high: UVec3) -> impl Iterator<Item = f32> {
        let rows = (low.z..high.z).flat_map(move |z| (low.y..high.y).map(move |y| (y, z)));
        rows.flat_map(move |(y, z)| (low.x..high.x).map(move |x| UVec3::new(x, y, z)))
            .map(|voxel| self.at(voxel.as_ivec3()))
    }
}

impl std::fmt::Debug for Stored {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}, {:?}, {:?}", self.desc, self.layout, self.filling)
    }
}
