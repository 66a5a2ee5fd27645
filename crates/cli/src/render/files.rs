use std::path::PathBuf;

use glassbrick::{AnimationDesc, AnimationWriter, Background, Error, Rendered, report_json, write_picture};

use crate::job::{Output, RenderJob};

/// How fast an animation plays.
const FRAMES_PER_SECOND: u32 = 25;

/// The files that frames are written to, one after the other.
pub struct PictureFiles<'a> {
    background: Background,
    target: Target<'a>,
}

enum Target<'a> {
    /// The files still to be written.
    Pictures(std::slice::Iter<'a, PathBuf>),
    Animation(Box<AnimationWriter>),
}

impl<'a> PictureFiles<'a> {
    /// # Errors
    /// When an animation cannot be begun.
    pub fn create(job: &'a RenderJob) -> Result<Self, Error> {
        let (background, [width, height]) = (job.background, job.size);
        let target = match &job.output {
            Output::Picture(_) | Output::Sequence(_) => Target::Pictures(job.output.files().iter()),
            Output::Animation { path, frames } => {
                let desc =
                    AnimationDesc { width, height, frames: *frames, fps: FRAMES_PER_SECOND, background };
                Target::Animation(Box::new(AnimationWriter::create(path, desc)?))
            }
        };
        Ok(Self { background, target })
    }

    /// Writes the next frame; a picture carries its report.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn write(&mut self, drawn: &Rendered) -> Result<(), Error> {
        match &mut self.target {
            Target::Animation(writer) => writer.write_frame(&drawn.frame),
            Target::Pictures(paths) => {
                let path = paths.next().expect("there is a file for each frame");
                write_picture(path, &drawn.frame, self.background, &report_json(&drawn.report).to_string())
            }
        }
    }

    /// Puts an animation in place.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn finish(self) -> Result<(), Error> {
        match self.target {
            Target::Animation(writer) => writer.finish(),
            Target::Pictures(_) => Ok(()),
        }
    }
}
