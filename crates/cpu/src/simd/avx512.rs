//! Sixteen rays at a time, with AVX-512F and POPCNT.

use std::arch::x86_64::*;

use super::lanes::{Lanes, RowLanes};

/// Sixteen lanes.
#[derive(Clone, Copy)]
pub struct Avx512;

/// Wraps intrinsics, all of which need AVX-512F alone.
macro_rules! intrinsics {
    ($($name:ident($($argument:ident: $kind:ty),*) -> $result:ty = $body:expr;)*) => {$(
        #[inline(always)]
        fn $name($($argument: $kind),*) -> $result {
            // SAFETY: `Avx512` is used only where AVX-512F was detected; the intrinsics touch no memory.
            unsafe { $body }
        }
    )*};
}

// SAFETY: used only where AVX-512F was detected.
unsafe impl Lanes for Avx512 {
    const COUNT: usize = 16;

    type F = __m512;
    type I = __m512i;
    type M = __mmask16;

    intrinsics! {
        splat(x: f32) -> __m512 = _mm512_set1_ps(x);
        splat_i(x: i32) -> __m512i = _mm512_set1_epi32(x);
        add(a: __m512, b: __m512) -> __m512 = _mm512_add_ps(a, b);
        sub(a: __m512, b: __m512) -> __m512 = _mm512_sub_ps(a, b);
        mul(a: __m512, b: __m512) -> __m512 = _mm512_mul_ps(a, b);
        div(a: __m512, b: __m512) -> __m512 = _mm512_div_ps(a, b);
        mul_add(a: __m512, b: __m512, c: __m512) -> __m512 = _mm512_fmadd_ps(a, b, c);
        fused_mul_add(a: __m512, b: __m512, c: __m512) -> __m512 = _mm512_fmadd_ps(a, b, c);
        min(a: __m512, b: __m512) -> __m512 = _mm512_min_ps(a, b);
        max(a: __m512, b: __m512) -> __m512 = _mm512_max_ps(a, b);
        abs(a: __m512) -> __m512 = _mm512_abs_ps(a);
        sqrt(a: __m512) -> __m512 = _mm512_sqrt_ps(a);
        floor(a: __m512) -> __m512 =
            _mm512_roundscale_ps::<{ _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC }>(a);
        to_i(a: __m512) -> __m512i = _mm512_cvttps_epi32(a);
        to_f(a: __m512i) -> __m512 = _mm512_cvtepi32_ps(a);
        bits(a: __m512) -> __m512i = _mm512_castps_si512(a);
        from_bits(a: __m512i) -> __m512 = _mm512_castsi512_ps(a);
        add_i(a: __m512i, b: __m512i) -> __m512i = _mm512_add_epi32(a, b);
        and_i(a: __m512i, b: __m512i) -> __m512i = _mm512_and_si512(a, b);
        lt(a: __m512, b: __m512) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_LT_OQ>(a, b);
        ge(a: __m512, b: __m512) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_GE_OQ>(a, b);
        gt(a: __m512, b: __m512) -> __mmask16 = _mm512_cmp_ps_mask::<_CMP_GT_OQ>(a, b);
        gt_i(a: __m512i, b: __m512i) -> __mmask16 = _mm512_cmpgt_epi32_mask(a, b);
        select(m: __mmask16, yes: __m512, no: __m512) -> __m512 = _mm512_mask_blend_ps(m, no, yes);
        select_i(m: __mmask16, yes: __m512i, no: __m512i) -> __m512i = _mm512_mask_blend_epi32(m, no, yes);
    }

    #[inline(always)]
    fn shift_left<const BITS: u32>(a: __m512i) -> __m512i {
        // SAFETY: as above.
        unsafe { _mm512_slli_epi32::<BITS>(a) }
    }

    #[inline(always)]
    fn shift_right<const BITS: u32>(a: __m512i) -> __m512i {
        // SAFETY: as above.
        unsafe { _mm512_srai_epi32::<BITS>(a) }
    }

    #[inline(always)]
    fn load(from: &[f32]) -> __m512 {
        let from: &[f32; 16] = from[..16].try_into().expect("sixteen elements");
        // SAFETY: sixteen elements lie there; the load need not be aligned.
        unsafe { _mm512_loadu_ps(from.as_ptr()) }
    }

    #[inline(always)]
    fn load_i(from: &[i32]) -> __m512i {
        let from: &[i32; 16] = from[..16].try_into().expect("sixteen elements");
        // SAFETY: sixteen elements lie there; the load need not be aligned.
        unsafe { _mm512_loadu_epi32(from.as_ptr()) }
    }

    #[inline(always)]
    fn store(x: __m512, to: &mut [f32]) {
        let to: &mut [f32; 16] = (&mut to[..16]).try_into().expect("sixteen elements");
        // SAFETY: sixteen elements lie there; the store need not be aligned.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), x) }
    }

    #[inline(always)]
    fn store_i(x: __m512i, to: &mut [i32]) {
        let to: &mut [i32; 16] = (&mut to[..16]).try_into().expect("sixteen elements");
        // SAFETY: sixteen elements lie there; the store need not be aligned.
        unsafe { _mm512_storeu_epi32(to.as_mut_ptr(), x) }
    }

    #[inline(always)]
    fn both(a: __mmask16, b: __mmask16) -> __mmask16 {
        a & b
    }

    #[inline(always)]
    fn either(a: __mmask16, b: __mmask16) -> __mmask16 {
        a | b
    }

    #[inline(always)]
    fn but_not(a: __mmask16, b: __mmask16) -> __mmask16 {
        a & !b
    }

    #[inline(always)]
    fn mask(bits: u32) -> __mmask16 {
        bits as __mmask16
    }

    #[inline(always)]
    fn mask_bits(m: __mmask16) -> u32 {
        u32::from(m)
    }

    #[inline(always)]
    unsafe fn gather_bytes(base: *const u8, offsets: __m512i) -> __m512i {
        // SAFETY: the caller promises that four bytes lie behind each offset.
        unsafe { _mm512_i32gather_epi32::<1>(offsets, base.cast()) }
    }

    #[inline(always)]
    unsafe fn gather(base: *const f32, indices: __m512i) -> __m512 {
        // SAFETY: the caller promises that each index lies in the array.
        unsafe { _mm512_i32gather_ps::<4>(indices, base) }
    }

    /// Loads whole entries, and transposes them: fewer loads than sixteen lanes gathered eight times.
    #[inline(always)]
    unsafe fn between(
        table: *const [f32; 4],
        entries: __m512i,
        fraction: __m512,
        asked: __mmask16,
    ) -> [__m512; 4] {
        // SAFETY: the caller promises that each entry and the next lie in the table; where fewer than four are asked for,
        // the first entry stands for the others.
        unsafe {
            if asked.count_ones() <= 4 {
                let packed = _mm512_castsi512_si128(_mm512_maskz_compress_epi32(asked, entries));
                let mixed = mixed_of_four(table, packed, _mm512_maskz_compress_ps(asked, fraction));
                spread(mixed, asked)
            } else {
                between_of_all(table, entries, fraction)
            }
        }
    }
}

/// A register of four quarters.
///
/// # Safety
/// Four numbers must lie at each, and AVX-512F be at hand.
#[inline(always)]
unsafe fn quarters(a: *const f32, b: *const f32, c: *const f32, d: *const f32) -> __m512 {
    // SAFETY: the caller's promise.
    unsafe {
        let ab = _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(_mm_loadu_ps(a)), _mm_loadu_ps(b));
        let cd = _mm256_insertf128_ps::<1>(_mm256_castps128_ps256(_mm_loadu_ps(c)), _mm_loadu_ps(d));
        _mm512_castpd_ps(_mm512_insertf64x4::<1>(
            _mm512_castpd256_pd512(_mm256_castps_pd(ab)),
            _mm256_castps_pd(cd),
        ))
    }
}

/// Between the entries at four places and the next ones: a register's n-th quarter by the n-th place, and by what that
/// quarter of `fraction` holds.
///
/// # Safety
/// The places and the next ones must lie in the table, and AVX-512F be at hand.
#[inline(always)]
unsafe fn mixed(table: *const [f32; 4], places: [i32; 4], fraction: __m512) -> __m512 {
    // No closures here: they would not be compiled for these instructions.
    // SAFETY: the caller's promise.
    unsafe {
        let [p0, p1, p2, p3] = [
            table.offset(places[0] as isize).cast::<f32>(),
            table.offset(places[1] as isize).cast::<f32>(),
            table.offset(places[2] as isize).cast::<f32>(),
            table.offset(places[3] as isize).cast::<f32>(),
        ];
        let a = quarters(p0, p1, p2, p3);
        let b = quarters(p0.add(4), p1.add(4), p2.add(4), p3.add(4));
        _mm512_fmadd_ps(fraction, _mm512_sub_ps(b, a), a)
    }
}

/// [`Lanes::between`] of any lanes.
///
/// # Safety
/// As of [`Lanes::between`].
#[inline(always)]
unsafe fn between_of_all(table: *const [f32; 4], entries: __m512i, fraction: __m512) -> [__m512; 4] {
    // SAFETY: the caller's promise; the rest touches no memory but its own.
    unsafe {
        let mut at = [0i32; 16];
        _mm512_storeu_epi32(at.as_mut_ptr(), entries);
        // Of a register's four quarters, the n-th holds the entry of lane 4·n and those behind it.
        let v0 = mixed(table, [at[0], at[4], at[8], at[12]], _mm512_permute_ps::<0x00>(fraction));
        let v1 = mixed(table, [at[1], at[5], at[9], at[13]], _mm512_permute_ps::<0x55>(fraction));
        let v2 = mixed(table, [at[2], at[6], at[10], at[14]], _mm512_permute_ps::<0xAA>(fraction));
        let v3 = mixed(table, [at[3], at[7], at[11], at[15]], _mm512_permute_ps::<0xFF>(fraction));
        let (low01, high01) = (_mm512_unpacklo_ps(v0, v1), _mm512_unpackhi_ps(v0, v1));
        let (low23, high23) = (_mm512_unpacklo_ps(v2, v3), _mm512_unpackhi_ps(v2, v3));
        [
            _mm512_shuffle_ps::<0x44>(low01, low23),
            _mm512_shuffle_ps::<0xEE>(low01, low23),
            _mm512_shuffle_ps::<0x44>(high01, high23),
            _mm512_shuffle_ps::<0xEE>(high01, high23),
        ]
    }
}

/// Between four entries and the next ones, by the first four of `fractions`: a quarter of a register each.
///
/// # Safety
/// As of [`Lanes::between`].
#[inline(always)]
unsafe fn mixed_of_four(table: *const [f32; 4], entries: __m128i, fractions: __m512) -> __m512 {
    // SAFETY: the caller's promise; the rest touches no memory but its own.
    unsafe {
        let mut at = [0i32; 4];
        _mm_storeu_si128(at.as_mut_ptr().cast(), entries);
        let quarters = _mm512_set_epi32(3, 3, 3, 3, 2, 2, 2, 2, 1, 1, 1, 1, 0, 0, 0, 0);
        mixed(table, at, _mm512_permutexvar_ps(quarters, fractions))
    }
}

/// The four columns of a register's quarters, which go to four lanes or fewer, one after the other.
///
/// # Safety
/// AVX-512F must be at hand.
#[inline(always)]
unsafe fn spread(quarters: __m512, lanes: __mmask16) -> [__m512; 4] {
    // SAFETY: the caller's promise; the intrinsics touch no memory.
    unsafe {
        let starts = _mm512_set_epi32(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 12, 8, 4, 0);
        // Where each lane's quarter begins.
        let start = _mm512_maskz_expand_epi32(lanes, starts);
        [
            _mm512_permutexvar_ps(start, quarters),
            _mm512_permutexvar_ps(Avx512::add_i(start, Avx512::splat_i(1)), quarters),
            _mm512_permutexvar_ps(Avx512::add_i(start, Avx512::splat_i(2)), quarters),
            _mm512_permutexvar_ps(Avx512::add_i(start, Avx512::splat_i(3)), quarters),
        ]
    }
}

// SAFETY: as above.
unsafe impl RowLanes for Avx512 {
    #[inline(always)]
    fn bits_at(bits: u8, places: __m512i) -> __mmask16 {
        // SAFETY: `Avx512` is used only where AVX-512F was detected; the intrinsics touch no memory.
        unsafe {
            let bit = _mm512_sllv_epi32(_mm512_set1_epi32(1), places);
            _mm512_test_epi32_mask(bit, _mm512_set1_epi32(i32::from(bits)))
        }
    }

    #[inline(always)]
    fn pick(row: &[f32], places: __m512i) -> __m512 {
        let some = ((1u32 << row.len().min(16)) - 1) as __mmask16;
        // SAFETY: as above; the load reads no further than the row.
        unsafe { _mm512_permutexvar_ps(places, _mm512_maskz_loadu_ps(some, row.as_ptr())) }
    }
}
