use std::path::Path;

use glassbrick_volume::Frame;

use super::report_text::check_report;
use super::write_aside::write_aside;
use super::{Background, OutputFormat, PictureFormat, exr, png};
use crate::Error;

/// Writes a frame and its report, a JSON text, as the picture that the extension of `path` asks for.
///
/// The background counts for PNG alone: EXR keeps the alpha.
///
/// # Errors
/// When the extension is no picture's, the frame is empty, or the file cannot be written. What stood at `path`
/// still stands then.
pub fn write_picture(
    path: &Path,
    frame: &Frame,
    background: Background,
    report_json: &str,
) -> Result<(), Error> {
    let refuse = |what: &str| Err(Error::Output { path: path.to_owned(), what: what.to_owned() });
    let OutputFormat::Picture(format) = OutputFormat::from_path(path)? else {
        return refuse("is the name of an animation; use .png or .exr for a picture");
    };
    let pixels = u64::from(frame.width) * u64::from(frame.height);
    if pixels == 0 || frame.rgba.len() as u64 != pixels || frame.depth_mm.len() as u64 != pixels {
        return refuse("the frame has no pixels, or not as many as its size says; render it again");
    }
    check_report(report_json, path)?;
    write_aside(path, |writer| match format {
        PictureFormat::Png => png::encode(frame, background, report_json, writer),
        PictureFormat::Exr => exr::encode(frame, report_json, writer),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_extension_chooses_the_format() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let frame = Frame::transparent(3, 2);
        for (name, magic) in [("a.png", b"\x89PNG".as_slice()), ("a.exr", &[0x76, 0x2f, 0x31, 0x01])] {
            let path = folder.path().join(name);
            write_picture(&path, &frame, Background::default(), "{}").expect("it can be written");
            assert!(fs::read(&path).expect("there").starts_with(magic), "{name}");
        }
    }

    #[test]
    fn what_is_no_picture_is_refused_and_nothing_is_written() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let frame = Frame::transparent(3, 2);
        let short = Frame { rgba: Vec::new(), ..frame.clone() };
        let empty = Frame::transparent(0, 2);
        let attempts = [("a.gif", &frame), ("a.tiff", &frame), ("a.png", &short), ("a.exr", &empty)];
        for (name, frame) in attempts {
            let path = folder.path().join(name);
            let error = write_picture(&path, frame, Background::default(), "{}").expect_err("refused");
            assert!(error.to_string().contains(name), "{error}");
        }
        assert_eq!(fs::read_dir(folder.path()).expect("there").count(), 0);
    }
}
