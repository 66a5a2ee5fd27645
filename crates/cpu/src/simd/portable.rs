//! Eight rays at a time in plain loops, which compilers turn into what the processor has (NEON, SSE2).

use super::lanes::Lanes;

const LANES: usize = 8;

/// Eight lanes as arrays.
#[derive(Clone, Copy)]
pub struct Portable;

#[inline(always)]
fn each<A: Copy, R>(a: [A; LANES], f: impl Fn(A) -> R) -> [R; LANES] {
    std::array::from_fn(|lane| f(a[lane]))
}

#[inline(always)]
fn pairs<A: Copy, B: Copy, R>(a: [A; LANES], b: [B; LANES], f: impl Fn(A, B) -> R) -> [R; LANES] {
    std::array::from_fn(|lane| f(a[lane], b[lane]))
}

type F = [f32; LANES];
type I = [i32; LANES];
type M = [bool; LANES];

// SAFETY: no instructions that any processor lacks.
unsafe impl Lanes for Portable {
    const COUNT: usize = LANES;

    type F = F;
    type I = I;
    type M = M;

    #[inline(always)]
    fn splat(x: f32) -> F {
        [x; LANES]
    }
    #[inline(always)]
    fn splat_i(x: i32) -> I {
        [x; LANES]
    }
    #[inline(always)]
    fn load(from: &[f32]) -> F {
        from[..LANES].try_into().expect("eight elements")
    }
    #[inline(always)]
    fn load_i(from: &[i32]) -> I {
        from[..LANES].try_into().expect("eight elements")
    }
    #[inline(always)]
    fn store(x: F, to: &mut [f32]) {
        to[..LANES].copy_from_slice(&x);
    }
    #[inline(always)]
    fn store_i(x: I, to: &mut [i32]) {
        to[..LANES].copy_from_slice(&x);
    }
    #[inline(always)]
    fn add(a: F, b: F) -> F {
        pairs(a, b, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(a: F, b: F) -> F {
        pairs(a, b, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(a: F, b: F) -> F {
        pairs(a, b, |a, b| a * b)
    }
    #[inline(always)]
    fn div(a: F, b: F) -> F {
        pairs(a, b, |a, b| a / b)
    }
    #[inline(always)]
    fn mul_add(a: F, b: F, c: F) -> F {
        std::array::from_fn(|lane| a[lane] * b[lane] + c[lane])
    }
    #[inline(always)]
    fn fused_mul_add(a: F, b: F, c: F) -> F {
        // The product is exact in f64.
        std::array::from_fn(|lane| (f64::from(a[lane]) * f64::from(b[lane]) + f64::from(c[lane])) as f32)
    }
    #[inline(always)]
    fn min(a: F, b: F) -> F {
        pairs(a, b, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(a: F, b: F) -> F {
        pairs(a, b, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn abs(a: F) -> F {
        each(a, f32::abs)
    }
    #[inline(always)]
    fn sqrt(a: F) -> F {
        each(a, f32::sqrt)
    }
    #[inline(always)]
    fn floor(a: F) -> F {
        each(a, |a| {
            let toward_zero = (a as i32) as f32;
            toward_zero - f32::from(u8::from(toward_zero > a))
        })
    }
    #[inline(always)]
    fn to_i(a: F) -> I {
        each(a, |a| a as i32)
    }
    #[inline(always)]
    fn to_f(a: I) -> F {
        each(a, |a| a as f32)
    }
    #[inline(always)]
    fn bits(a: F) -> I {
        each(a, |a| a.to_bits() as i32)
    }
    #[inline(always)]
    fn from_bits(a: I) -> F {
        each(a, |a| f32::from_bits(a as u32))
    }
    #[inline(always)]
    fn add_i(a: I, b: I) -> I {
        pairs(a, b, i32::wrapping_add)
    }
    #[inline(always)]
    fn and_i(a: I, b: I) -> I {
        pairs(a, b, |a, b| a & b)
    }
    #[inline(always)]
    fn shift_left<const BITS: u32>(a: I) -> I {
        each(a, |a| a << BITS)
    }
    #[inline(always)]
    fn shift_right<const BITS: u32>(a: I) -> I {
        each(a, |a| a >> BITS)
    }
    #[inline(always)]
    fn lt(a: F, b: F) -> M {
        pairs(a, b, |a, b| a < b)
    }
    #[inline(always)]
    fn ge(a: F, b: F) -> M {
        pairs(a, b, |a, b| a >= b)
    }
    #[inline(always)]
    fn gt(a: F, b: F) -> M {
        pairs(a, b, |a, b| a > b)
    }
    #[inline(always)]
    fn gt_i(a: I, b: I) -> M {
        pairs(a, b, |a, b| a > b)
    }
    #[inline(always)]
    fn both(a: M, b: M) -> M {
        pairs(a, b, |a, b| a & b)
    }
    #[inline(always)]
    fn either(a: M, b: M) -> M {
        pairs(a, b, |a, b| a | b)
    }
    #[inline(always)]
    fn but_not(a: M, b: M) -> M {
        pairs(a, b, |a, b| a & !b)
    }
    #[inline(always)]
    fn mask(bits: u32) -> M {
        std::array::from_fn(|lane| bits & (1 << lane) != 0)
    }
    #[inline(always)]
    fn mask_bits(m: M) -> u32 {
        (0..LANES).fold(0, |bits, lane| bits | (u32::from(m[lane]) << lane))
    }
    #[inline(always)]
    fn select(m: M, yes: F, no: F) -> F {
        std::array::from_fn(|lane| if m[lane] { yes[lane] } else { no[lane] })
    }
    #[inline(always)]
    fn select_i(m: M, yes: I, no: I) -> I {
        std::array::from_fn(|lane| if m[lane] { yes[lane] } else { no[lane] })
    }
    #[inline(always)]
    unsafe fn gather_bytes(base: *const u8, offsets: I) -> I {
        // SAFETY: the caller promises that four bytes lie behind each offset.
        each(offsets, |offset| unsafe { base.offset(offset as isize).cast::<i32>().read_unaligned() })
    }
    #[inline(always)]
    unsafe fn gather(base: *const f32, indices: I) -> F {
        // SAFETY: the caller promises that each index lies in the array.
        each(indices, |index| unsafe { *base.offset(index as isize) })
    }
}
