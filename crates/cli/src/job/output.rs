use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use glassbrick::{AnimationFormat, Background, OutputFormat, PictureFormat, check_output};

use crate::usage::UsageError;

/// What stands in OUT for the number of a frame.
const PLACEHOLDER: &str = "{frame}";

/// Where pictures go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Output {
    Picture(PathBuf),
    /// A file for each frame of a turn.
    Sequence(Vec<PathBuf>),
    /// All frames of a turn in one file.
    Animation {
        path: PathBuf,
        frames: u32,
    },
}

impl Output {
    /// The files that `out` and `--frames` name together; each can be written.
    ///
    /// # Errors
    /// When they do not fit together, or a file cannot be written.
    pub fn new(out: &Path, frames: Option<u32>, background: Background) -> Result<Self> {
        let has_placeholder = out.to_str().is_some_and(|out| out.contains(PLACEHOLDER));
        let format = OutputFormat::from_path(out)?;
        let usage = |what: &str| Err(UsageError(format!("{}: {what}", out.display())).into());
        let output = match (format, frames) {
            (OutputFormat::Picture(_), None) if has_placeholder => {
                return usage("holds {frame}, and --frames does not say how many");
            }
            (OutputFormat::Picture(_), None) => Self::Picture(out.to_owned()),
            (OutputFormat::Picture(_), Some(frames)) if has_placeholder => {
                Self::Sequence((0..frames).map(|frame| frame_path(out, frame, frames)).collect())
            }
            (OutputFormat::Picture(_), Some(_)) => {
                return usage(
                    "would be written once a frame: let it hold {frame}, or be a .gif, .apng or .avi",
                );
            }
            (OutputFormat::Animation(_), None) => {
                return usage("is an animation: say with --frames how many frames a turn has");
            }
            (OutputFormat::Animation(AnimationFormat::Avi), _) if background == Background::Transparent => {
                return usage("an AVI has no transparency: give a colour as --background, or use .apng");
            }
            (OutputFormat::Animation(_), Some(frames)) => Self::Animation { path: out.to_owned(), frames },
        };
        for path in output.files() {
            check_output(path)?;
        }
        Ok(output)
    }

    /// Every file that will be written.
    pub fn files(&self) -> &[PathBuf] {
        match self {
            Self::Sequence(paths) => paths,
            Self::Picture(path) | Self::Animation { path, .. } => std::slice::from_ref(path),
        }
    }

    /// How many views there are.
    pub fn frames(&self) -> u32 {
        match self {
            Self::Picture(_) => 1,
            Self::Sequence(paths) => paths.len() as u32,
            Self::Animation { frames, .. } => *frames,
        }
    }

    /// Whether the files keep the frames' alpha, so that nothing stands behind them.
    pub fn keeps_alpha(&self) -> bool {
        let is_exr =
            |path| matches!(OutputFormat::from_path(path), Ok(OutputFormat::Picture(PictureFormat::Exr)));
        self.files().first().is_some_and(|path| is_exr(path))
    }
}

/// The file of a frame: its number, as wide as the last one's, in place of the placeholder.
fn frame_path(out: &Path, frame: u32, frames: u32) -> PathBuf {
    let width = (frames - 1).to_string().len();
    PathBuf::from(out.to_string_lossy().replace(PLACEHOLDER, &format!("{frame:0width$}")))
}

/// Refuses to write over what is read.
///
/// # Errors
/// When a file to write is a file to read.
pub fn check_nothing_read_is_overwritten<'a>(
    written: impl Iterator<Item = &'a PathBuf>,
    read: &[&Path],
) -> Result<()> {
    let read: Vec<PathBuf> = read.iter().filter_map(|path| path.canonicalize().ok()).collect();
    for path in written {
        if path.canonicalize().is_ok_and(|path| read.contains(&path)) {
            bail!("{}: is read, and would be written over; give another name", path.display());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output(out: &str, frames: Option<u32>) -> Result<Output> {
        Output::new(Path::new(out), frames, Background::Transparent)
    }

    #[test]
    fn frames_are_numbered_as_wide_as_the_last() {
        let names = |frames| output("a-{frame}.png", Some(frames)).expect("sound").files().to_vec();
        assert_eq!(names(1), [PathBuf::from("a-0.png")]);
        assert_eq!(names(10)[9], PathBuf::from("a-9.png"));
        assert_eq!((&names(11)[3], names(11).len()), (&PathBuf::from("a-03.png"), 11));
    }

    #[test]
    fn what_does_not_fit_together_is_a_usage_error() {
        for (out, frames, words) in [
            ("a.png", Some(3), "once a frame"),
            ("a-{frame}.png", None, "--frames"),
            ("a.gif", None, "--frames"),
            ("a.avi", Some(3), "no transparency"),
        ] {
            let error = output(out, frames).expect_err(out);
            assert!(error.is::<UsageError>() && error.to_string().contains(words), "{error}");
        }
    }

    #[test]
    fn a_file_that_cannot_be_written_is_told_before_the_work() {
        for out in ["a.bmp", "no-such-folder/a.png"] {
            assert!(!output(out, None).expect_err(out).is::<UsageError>());
        }
    }

    #[test]
    fn a_file_that_is_read_is_not_written_over() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let (input, other) = (folder.path().join("a.png"), folder.path().join("b.png"));
        std::fs::write(&input, "voxels").expect("a scratch file");
        let check = |written| check_nothing_read_is_overwritten([&written].into_iter(), &[&input]);
        assert!(check(folder.path().join(".").join("a.png")).is_err());
        assert!(check(other).is_ok());
    }
}
