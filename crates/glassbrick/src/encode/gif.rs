use std::borrow::Cow;
use std::io::{self, Write};

use gif::{DisposalMethod, Encoder, EncodingError, Frame as GifFrame, Repeat};
use glassbrick_volume::Frame;

use super::background::{rgb8_over, rgba8_straight};
use super::{AnimationDesc, Background};

/// How many pixels a palette is learnt from: at 512×512 it is 1 dB short of one learnt from all, six times as fast.
const SAMPLED_PIXELS: usize = 26_214;

/// Browsers play anything shorter ten times slower.
const LEAST_DELAY_CS: u16 = 2;

/// Writes a GIF that repeats without end, each frame with the palette that suits it.
pub struct GifEncoder<W: Write> {
    encoder: Encoder<W>,
    width: u16,
    height: u16,
    fps: u32,
    background: Background,
    written: u32,
}

impl<W: Write> GifEncoder<W> {
    /// Starts the file. Width and height must fit 16 bits.
    pub fn new(writer: W, desc: &AnimationDesc) -> io::Result<Self> {
        let width = u16::try_from(desc.width).map_err(io::Error::other)?;
        let height = u16::try_from(desc.height).map_err(io::Error::other)?;
        let mut encoder = Encoder::new(writer, width, height, &[]).map_err(io_error)?;
        encoder.set_repeat(Repeat::Infinite).map_err(io_error)?;
        Ok(Self { encoder, width, height, fps: desc.fps, background: desc.background, written: 0 })
    }

    /// Appends a frame of the size that was announced.
    pub fn write_frame(&mut self, frame: &Frame) -> io::Result<()> {
        let mut quantized = match self.background {
            Background::Color(color) => {
                let rgb = rgb8_over(frame, color);
                GifFrame::from_rgb_speed(self.width, self.height, &rgb, sampling(frame))
            }
            Background::Transparent => self.cut_out(frame),
        };
        quantized.delay = delay_cs(self.written, self.fps);
        self.written += 1;
        self.encoder.write_frame(&quantized).map_err(io_error)
    }

    /// A frame whose pixels are opaque where their alpha is at least a half, and else not there.
    fn cut_out(&self, frame: &Frame) -> GifFrame<'static> {
        let mut rgba = rgba8_straight(frame);
        for pixel in rgba.chunks_exact_mut(4) {
            if pixel[3] < 128 {
                pixel.fill(0);
            } else {
                pixel[3] = 255;
            }
        }
        let mut quantized = GifFrame::from_rgba_speed(self.width, self.height, &mut rgba, sampling(frame));
        quantized.dispose = DisposalMethod::Background;
        keep_opaque_pixels(&mut quantized, &rgba);
        quantized
    }

    /// Ends the file and gives its writer back, which is still to be flushed.
    pub fn finish(self) -> io::Result<W> {
        self.encoder.into_inner().map_err(io_error)
    }
}

/// Moves opaque pixels that were given the transparent entry, as very dark ones may be, to the nearest other one.
fn keep_opaque_pixels(quantized: &mut GifFrame<'static>, rgba: &[u8]) {
    let (Some(transparent), Some(palette)) = (quantized.transparent, &quantized.palette) else {
        return;
    };
    let distance = |entry: &[u8], pixel: &[u8]| -> u32 {
        entry.iter().zip(pixel).map(|(&a, &b)| u32::from(a.abs_diff(b)).pow(2)).sum()
    };
    let mut indices = std::mem::take(&mut quantized.buffer).into_owned();
    for (index, pixel) in indices.iter_mut().zip(rgba.chunks_exact(4)) {
        if *index == transparent && pixel[3] != 0 {
            *index = (0..=255u8)
                .zip(palette.chunks_exact(3))
                .filter(|&(entry, _)| entry != transparent)
                .min_by_key(|(_, entry)| distance(entry, pixel))
                .map_or(*index, |(entry, _)| entry);
        }
    }
    quantized.buffer = Cow::Owned(indices);
}

/// One in how many pixels the quantizer looks at.
fn sampling(frame: &Frame) -> i32 {
    (frame.rgba.len() / SAMPLED_PIXELS).clamp(1, 10) as i32
}

/// How long a frame stands, in hundredths of a second, such that the ends of frames keep to the rate.
fn delay_cs(frame: u32, fps: u32) -> u16 {
    let end_cs = |frames: u64| (frames * 100 + u64::from(fps) / 2) / u64::from(fps);
    let delay = end_cs(u64::from(frame) + 1) - end_cs(u64::from(frame));
    u16::try_from(delay).unwrap_or(u16::MAX).max(LEAST_DELAY_CS)
}

fn io_error(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other.to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gif::{ColorOutput, DecodeOptions, Decoder};

    fn gradient(width: u32, height: u32, shift: f32) -> Frame {
        let mut frame = Frame::transparent(width, height);
        for (index, pixel) in frame.rgba.iter_mut().enumerate() {
            let (x, y) = (index as u32 % width, index as u32 / width);
            *pixel = [x as f32 / width as f32, y as f32 / height as f32, shift, 1.0];
        }
        frame
    }

    fn encoded(frames: &[Frame], background: Background) -> Vec<u8> {
        let desc = AnimationDesc {
            width: frames[0].width,
            height: frames[0].height,
            frames: frames.len() as u32,
            fps: 25,
            background,
        };
        let mut encoder = GifEncoder::new(Vec::new(), &desc).expect("memory takes it");
        for frame in frames {
            encoder.write_frame(frame).expect("memory takes it");
        }
        encoder.finish().expect("memory takes it")
    }

    fn decoder(file: &[u8]) -> Decoder<&[u8]> {
        let mut options = DecodeOptions::new();
        options.set_color_output(ColorOutput::RGBA);
        options.read_info(file).expect("a GIF")
    }

    #[test]
    fn frames_come_back_near_their_colours_and_loop_without_end() {
        let frames = [gradient(64, 48, 0.1), gradient(64, 48, 0.4)];
        let file = encoded(&frames, Background::default());
        let mut decoder = decoder(&file);
        for frame in &frames {
            let decoded = decoder.read_next_frame().expect("a GIF").expect("a frame");
            assert_eq!((decoded.delay, decoded.width, decoded.height), (4, 64, 48));
            let expected = rgb8_over(frame, [0; 3]);
            let square: f64 = decoded
                .buffer
                .chunks_exact(4)
                .zip(expected.chunks_exact(3))
                .flat_map(|(got, want)| (0..3).map(|c| f64::from(got[c].abs_diff(want[c])).powi(2)))
                .sum();
            let rms = (square / expected.len() as f64).sqrt();
            assert!(rms < 8.0, "{rms}");
        }
        assert!(decoder.read_next_frame().expect("a GIF").is_none());
        assert_eq!(decoder.repeat(), Repeat::Infinite);
    }

    #[test]
    fn few_colours_are_kept_exactly() {
        let mut frame = Frame::transparent(16, 15);
        for (index, pixel) in frame.rgba.iter_mut().enumerate() {
            *pixel = [index as f32 / 240.0, 0.0, 0.5, 1.0];
        }
        let file = encoded(std::slice::from_ref(&frame), Background::default());
        let mut decoder = decoder(&file);
        let decoded = decoder.read_next_frame().expect("a GIF").expect("a frame");
        let rgb: Vec<u8> =
            decoded.buffer.chunks_exact(4).flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
        assert_eq!(rgb, rgb8_over(&frame, [0; 3]));
    }

    #[test]
    fn exactly_the_pixels_of_less_than_half_alpha_are_transparent() {
        let mut frame = gradient(64, 48, 0.1);
        for (index, pixel) in frame.rgba.iter_mut().enumerate() {
            match index % 3 {
                0 => *pixel = pixel.map(|channel| channel * 0.4),
                1 => *pixel = [0.0, 0.0, 0.0, 1.0],
                _ => {}
            }
        }
        let file = encoded(&[frame.clone(), frame], Background::Transparent);
        let mut decoder = decoder(&file);
        for _ in 0..2 {
            let decoded = decoder.read_next_frame().expect("a GIF").expect("a frame");
            assert_eq!(decoded.dispose, DisposalMethod::Background);
            for (index, pixel) in decoded.buffer.chunks_exact(4).enumerate() {
                assert_eq!(pixel[3] == 0, index % 3 == 0, "pixel {index}");
            }
        }
    }

    #[test]
    fn delays_keep_to_the_rate() {
        for fps in [1, 7, 24, 25, 30, 50] {
            let total: u32 = (0..fps).map(|frame| u32::from(delay_cs(frame, fps))).sum();
            assert_eq!(total, 100, "{fps}");
        }
        assert_eq!(delay_cs(0, 100), 2);
    }
}
