use glam::UVec3;
use glassbrick_volume::{BrickLayout, BrickRange, Endian, StoredType, VoxelCountTable};

use crate::decode::{Kept, Stored, with_stored};
use crate::element::{Element, with_element};
use crate::table_scan::count_core;

/// What the tables of a store say of a brick.
pub struct BrickStats {
    /// Smallest and largest stored value over the core and one voxel around it, then over the core, little-endian.
    pub range_row: Vec<u8>,
    pub table: VoxelCountTable,
    /// Voxels of the core that are not finite.
    pub not_finite: u64,
}

/// A brick's stored voxels, halo included, little-endian.
#[derive(Clone, Copy)]
pub struct StoredBrick<'a> {
    pub voxels: &'a [u8],
    pub stored_type: StoredType,
    pub layout: BrickLayout,
    /// Voxels of the core that are the volume's.
    pub core: UVec3,
}

impl<'a> StoredBrick<'a> {
    /// Looks at all voxels of the core, and one around it.
    pub fn stats(&self) -> BrickStats {
        let range_row = with_element!(self.stored_type, range_row(self));
        let range = with_stored!(self.stored_type, Endian::Little, kept_range(&range_row));
        let (table, not_finite) = with_stored!(self.stored_type, Endian::Little, count(self, &range));
        BrickStats { range_row, table, not_finite }
    }

    /// The rows of the core with `around` voxels around it, along x.
    fn rows(&self, around: u32) -> impl Iterator<Item = &'a [u8]> + use<'a> {
        let Self { voxels, stored_type, layout, core } = *self;
        let (edge, first, bytes) =
            (layout.edge as usize, (layout.halo - around) as usize, stored_type.bytes());
        let [x, y, z] = core.to_array().map(|n| (n + 2 * around) as usize);
        (first..first + z).flat_map(move |k| {
            (first..first + y).map(move |j| &voxels[((k * edge + j) * edge + first) * bytes..][..x * bytes])
        })
    }
}

fn range_row<T: Element>(brick: &StoredBrick) -> Vec<u8> {
    let (mut core, mut reach) = (LeastAndMost::<T>::NOTHING, LeastAndMost::NOTHING);
    let rows_around = brick.core.y as usize + 2;
    for (number, row) in brick.rows(1).enumerate() {
        let (y, z) = (number % rows_around, number / rows_around);
        let (inner, ends) = (T::BYTES..row.len() - T::BYTES, [0, row.len() - T::BYTES]);
        let within = LeastAndMost::of(&row[inner]);
        reach = ends.into_iter().fold(reach.and(within), |reach, end| {
            let number = T::read(&row[end..end + T::BYTES]);
            reach.and(LeastAndMost { least: number, most: number })
        });
        if (1..=brick.core.y as usize).contains(&y) && (1..=brick.core.z as usize).contains(&z) {
            core = core.and(within);
        }
    }
    let mut row = vec![0; 4 * T::BYTES];
    let numbers = [reach.least, reach.most, core.least, core.most];
    for (number, place) in numbers.into_iter().zip(row.chunks_exact_mut(T::BYTES)) {
        number.write(place);
    }
    row
}

#[derive(Clone, Copy)]
struct LeastAndMost<T> {
    least: T,
    most: T,
}

impl<T: Element> LeastAndMost<T> {
    const NOTHING: Self = Self { least: T::ABOVE_ALL, most: T::BELOW_ALL };

    fn of(row: &[u8]) -> Self {
        row.chunks_exact(T::BYTES)
            .map(T::read)
            .fold(Self::NOTHING, |all, number| all.and(Self { least: number, most: number }))
    }

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Self {
            least: if other.least < self.least { other.least } else { self.least },
            most: if other.most > self.most { other.most } else { self.most },
        }
    }
}

/// A range as kept voxels have it.
pub fn kept_range<S: Stored>(row: &[u8]) -> BrickRange {
    let mut kept = [S::Kept::default(); 4];
    S::decode(row, &mut kept);
    let [reach_min, reach_max, core_min, core_max] = kept.map(Kept::to_f32);
    BrickRange { reach: [reach_min, reach_max], core: [core_min, core_max] }
}

fn count<S: Stored>(brick: &StoredBrick, range: &BrickRange) -> (VoxelCountTable, u64) {
    let not_finite = brick.rows(0).map(S::count_not_finite).sum();
    (count_core::<S>(brick.rows(0), brick.core.x as usize, range), not_finite)
}
