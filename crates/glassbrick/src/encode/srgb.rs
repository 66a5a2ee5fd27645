use std::sync::LazyLock;

/// Steps of linear light that the encoder's first guess distinguishes. The curve is steepest at black, where 255
/// codes rise by 12.92 · 255 < 4096 per unit, so that a step never holds more than one change of code.
const STEPS: usize = 4096;

struct EncodeTable {
    /// The code at the start of each step.
    code: [u8; STEPS],
    /// The linear light from which a code's successor is nearer; never, for the last.
    next_code_from: [f32; 256],
}

static TABLE: LazyLock<EncodeTable> = LazyLock::new(|| EncodeTable {
    code: std::array::from_fn(|step| encode_exactly(step as f64 / STEPS as f64)),
    next_code_from: std::array::from_fn(|code| match code {
        255 => f32::INFINITY,
        _ => round_up(decode((code as f64 + 0.5) / 255.0)),
    }),
});

/// Linear light to an 8-bit sRGB code, clamped and rounded to nearest; what is not a number is black.
pub fn srgb_from_linear(linear: f32) -> u8 {
    let linear = if linear.is_nan() { 0.0 } else { linear.clamp(0.0, 1.0) };
    let table = &*TABLE;
    let step = ((linear * STEPS as f32) as usize).min(STEPS - 1);
    let code = table.code[step];
    code + u8::from(linear >= table.next_code_from[usize::from(code)])
}

/// An 8-bit sRGB code to linear light.
pub fn linear_from_srgb(code: u8) -> f32 {
    decode(f64::from(code) / 255.0) as f32
}

/// 0..1 to 0..255, clamped and rounded to nearest; what is not a number is 0.
pub fn unit_to_u8(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// The smallest `f32` that is not below.
fn round_up(value: f64) -> f32 {
    let nearest = value as f32;
    if f64::from(nearest) < value { nearest.next_up() } else { nearest }
}

fn encode_exactly(linear: f64) -> u8 {
    let encoded = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (encoded * 255.0).round() as u8
}

fn decode(encoded: f64) -> f64 {
    if encoded <= 0.040_45 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_rounds_as_the_formula_does() {
        for index in 0..=1_000_000 {
            let linear = index as f32 / 1_000_000.0;
            assert_eq!(srgb_from_linear(linear), encode_exactly(f64::from(linear)), "{linear}");
        }
    }

    #[test]
    fn codes_survive_the_way_to_linear_light_and_back() {
        for code in 0..=255 {
            assert_eq!(srgb_from_linear(linear_from_srgb(code)), code);
        }
    }

    #[test]
    fn half_the_light_is_code_188() {
        assert_eq!(srgb_from_linear(0.5), 188);
    }
}
