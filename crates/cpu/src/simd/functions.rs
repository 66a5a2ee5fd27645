//! Functions of vectors.

use super::lanes::Lanes;

/// The opacity 1 − exp(−x) of optical depths x ≥ 0: the scalar kernel's steps.
#[inline(always)]
pub fn opacity<L: Lanes>(optical_depth: L::F) -> L::F {
    const ROUND: f32 = 12_582_912.0; // 1.5 · 2²³: adding it rounds to a whole number
    let exponent = L::mul(L::min(optical_depth, L::splat(87.0)), L::splat(-std::f32::consts::LOG2_E));
    let shifted = L::add(exponent, L::splat(ROUND));
    let whole = L::sub(shifted, L::splat(ROUND));
    let f = L::mul(L::sub(exponent, whole), L::splat(std::f32::consts::LN_2));
    let mut power_of_f = L::splat(1.984_127e-4);
    for coefficient in [1.388_889e-3, 8.333_334e-3, 4.166_666_8e-2, 1.666_666_7e-1, 0.5, 1.0, 1.0] {
        power_of_f = L::mul_add(power_of_f, f, L::splat(coefficient));
    }
    let one = L::splat_i(0x3F80_0000);
    let power_of_whole = L::from_bits(L::add_i(L::shift_left::<23>(L::bits(shifted)), one));
    L::sub(L::splat(1.0), L::mul(power_of_whole, power_of_f))
}

/// x to a power, x from 0 to 1; whole powers by repeated squaring.
#[inline(always)]
pub fn power<L: Lanes>(x: L::F, exponent: f32) -> L::F {
    if exponent.fract() == 0.0 && (0.0..=1024.0).contains(&exponent) {
        let mut left = exponent as u32;
        let (mut result, mut square) = (L::splat(1.0), x);
        while left > 0 {
            if left & 1 == 1 {
                result = L::mul(result, square);
            }
            square = L::mul(square, square);
            left >>= 1;
        }
        return result;
    }
    let mut lanes = [0.0f32; 16];
    L::store(x, &mut lanes);
    for lane in &mut lanes[..L::COUNT] {
        *lane = lane.powf(exponent);
    }
    L::load(&lanes)
}
