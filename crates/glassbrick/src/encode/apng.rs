use std::io::{self, Write};

use glassbrick_volume::Frame;
use png::Writer;

use super::png::{pixels, srgb_encoder};
use super::{AnimationDesc, Background};

/// Writes an animated PNG that repeats without end; every frame is whole and lossless.
pub struct ApngEncoder<W: Write> {
    writer: Writer<W>,
    background: Background,
}

impl<W: Write> ApngEncoder<W> {
    /// Starts the file. The frame rate must fit 16 bits.
    pub fn new(writer: W, desc: &AnimationDesc) -> io::Result<Self> {
        let mut encoder = srgb_encoder(writer, desc.width, desc.height, desc.background);
        encoder.set_animated(desc.frames, 0)?;
        let fps = u16::try_from(desc.fps).map_err(io::Error::other)?;
        encoder.set_frame_delay(1, fps)?;
        encoder.validate_sequence(true);
        Ok(Self { writer: encoder.write_header()?, background: desc.background })
    }

    /// Appends a frame of the size that was announced.
    pub fn write_frame(&mut self, frame: &Frame) -> io::Result<()> {
        Ok(self.writer.write_image_data(&pixels(frame, self.background))?)
    }

    /// Ends the file and flushes its writer.
    pub fn finish(self) -> io::Result<()> {
        Ok(self.writer.finish()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn every_frame_comes_back_and_it_loops_without_end() {
        for background in [Background::Color([1, 2, 3]), Background::Transparent] {
            let frames: Vec<Frame> = (0..3u8)
                .map(|i| Frame {
                    rgba: vec![[0.2 * f32::from(i), 0.1, 0.0, 0.7]; 6],
                    ..Frame::transparent(3, 2)
                })
                .collect();
            let mut file = Vec::new();
            let desc = AnimationDesc { width: 3, height: 2, frames: 3, fps: 25, background };
            let mut encoder = ApngEncoder::new(&mut file, &desc).expect("memory takes it");
            for frame in &frames {
                encoder.write_frame(frame).expect("memory takes it");
            }
            encoder.finish().expect("memory takes it");

            let mut reader = png::Decoder::new(Cursor::new(file)).read_info().expect("a PNG");
            let control = *reader.info().animation_control().expect("animated");
            assert_eq!((control.num_frames, control.num_plays), (3, 0));
            assert!(reader.info().srgb.is_some());
            for frame in &frames {
                let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
                reader.next_frame(&mut bytes).expect("a frame");
                assert_eq!(bytes, pixels(frame, background));
                let control = reader.info().frame_control().expect("animated");
                assert_eq!((control.delay_num, control.delay_den), (1, 25));
            }
        }
    }
}
