use glassbrick_volume::Frame;

use super::srgb::{linear_from_srgb, srgb_from_linear, unit_to_u8};

/// What stands behind a picture of 8 bits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// An sRGB colour, under which the frame is composited in linear light.
    Color([u8; 3]),
    /// Nothing: the picture keeps its alpha.
    Transparent,
}

impl Default for Background {
    fn default() -> Self {
        Self::Color([0, 0, 0])
    }
}

impl Background {
    /// Reads `#rrggbb` or `transparent`.
    pub fn parse(text: &str) -> Option<Self> {
        if text == "transparent" {
            return Some(Self::Transparent);
        }
        let digits = text.strip_prefix('#')?;
        if digits.len() != 6 || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
            return None;
        }
        let [_, red, green, blue] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
        Some(Self::Color([red, green, blue]))
    }
}

/// The frame over an sRGB colour: red, green and blue of each pixel, sRGB-encoded, clamped and rounded to nearest.
pub fn rgb8_over(frame: &Frame, color: [u8; 3]) -> Vec<u8> {
    let behind = color.map(linear_from_srgb);
    let mut bytes = Vec::with_capacity(frame.rgba.len() * 3);
    for &[red, green, blue, alpha] in &frame.rgba {
        let through = (1.0 - alpha).clamp(0.0, 1.0);
        bytes.extend([
            srgb_from_linear(red + through * behind[0]),
            srgb_from_linear(green + through * behind[1]),
            srgb_from_linear(blue + through * behind[2]),
        ]);
    }
    bytes
}

/// The frame with straight alpha: red, green, blue sRGB-encoded and alpha as it is, clamped and rounded to nearest.
/// Where alpha is zero there is no colour.
pub fn rgba8_straight(frame: &Frame) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(frame.rgba.len() * 4);
    for &[red, green, blue, alpha] in &frame.rgba {
        if alpha > 0.0 {
            bytes.extend([
                srgb_from_linear(red / alpha),
                srgb_from_linear(green / alpha),
                srgb_from_linear(blue / alpha),
                unit_to_u8(alpha),
            ]);
        } else {
            bytes.extend([0; 4]);
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pixel(rgba: [f32; 4]) -> Frame {
        Frame { width: 1, height: 1, rgba: vec![rgba], depth_mm: vec![0.0] }
    }

    #[test]
    fn half_transparent_white_over_red_is_mixed_in_linear_light() {
        assert_eq!(rgb8_over(&pixel([0.5, 0.5, 0.5, 0.5]), [255, 0, 0]), [255, 188, 188]);
    }

    #[test]
    fn nothing_over_a_colour_is_that_colour() {
        for code in 0..=255 {
            let color = [code, 255 - code, 7];
            assert_eq!(rgb8_over(&pixel([0.0; 4]), color), color);
        }
    }

    #[test]
    fn straight_alpha_undoes_the_premultiplication() {
        assert_eq!(rgba8_straight(&pixel([0.25, 0.125, 0.0, 0.5])), [188, 137, 0, 128]);
        assert_eq!(rgba8_straight(&pixel([0.0; 4])), [0; 4]);
    }

    #[test]
    fn light_beyond_the_range_clamps() {
        assert_eq!(rgb8_over(&pixel([1.3, -0.2, f32::NAN, 1.1]), [9, 9, 9]), [255, 0, 0]);
        assert_eq!(rgba8_straight(&pixel([1.3, -0.2, f32::NAN, 1.1])), [255, 0, 0, 255]);
    }

    #[test]
    fn backgrounds_are_read_from_words() {
        assert_eq!(Background::parse("#ff8000"), Some(Background::Color([255, 128, 0])));
        assert_eq!(Background::parse("transparent"), Some(Background::Transparent));
        for wrong in ["", "#", "ff8000", "#ff800", "#ff80000", "#+f8000", "#gg0000", "red"] {
            assert_eq!(Background::parse(wrong), None, "{wrong}");
        }
    }
}
