use std::io::{self, Write};

use glassbrick_volume::Frame;
use png::{BitDepth, ColorType, Encoder, SrgbRenderingIntent};

use super::Background;
use super::background::{rgb8_over, rgba8_straight};
use super::report_text::REPORT_KEYWORD;

/// Writes a PNG of 8 bits: RGB over a colour, or RGBA with straight alpha.
pub fn encode(
    frame: &Frame,
    background: Background,
    report_json: &str,
    writer: &mut impl Write,
) -> io::Result<()> {
    let mut encoder = srgb_encoder(writer, frame.width, frame.height, background);
    encoder.add_itxt_chunk(REPORT_KEYWORD.to_owned(), report_json.to_owned())?;
    let mut encoder = encoder.write_header()?;
    encoder.write_image_data(&pixels(frame, background))?;
    Ok(encoder.finish()?)
}

/// An encoder of 8-bit sRGB pixels such as `pixels` gives.
pub fn srgb_encoder<W: Write>(
    writer: W,
    width: u32,
    height: u32,
    background: Background,
) -> Encoder<'static, W> {
    let mut encoder = Encoder::new(writer, width, height);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_color(match background {
        Background::Color(_) => ColorType::Rgb,
        Background::Transparent => ColorType::Rgba,
    });
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder
}

/// The frame's pixels as `srgb_encoder` takes them.
pub fn pixels(frame: &Frame, background: Background) -> Vec<u8> {
    match background {
        Background::Color(color) => rgb8_over(frame, color),
        Background::Transparent => rgba8_straight(frame),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    fn two_by_one() -> Frame {
        let rgba = vec![[0.5, 0.0, 0.0, 1.0], [0.5, 0.5, 0.5, 0.5]];
        Frame { width: 2, height: 1, rgba, depth_mm: vec![1.0, 2.0] }
    }

    fn round_trip(background: Background, report: &str) -> (png::Info<'static>, Vec<u8>) {
        let mut file = Vec::new();
        encode(&two_by_one(), background, report, &mut file).expect("memory takes it");
        let mut reader = png::Decoder::new(Cursor::new(file)).read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
        reader.next_frame(&mut bytes).expect("a picture");
        reader.finish().expect("an end");
        (reader.info().clone(), bytes)
    }

    #[test]
    fn over_a_colour_it_is_rgb_composited_in_linear_light() {
        let (info, bytes) = round_trip(Background::Color([255, 0, 0]), "{}");
        assert_eq!((info.width, info.height, info.color_type), (2, 1, ColorType::Rgb));
        assert_eq!(bytes, [188, 0, 0, 255, 188, 188]);
    }

    #[test]
    fn over_nothing_it_is_rgba_with_straight_alpha() {
        let (info, bytes) = round_trip(Background::Transparent, "{}");
        assert_eq!(info.color_type, ColorType::Rgba);
        assert_eq!(bytes, [188, 0, 0, 255, 255, 255, 255, 128]);
    }

    #[test]
    fn it_says_that_it_is_srgb_and_carries_the_report() {
        let report = r#"{"warnings":["Schädel"]}"#;
        let (info, _) = round_trip(Background::default(), report);
        assert_eq!(info.srgb, Some(SrgbRenderingIntent::Perceptual));
        let text = &info.utf8_text[0];
        assert_eq!(text.keyword, "glassbrick");
        assert!(!text.compressed);
        assert_eq!(text.get_text().expect("UTF-8"), report);
    }
}
