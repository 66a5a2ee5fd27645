use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use glassbrick_volume::Frame;

use super::apng::ApngEncoder;
use super::avi::{AviEncoder, jpeg};
use super::gif::GifEncoder;
use super::write_aside::AsideFile;
use super::{AnimationFormat, Background, OutputFormat};
use crate::Error;

/// Fastest animation; no format and no screen needs more.
const MAX_FPS: u32 = 100;

/// Longest side in pixels that GIF and JPEG can say.
const MAX_SIDE_GIF_JPEG: u32 = 65_535;

/// What an animation will hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AnimationDesc {
    pub width: u32,
    pub height: u32,
    /// How many frames there will be.
    pub frames: u32,
    /// Frames per second, 1 to 100; a GIF plays 50 at most.
    pub fps: u32,
    /// What stands behind the frames. In a GIF a pixel is transparent or opaque; an AVI needs a colour.
    pub background: Background,
}

/// An animation in the making, written frame by frame; there is no file until it is finished.
pub struct AnimationWriter {
    desc: AnimationDesc,
    encoder: Encoder,
    started: u32,
    written: u32,
    aside: AsideFile,
}

enum Encoder {
    Gif(GifEncoder<BufWriter<File>>),
    Apng(ApngEncoder<BufWriter<File>>),
    Avi { encoder: AviEncoder<BufWriter<File>>, color: [u8; 3] },
}

impl AnimationWriter {
    /// Starts the animation that the extension of `path` asks for.
    ///
    /// # Errors
    /// When the extension is no animation's, the format cannot hold what `desc` says, or `path` cannot be written.
    pub fn create(path: &Path, desc: AnimationDesc) -> Result<Self, Error> {
        let format = check(path, &desc)?;
        let aside = AsideFile::create(path)?;
        let writer = aside.writer()?;
        let encoder = match (format, desc.background) {
            (AnimationFormat::Gif, _) => GifEncoder::new(writer, &desc).map(Encoder::Gif),
            (AnimationFormat::Apng, _) => ApngEncoder::new(writer, &desc).map(Encoder::Apng),
            (AnimationFormat::Avi, Background::Color(color)) => {
                AviEncoder::new(writer, &desc).map(|encoder| Encoder::Avi { encoder, color })
            }
            (AnimationFormat::Avi, Background::Transparent) => {
                return refuse(path, "an AVI has no transparency; give a background colour, or use .apng");
            }
        };
        let encoder = encoder.map_err(|source| aside.error(source))?;
        Ok(Self { desc, encoder, started: 0, written: 0, aside })
    }

    /// Appends the next frame.
    ///
    /// # Errors
    /// When its size is another, there are enough already, the file cannot be written or an AVI grows beyond 2 GiB.
    /// The animation cannot go on after that.
    pub fn write_frame(&mut self, frame: &Frame) -> Result<(), Error> {
        let AnimationDesc { width, height, frames, .. } = self.desc;
        let pixels = width as usize * height as usize;
        if (frame.width, frame.height) != (width, height) || frame.rgba.len() != pixels {
            return refuse(self.aside.path(), "a frame of another size; render all frames alike");
        }
        if self.started == frames || self.started != self.written {
            return refuse(self.aside.path(), "no further frame fits; start the animation anew");
        }
        self.started += 1;
        let result = match &mut self.encoder {
            Encoder::Gif(encoder) => encoder.write_frame(frame),
            Encoder::Apng(encoder) => encoder.write_frame(frame),
            Encoder::Avi { encoder, color } => match jpeg(frame, *color) {
                Ok(jpeg) if !encoder.has_room_for(&jpeg) => {
                    return refuse(self.aside.path(), "grows beyond 2 GiB; use fewer or smaller frames");
                }
                Ok(jpeg) => encoder.write_jpeg(&jpeg),
                Err(error) => Err(error),
            },
        };
        result.map_err(|source| self.aside.error(source))?;
        self.written += 1;
        Ok(())
    }

    /// Ends the animation and puts the file in place.
    ///
    /// # Errors
    /// When frames are missing, or the file cannot be written.
    pub fn finish(self) -> Result<(), Error> {
        if self.written != self.desc.frames {
            let what = format!("{} of {} frames were written; draw them all", self.written, self.desc.frames);
            return refuse(self.aside.path(), &what);
        }
        let ended = match self.encoder {
            Encoder::Gif(encoder) => encoder.finish().and_then(flush),
            Encoder::Apng(encoder) => encoder.finish(),
            Encoder::Avi { encoder, .. } => encoder.finish().and_then(flush),
        };
        ended.map_err(|source| self.aside.error(source))?;
        self.aside.commit()
    }
}

fn flush(mut writer: BufWriter<File>) -> io::Result<()> {
    writer.flush()
}

fn refuse<T>(path: &Path, what: &str) -> Result<T, Error> {
    Err(Error::Output { path: path.to_owned(), what: what.to_owned() })
}

/// The format of `path`, if it can hold the animation.
fn check(path: &Path, desc: &AnimationDesc) -> Result<AnimationFormat, Error> {
    let OutputFormat::Animation(format) = OutputFormat::from_path(path)? else {
        return refuse(path, "is the name of one picture; use .gif, .apng or .avi for an animation");
    };
    if desc.width == 0 || desc.height == 0 || desc.frames == 0 {
        return refuse(path, "an animation needs at least one frame of one pixel");
    }
    if desc.fps == 0 || desc.fps > MAX_FPS {
        return refuse(path, "an animation plays 1 to 100 frames per second; choose one of these rates");
    }
    let is_large = desc.width.max(desc.height) > MAX_SIDE_GIF_JPEG;
    if is_large && format != AnimationFormat::Apng {
        return refuse(
            path,
            "a GIF or AVI is at most 65535 pixels wide and high; make it smaller or use .apng",
        );
    }
    Ok(format)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn desc(frames: u32) -> AnimationDesc {
        AnimationDesc { width: 4, height: 3, frames, fps: 25, background: Background::default() }
    }

    #[test]
    fn each_format_is_there_after_finish_and_not_before() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        for (name, magic) in [("a.gif", "GIF89a"), ("a.apng", "\u{fffd}PNG"), ("a.avi", "RIFF")] {
            let path = folder.path().join(name);
            let mut writer = AnimationWriter::create(&path, desc(2)).expect("it can be written");
            for _ in 0..2 {
                writer.write_frame(&Frame::transparent(4, 3)).expect("it can be written");
            }
            assert!(!path.exists(), "{name}");
            writer.finish().expect("it can be written");
            let bytes = fs::read(&path).expect("there");
            assert!(String::from_utf8_lossy(&bytes).starts_with(magic), "{name}");
        }
        assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 3);
    }

    #[test]
    fn an_animation_that_is_not_finished_leaves_what_was_there() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        for name in ["a.gif", "a.apng", "a.avi"] {
            let path = folder.path().join(name);
            fs::write(&path, "old").expect("a scratch file");
            let mut writer = AnimationWriter::create(&path, desc(2)).expect("it can be written");
            writer.write_frame(&Frame::transparent(4, 3)).expect("it can be written");
            let error = writer.finish().expect_err("a frame is missing").to_string();
            assert!(error.contains("1 of 2 frames"), "{error}");
            assert_eq!(fs::read(&path).expect("still there"), b"old");
        }
        assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 3);
    }

    #[test]
    fn frames_of_another_size_and_too_many_are_refused() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let path = folder.path().join("a.gif");
        let mut writer = AnimationWriter::create(&path, desc(1)).expect("it can be written");
        assert!(writer.write_frame(&Frame::transparent(3, 4)).is_err());
        writer.write_frame(&Frame::transparent(4, 3)).expect("it can be written");
        assert!(writer.write_frame(&Frame::transparent(4, 3)).is_err());
        writer.finish().expect("it can be written");
    }

    #[test]
    fn what_a_format_cannot_hold_is_refused_at_the_start() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let sound = desc(2);
        for (name, desc, words) in [
            ("a.png", sound, "one picture"),
            ("a.mp4", sound, ".gif, .apng or .avi"),
            ("a.gif", AnimationDesc { frames: 0, ..sound }, "at least one frame"),
            ("a.gif", AnimationDesc { fps: 0, ..sound }, "frames per second"),
            ("a.avi", AnimationDesc { width: 65_536, ..sound }, "65535"),
            ("a.avi", AnimationDesc { background: Background::Transparent, ..sound }, "no transparency"),
        ] {
            let error = AnimationWriter::create(&folder.path().join(name), desc).err().expect("refused");
            assert!(error.to_string().contains(words) && error.to_string().contains(name), "{error}");
        }
        assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);
    }
}
