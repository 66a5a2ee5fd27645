use std::arch::x86_64::*;

use super::super::avx512::Avx512;
use super::super::lanes::Lanes;

type F = <Avx512 as Lanes>::F;
type I = <Avx512 as Lanes>::I;
type M = <Avx512 as Lanes>::M;

/// A row of 64 or fewer voxels in registers.
pub trait Registers: Copy {
    /// A voxel and the next one for each ray.
    type Pairs: Copy;

    /// Those at each place, and `aside` more. Of places beyond the row, nothing is asked for.
    fn pairs(self, places: I, aside: i32) -> Self::Pairs;

    /// `yes` for these rays, `no` for the others.
    fn select(rays: M, yes: Self::Pairs, no: Self::Pairs) -> Self::Pairs;

    /// The first of each pair and the second as numbers, up to a power of two.
    fn numbers(pairs: Self::Pairs) -> [F; 2];

    /// Takes that power of two back.
    fn to_scale(x: F) -> F;
}

/// Words of 16 bits.
#[derive(Clone, Copy)]
pub struct Words<const SIGNED: bool>(pub [I; 2]);

/// Numbers of 32 bits.
#[derive(Clone, Copy)]
pub struct Floats(pub [F; 4]);

impl<const SIGNED: bool> Registers for Words<SIGNED> {
    /// The first in the lower half.
    type Pairs = I;

    #[inline(always)]
    fn pairs(self, places: I, aside: i32) -> I {
        let Self([first, second]) = self;
        // SAFETY: used only where AVX-512F and BW were detected.
        unsafe {
            let both = _mm512_or_si512(places, _mm512_slli_epi32::<16>(places));
            let pairs = Avx512::add_i(both, Avx512::splat_i((1 << 16) + aside * 0x1_0001));
            _mm512_permutex2var_epi16(first, pairs, second)
        }
    }

    #[inline(always)]
    fn select(rays: M, yes: I, no: I) -> I {
        Avx512::select_i(rays, yes, no)
    }

    #[inline(always)]
    fn numbers(pairs: I) -> [F; 2] {
        let [first, second] = if SIGNED {
            // In the upper word the sign is in its place.
            [Avx512::shift_left::<16>(pairs), Avx512::and_i(pairs, Avx512::splat_i(-0x1_0000))]
        } else {
            // SAFETY: used only where AVX-512F was detected.
            [Avx512::and_i(pairs, Avx512::splat_i(0xFFFF)), unsafe { _mm512_srli_epi32::<16>(pairs) }]
        };
        [Avx512::to_f(first), Avx512::to_f(second)]
    }

    #[inline(always)]
    fn to_scale(x: F) -> F {
        if SIGNED { Avx512::mul(x, Avx512::splat(1.0 / 65_536.0)) } else { x }
    }
}

impl Registers for Floats {
    type Pairs = [F; 2];

    #[inline(always)]
    fn pairs(self, places: I, aside: i32) -> [F; 2] {
        let first = Avx512::add_i(places, Avx512::splat_i(aside));
        [self.at(first), self.at(Avx512::add_i(first, Avx512::splat_i(1)))]
    }

    #[inline(always)]
    fn select(rays: M, yes: [F; 2], no: [F; 2]) -> [F; 2] {
        [Avx512::select(rays, yes[0], no[0]), Avx512::select(rays, yes[1], no[1])]
    }

    #[inline(always)]
    fn numbers(pairs: [F; 2]) -> [F; 2] {
        pairs
    }

    #[inline(always)]
    fn to_scale(x: F) -> F {
        x
    }
}

impl Floats {
    /// The number at each place.
    #[inline(always)]
    fn at(self, places: I) -> F {
        let Self([a, b, c, d]) = self;
        // SAFETY: used only where AVX-512F was detected. Two registers are picked from by the five lowest bits.
        unsafe {
            let [first, second] =
                [_mm512_permutex2var_ps(a, places, b), _mm512_permutex2var_ps(c, places, d)];
            _mm512_mask_mov_ps(first, _mm512_test_epi32_mask(places, _mm512_set1_epi32(32)), second)
        }
    }
}
