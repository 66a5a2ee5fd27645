use std::io::Write;
use std::path::Path;

use super::write_aside::{check_target, write_aside};
use crate::Error;

/// Writes a text, such as a report, with a line end behind it: whole or not at all.
///
/// # Errors
/// When the file cannot be written. What stood at `path` still stands then.
pub fn write_text_file(path: &Path, text: &str) -> Result<(), Error> {
    write_aside(path, |writer| writeln!(writer, "{text}"))
}

/// Whether a text can be written to `path`, asked before the work is done: its folder is there, and it is not
/// something other than a file.
///
/// # Errors
/// When not, and why.
pub fn check_text_file(path: &Path) -> Result<(), Error> {
    check_target(path).map(|_| ())
}
