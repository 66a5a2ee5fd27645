use std::path::Path;

use crate::Error;

/// A format of one picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureFormat {
    /// 8 bits, sRGB, over a background.
    Png,
    /// Linear light, alpha and depth as 32-bit floats.
    Exr,
}

/// A format of many pictures in one file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnimationFormat {
    /// 256 colours a frame, plays everywhere.
    Gif,
    /// Lossless, plays in browsers.
    Apng,
    /// Motion JPEG, plays in video players and cutting programs.
    Avi,
}

/// What a file's extension asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputFormat {
    Picture(PictureFormat),
    Animation(AnimationFormat),
}

impl OutputFormat {
    const BY_EXTENSION: [(&str, Self); 5] = [
        ("png", Self::Picture(PictureFormat::Png)),
        ("exr", Self::Picture(PictureFormat::Exr)),
        ("gif", Self::Animation(AnimationFormat::Gif)),
        ("apng", Self::Animation(AnimationFormat::Apng)),
        ("avi", Self::Animation(AnimationFormat::Avi)),
    ];

    /// The format that the extension of `path` names, in upper or lower case.
    ///
    /// # Errors
    /// When it names none.
    pub fn from_path(path: &Path) -> Result<Self, Error> {
        let extension = path.extension().unwrap_or_default();
        Self::BY_EXTENSION
            .into_iter()
            .find(|(name, _)| extension.eq_ignore_ascii_case(name))
            .map(|(_, format)| format)
            .ok_or_else(|| Error::Output {
                path: path.to_owned(),
                what: format!(
                    "{} is no picture format; use .png or .exr for a picture, .gif, .apng or .avi for an animation",
                    if extension.is_empty() {
                        "a name without extension".to_owned()
                    } else {
                        format!(".{}", extension.display())
                    }
                ),
            })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_name_formats_in_any_case() {
        let format = |name: &str| OutputFormat::from_path(Path::new(name)).ok();
        assert_eq!(format("a.png"), Some(OutputFormat::Picture(PictureFormat::Png)));
        assert_eq!(format("a.b/c.EXR"), Some(OutputFormat::Picture(PictureFormat::Exr)));
        assert_eq!(format("a.png.avi"), Some(OutputFormat::Animation(AnimationFormat::Avi)));
    }

    #[test]
    fn an_unknown_extension_is_told_what_there_is() {
        for name in ["out.bmp", "out", ".png", "out."] {
            let error = OutputFormat::from_path(Path::new(name)).expect_err("no format").to_string();
            assert!(error.contains(".png or .exr") && error.contains(".avi"), "{error}");
            assert_eq!(error.lines().count(), 1);
        }
    }
}
