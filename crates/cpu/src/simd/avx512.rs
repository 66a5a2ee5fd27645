//! Sixteen rays at a time, with AVX-512F.

use std::arch::x86_64::*;

use super::lanes::Lanes;

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
}
