//! Eight rays at a time, with AVX2 and FMA.

use std::arch::x86_64::*;

use super::lanes::Lanes;

/// Eight lanes; masks are lanes of all ones or all zeros.
#[derive(Clone, Copy)]
pub struct Avx2;

/// Wraps intrinsics, all of which need AVX2 and FMA alone.
macro_rules! intrinsics {
    ($($name:ident($($argument:ident: $kind:ty),*) -> $result:ty = $body:expr;)*) => {$(
        #[inline(always)]
        fn $name($($argument: $kind),*) -> $result {
            // SAFETY: `Avx2` is used only where AVX2 and FMA were detected; the intrinsics touch no memory.
            unsafe { $body }
        }
    )*};
}

// SAFETY: used only where AVX2 and FMA were detected.
unsafe impl Lanes for Avx2 {
    const COUNT: usize = 8;

    type F = __m256;
    type I = __m256i;
    type M = __m256;

    intrinsics! {
        splat(x: f32) -> __m256 = _mm256_set1_ps(x);
        splat_i(x: i32) -> __m256i = _mm256_set1_epi32(x);
        add(a: __m256, b: __m256) -> __m256 = _mm256_add_ps(a, b);
        sub(a: __m256, b: __m256) -> __m256 = _mm256_sub_ps(a, b);
        mul(a: __m256, b: __m256) -> __m256 = _mm256_mul_ps(a, b);
        div(a: __m256, b: __m256) -> __m256 = _mm256_div_ps(a, b);
        mul_add(a: __m256, b: __m256, c: __m256) -> __m256 = _mm256_fmadd_ps(a, b, c);
        fused_mul_add(a: __m256, b: __m256, c: __m256) -> __m256 = _mm256_fmadd_ps(a, b, c);
        min(a: __m256, b: __m256) -> __m256 = _mm256_min_ps(a, b);
        max(a: __m256, b: __m256) -> __m256 = _mm256_max_ps(a, b);
        abs(a: __m256) -> __m256 = _mm256_andnot_ps(_mm256_set1_ps(-0.0), a);
        sqrt(a: __m256) -> __m256 = _mm256_sqrt_ps(a);
        floor(a: __m256) -> __m256 = _mm256_floor_ps(a);
        to_i(a: __m256) -> __m256i = _mm256_cvttps_epi32(a);
        to_f(a: __m256i) -> __m256 = _mm256_cvtepi32_ps(a);
        bits(a: __m256) -> __m256i = _mm256_castps_si256(a);
        from_bits(a: __m256i) -> __m256 = _mm256_castsi256_ps(a);
        add_i(a: __m256i, b: __m256i) -> __m256i = _mm256_add_epi32(a, b);
        and_i(a: __m256i, b: __m256i) -> __m256i = _mm256_and_si256(a, b);
        lt(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_LT_OQ>(a, b);
        ge(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_GE_OQ>(a, b);
        gt(a: __m256, b: __m256) -> __m256 = _mm256_cmp_ps::<_CMP_GT_OQ>(a, b);
        gt_i(a: __m256i, b: __m256i) -> __m256 = _mm256_castsi256_ps(_mm256_cmpgt_epi32(a, b));
        both(a: __m256, b: __m256) -> __m256 = _mm256_and_ps(a, b);
        either(a: __m256, b: __m256) -> __m256 = _mm256_or_ps(a, b);
        but_not(a: __m256, b: __m256) -> __m256 = _mm256_andnot_ps(b, a);
        mask_bits(m: __m256) -> u32 = _mm256_movemask_ps(m) as u32;
        select(m: __m256, yes: __m256, no: __m256) -> __m256 = _mm256_blendv_ps(no, yes, m);
        select_i(m: __m256, yes: __m256i, no: __m256i) -> __m256i =
            _mm256_blendv_epi8(no, yes, _mm256_castps_si256(m));
    }

    #[inline(always)]
    fn mask(bits: u32) -> __m256 {
        // SAFETY: as above.
        unsafe {
            let lane_bits = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
            let set = _mm256_and_si256(_mm256_set1_epi32(bits as i32), lane_bits);
            _mm256_castsi256_ps(_mm256_cmpeq_epi32(set, lane_bits))
        }
    }

    #[inline(always)]
    fn shift_left<const BITS: u32>(a: __m256i) -> __m256i {
        // SAFETY: as above.
        unsafe { _mm256_sll_epi32(a, _mm_cvtsi32_si128(BITS as i32)) }
    }

    #[inline(always)]
    fn shift_right<const BITS: u32>(a: __m256i) -> __m256i {
        // SAFETY: as above.
        unsafe { _mm256_sra_epi32(a, _mm_cvtsi32_si128(BITS as i32)) }
    }

    #[inline(always)]
    fn load(from: &[f32]) -> __m256 {
        let from: &[f32; 8] = from[..8].try_into().expect("eight elements");
        // SAFETY: eight elements lie there; the load need not be aligned.
        unsafe { _mm256_loadu_ps(from.as_ptr()) }
    }

    #[inline(always)]
    fn load_i(from: &[i32]) -> __m256i {
        let from: &[i32; 8] = from[..8].try_into().expect("eight elements");
        // SAFETY: eight elements lie there; the load need not be aligned.
        unsafe { _mm256_loadu_si256(from.as_ptr().cast()) }
    }

    #[inline(always)]
    fn store(x: __m256, to: &mut [f32]) {
        let to: &mut [f32; 8] = (&mut to[..8]).try_into().expect("eight elements");
        // SAFETY: eight elements lie there; the store need not be aligned.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), x) }
    }

    #[inline(always)]
    fn store_i(x: __m256i, to: &mut [i32]) {
        let to: &mut [i32; 8] = (&mut to[..8]).try_into().expect("eight elements");
        // SAFETY: eight elements lie there; the store need not be aligned.
        unsafe { _mm256_storeu_si256(to.as_mut_ptr().cast(), x) }
    }

    #[inline(always)]
    unsafe fn gather_bytes(base: *const u8, offsets: __m256i) -> __m256i {
        // SAFETY: the caller promises that four bytes lie behind each offset.
        unsafe { _mm256_i32gather_epi32::<1>(base.cast(), offsets) }
    }

    #[inline(always)]
    unsafe fn gather(base: *const f32, indices: __m256i) -> __m256 {
        // SAFETY: the caller promises that each index lies in the array.
        unsafe { _mm256_i32gather_ps::<4>(base, indices) }
    }
}
