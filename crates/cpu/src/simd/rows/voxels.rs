use std::arch::x86_64::*;

use glam::{IVec3, Vec3};
use glassbrick_volume::{RowAxis, Voxels};

use super::super::avx512::Avx512;
use super::super::lanes::Lanes;
use super::super::voxel::LaneVoxel;
use super::registers::{Floats, Registers, Words};
use super::track::Step;
use crate::kernel::BrickView;

type F = <Avx512 as Lanes>::F;
type I = <Avx512 as Lanes>::I;
type M = <Avx512 as Lanes>::M;

/// Voxels of which a brick's row fits into registers.
pub trait RowVoxel: LaneVoxel {
    type Registers: Registers;

    /// Those of a brick that has such voxels.
    fn of(voxels: &Voxels) -> Option<&[Self]>;

    /// Reads the first voxels: those whose bits are set.
    ///
    /// # Safety
    /// They must lie there, and AVX-512BW and VL be at hand.
    unsafe fn row(voxels: *const Self, in_row: u64) -> Self::Registers;
}

/// Voxels and the next ones.
type Pairs<V> = <<V as RowVoxel>::Registers as Registers>::Pairs;

/// A brick as rays along its rows see it.
pub struct RowBrick<'a, V> {
    voxels: &'a [V],
    edge: usize,
    pub row_axis: RowAxis,
    /// A bit for each voxel of a row.
    in_row: u64,
    /// The volume's voxel of its first, along the row.
    pub halo_start_x: i32,
    /// The half-open range of sample positions along the row that it owns.
    pub owned_x: [f32; 2],
}

/// Where the samples of a packet lie in a row of voxels.
pub struct Place {
    /// The first voxel of the row before them.
    pub row: u32,
    /// Along x of each ray, along y and z the same for all.
    pub fraction: [F; 3],
}

/// Rows of voxels, of which pairs of neighbours are picked.
pub trait Rows<V: RowVoxel> {
    /// The voxels at and behind each sample's place along x and `x` more, in the row `y` and `z` aside.
    fn pairs(&self, place: &Place, x: i32, y: isize, z: isize) -> Pairs<V>;
}

/// All samples lie in one brick.
pub struct Single<'a, V> {
    pub brick: &'a RowBrick<'a, V>,
    /// The voxel before each sample, along x in the brick.
    pub at: I,
}

/// Samples lie in bricks side by side.
pub struct SideBySide<'a, V, const N: usize> {
    pub bricks: [&'a RowBrick<'a, V>; N],
    /// The rays whose samples lie in each.
    pub rays: [M; N],
    /// The voxel before each sample, along x in each brick.
    pub at: [I; N],
}

impl<V: RowVoxel> Rows<V> for Single<'_, V> {
    #[inline(always)]
    fn pairs(&self, place: &Place, x: i32, y: isize, z: isize) -> Pairs<V> {
        self.brick.row(place.row, y, z).pairs(self.at, x)
    }
}

impl<V: RowVoxel, const N: usize> Rows<V> for SideBySide<'_, V, N> {
    #[inline(always)]
    fn pairs(&self, place: &Place, x: i32, y: isize, z: isize) -> Pairs<V> {
        let mut pairs = self.bricks[0].row(place.row, y, z).pairs(self.at[0], x);
        for brick in 1..N {
            let other = self.bricks[brick].row(place.row, y, z).pairs(self.at[brick], x);
            pairs = V::Registers::select(self.rays[brick], other, pairs);
        }
        pairs
    }
}

impl<'a, V: RowVoxel> RowBrick<'a, V> {
    pub const LARGEST_EDGE: u32 = 64;

    /// Lines of the caches that a row takes up, more or less.
    const LINES: usize = if size_of::<V>() > 2 { size_of::<V>() } else { 2 };

    pub fn new(view: &BrickView<'a>, voxels: &'a [V]) -> Self {
        let edge = view.brick.edge;
        assert!(edge <= Self::LARGEST_EDGE && voxels.len() >= (edge as usize).pow(3));
        let IVec3 { x: halo_start_x, .. } = view.halo_start;
        let [Vec3 { x: low, .. }, Vec3 { x: high, .. }] = view.owned;
        Self {
            voxels,
            edge: edge as usize,
            row_axis: view.brick.row_axis,
            in_row: u64::MAX >> (64 - edge),
            halo_start_x,
            owned_x: [low, high],
        }
    }

    /// Places along x in the brick, of voxels of the volume.
    #[inline(always)]
    pub fn local(&self, voxel_x: I) -> I {
        Avx512::add_i(voxel_x, Avx512::splat_i(-self.halo_start_x))
    }

    /// Asks for two rows, each so far from the one before a sample along y and z.
    #[inline(always)]
    pub fn prefetch(&self, step: &Step, rows: [[u32; 2]; 2]) {
        for [y, z] in rows {
            let edge = self.edge as u32;
            let start = self.voxels.as_ptr().wrapping_add((step.row + (z * edge + y) * edge) as usize);
            // SAFETY: a prefetch reads nothing.
            unsafe {
                for line in 0..Self::LINES {
                    _mm_prefetch::<_MM_HINT_T0>(start.cast::<i8>().wrapping_add(line * 64));
                }
            }
        }
    }

    #[inline(always)]
    fn row(&self, row: u32, y: isize, z: isize) -> V::Registers {
        let edge = self.edge as isize;
        let start = row as isize + (z * edge + y) * edge;
        debug_assert!(start >= 0 && (start + edge) as usize <= self.voxels.len());
        // SAFETY: a sample that a brick owns lies between its second and last but two voxels on each axis, so rows of
        // the cell and one voxel around it lie in the brick; the row is as long as the brick.
        unsafe { V::row(self.voxels.as_ptr().offset(start), self.in_row) }
    }
}

/// The eight voxels around each sample, to their scale: by their places along z, y, and the row.
#[inline(always)]
pub fn corners<V: RowVoxel>(rows: &impl Rows<V>, place: &Place) -> [[[F; 2]; 2]; 2] {
    [
        [pair::<V>(rows, place, 0, [0, 0]), pair::<V>(rows, place, 0, [1, 0])],
        [pair::<V>(rows, place, 0, [0, 1]), pair::<V>(rows, place, 0, [1, 1])],
    ]
}

/// The voxels around each sample that central differences need, to their scale: those in the middle of 4³, by their places
/// along z, y, and the row, with the next ones on each side; zeros at the edges of these.
#[inline(always)]
pub fn surroundings<V: RowVoxel>(rows: &impl Rows<V>, place: &Place) -> [[[F; 4]; 4]; 4] {
    let zero = Avx512::splat(0.0);
    let mut voxels = [[[zero; 4]; 4]; 4];
    for z in 1..3 {
        for y in 1..3 {
            let row = [y as isize - 1, z as isize - 1];
            let [before, first] = pair::<V>(rows, place, -1, row);
            let [second, behind] = pair::<V>(rows, place, 1, row);
            voxels[z][y] = [before, first, second, behind];
        }
    }
    for inner in 1..3 {
        for outer in [0, 3] {
            let [inner_row, outer_row] = [inner as isize - 1, outer as isize - 1];
            let [first, second] = pair::<V>(rows, place, 0, [outer_row, inner_row]);
            (voxels[inner][outer][1], voxels[inner][outer][2]) = (first, second);
            let [first, second] = pair::<V>(rows, place, 0, [inner_row, outer_row]);
            (voxels[outer][inner][1], voxels[outer][inner][2]) = (first, second);
        }
    }
    voxels
}

/// The voxels before and behind samples `along` the row, in the row so far aside along y and z.
#[inline(always)]
fn pair<V: RowVoxel>(rows: &impl Rows<V>, place: &Place, along: i32, [y, z]: [isize; 2]) -> [F; 2] {
    V::Registers::numbers(rows.pairs(place, along, y, z))
}

impl RowVoxel for u16 {
    type Registers = Words<false>;

    fn of(voxels: &Voxels) -> Option<&[Self]> {
        if let Voxels::U16(voxels) = voxels { Some(voxels) } else { None }
    }

    #[inline(always)]
    unsafe fn row(voxels: *const Self, in_row: u64) -> Words<false> {
        // SAFETY: the caller's promise; nothing is read where the mask is not set.
        unsafe { masked_words(voxels.cast(), in_row) }
    }
}

impl RowVoxel for i16 {
    type Registers = Words<true>;

    fn of(voxels: &Voxels) -> Option<&[Self]> {
        if let Voxels::I16(voxels) = voxels { Some(voxels) } else { None }
    }

    #[inline(always)]
    unsafe fn row(voxels: *const Self, in_row: u64) -> Words<true> {
        // SAFETY: the caller's promise; nothing is read where the mask is not set.
        unsafe { masked_words(voxels, in_row) }
    }
}

impl RowVoxel for u8 {
    type Registers = Words<false>;

    fn of(voxels: &Voxels) -> Option<&[Self]> {
        if let Voxels::U8(voxels) = voxels { Some(voxels) } else { None }
    }

    #[inline(always)]
    unsafe fn row(voxels: *const Self, in_row: u64) -> Words<false> {
        // SAFETY: the caller's promise; nothing is read where the mask is not set.
        unsafe {
            let row = _mm512_maskz_loadu_epi8(in_row, voxels.cast());
            Words([
                _mm512_cvtepu8_epi16(_mm512_castsi512_si256(row)),
                _mm512_cvtepu8_epi16(_mm512_extracti64x4_epi64::<1>(row)),
            ])
        }
    }
}

impl RowVoxel for i8 {
    type Registers = Words<true>;

    fn of(voxels: &Voxels) -> Option<&[Self]> {
        if let Voxels::I8(voxels) = voxels { Some(voxels) } else { None }
    }

    #[inline(always)]
    unsafe fn row(voxels: *const Self, in_row: u64) -> Words<true> {
        // SAFETY: the caller's promise; nothing is read where the mask is not set.
        unsafe {
            let row = _mm512_maskz_loadu_epi8(in_row, voxels);
            Words([
                _mm512_cvtepi8_epi16(_mm512_castsi512_si256(row)),
                _mm512_cvtepi8_epi16(_mm512_extracti64x4_epi64::<1>(row)),
            ])
        }
    }
}

impl RowVoxel for f32 {
    type Registers = Floats;

    fn of(voxels: &Voxels) -> Option<&[Self]> {
        if let Voxels::F32(voxels) = voxels { Some(voxels) } else { None }
    }

    #[inline(always)]
    unsafe fn row(voxels: *const Self, in_row: u64) -> Floats {
        // SAFETY: the caller's promise; nothing is read where the mask is not set.
        unsafe {
            Floats([
                _mm512_maskz_loadu_ps(in_row as u16, voxels),
                _mm512_maskz_loadu_ps((in_row >> 16) as u16, voxels.wrapping_add(16)),
                _mm512_maskz_loadu_ps((in_row >> 32) as u16, voxels.wrapping_add(32)),
                _mm512_maskz_loadu_ps((in_row >> 48) as u16, voxels.wrapping_add(48)),
            ])
        }
    }
}

/// # Safety
/// As of [`RowVoxel::row`].
#[inline(always)]
unsafe fn masked_words<const SIGNED: bool>(words: *const i16, in_row: u64) -> Words<SIGNED> {
    // SAFETY: the caller's promise; nothing is read where the mask is not set.
    unsafe {
        Words([
            _mm512_maskz_loadu_epi16(in_row as u32, words),
            _mm512_maskz_loadu_epi16((in_row >> 32) as u32, words.wrapping_add(32)),
        ])
    }
}
