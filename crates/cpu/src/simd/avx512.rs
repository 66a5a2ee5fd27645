//! Sixteen rays at a time, with AVX-512F.

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

    /// Loads whole entries and transposes them: fewer loads than sixteen lanes gathered eight times.
    #[inline(always)]
    unsafe fn between(table: *const [f32; 4], entries: __m512i, fraction: __m512) -> [__m512; 4] {
        // SAFETY: the caller promises that each entry and the next lie in the table; the rest touches no memory but its
        // own.
        unsafe {
            let mut at = [0i32; 16];
            _mm512_storeu_epi32(at.as_mut_ptr(), entries);
            // Of a register's four quarters, the n-th holds the entry of lane 4·n + `first`.
            macro_rules! mixed {
                ($first:literal) => {{
                    let quarter = |place: i32| _mm_loadu_ps(table.offset(place as isize).cast());
                    let (at0, at1, at2, at3) = (at[$first], at[$first + 4], at[$first + 8], at[$first + 12]);
                    let a = _mm512_broadcast_f32x4(quarter(at0));
                    let a = _mm512_mask_broadcast_f32x4(a, 0x00F0, quarter(at1));
                    let a = _mm512_mask_broadcast_f32x4(a, 0x0F00, quarter(at2));
                    let a = _mm512_mask_broadcast_f32x4(a, 0xF000, quarter(at3));
                    let b = _mm512_broadcast_f32x4(quarter(at0 + 1));
                    let b = _mm512_mask_broadcast_f32x4(b, 0x00F0, quarter(at1 + 1));
                    let b = _mm512_mask_broadcast_f32x4(b, 0x0F00, quarter(at2 + 1));
                    let b = _mm512_mask_broadcast_f32x4(b, 0xF000, quarter(at3 + 1));
                    let t = _mm512_permute_ps::<{ $first * 0x55 }>(fraction);
                    _mm512_fmadd_ps(t, _mm512_sub_ps(b, a), a)
                }};
            }
            let (v0, v1, v2, v3) = (mixed!(0), mixed!(1), mixed!(2), mixed!(3));
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
