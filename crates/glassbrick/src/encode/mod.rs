//! Pictures as files: a finished frame and what is told about it, encoded and put in place whole or not at all.
//!
//! Pictures of 8 bits (PNG, and every animation) lie over a background and are sRGB-encoded; EXR keeps the linear
//! light, the alpha and the depth. Nothing here knows how a frame came about.

mod animation;
mod apng;
mod avi;
mod background;
mod exr;
mod gif;
mod output_format;
mod picture;
mod png;
mod report_text;
mod srgb;
mod text_file;
mod write_aside;

pub use animation::{AnimationDesc, AnimationWriter};
pub use background::Background;
pub use output_format::{AnimationFormat, OutputFormat, PictureFormat};
pub use picture::write_picture;
pub use text_file::{check_text_file, write_text_file};

use std::path::Path;

use crate::Error;

/// Whether a picture or animation can be written to `path`, asked before the work is done: its extension says a
/// format, its folder is there, and it is not something other than a file.
///
/// # Errors
/// When not, and why.
pub fn check_output(path: &Path) -> Result<OutputFormat, Error> {
    let format = OutputFormat::from_path(path)?;
    write_aside::check_target(path)?;
    Ok(format)
}
