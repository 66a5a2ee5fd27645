/// The opacity 1 − exp(−x) of an optical depth x ≥ 0.
///
/// exp is taken as 2ⁿ · 2ᶠ with |f| ≤ ½ and a polynomial for 2ᶠ (Taylor, degree 7: relative error below 2⁻²⁶), the
/// same steps in which vectors of rays can go.
#[inline(always)]
pub fn opacity(optical_depth: f32) -> f32 {
    const ROUND: f32 = 12_582_912.0; // 1.5 · 2²³: adding it rounds to a whole number
    let exponent = optical_depth.min(87.0) * -std::f32::consts::LOG2_E;
    let shifted = exponent + ROUND;
    let whole = shifted - ROUND;
    let f = (exponent - whole) * std::f32::consts::LN_2;
    let power_of_f = 1.0
        + f * (1.0
            + f * (0.5
                + f * (1.666_666_7e-1
                    + f * (4.166_666_8e-2 + f * (8.333_334e-3 + f * (1.388_889e-3 + f * 1.984_127e-4))))));
    let power_of_whole = f32::from_bits((shifted.to_bits() << 23).wrapping_add(0x3F80_0000));
    1.0 - power_of_whole * power_of_f
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opacity_is_one_minus_exp_to_a_rounding() {
        for step in 0..200_000 {
            let x = step as f32 * 5e-4;
            let exact = -(-f64::from(x)).exp_m1();
            assert!((f64::from(opacity(x)) - exact).abs() < 1.2e-7, "x = {x}");
        }
        assert_eq!(opacity(0.0), 0.0);
        assert_eq!(opacity(1e30), 1.0);
    }
}
