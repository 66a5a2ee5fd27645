//! What the user reads: results on stdout, warnings and the one line of an error on stderr.

use std::io::{self, Write};

use anyhow::{Context, Result};

/// Prints lines on stdout. A reader that has gone away wants no more, which is no error.
///
/// # Errors
/// When stdout cannot be written.
pub fn print(text: &str) -> Result<()> {
    let mut stdout = io::stdout().lock();
    match writeln!(stdout, "{text}").and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        result => result.context("stdout cannot be written"),
    }
}

/// Prints warnings on stderr.
pub fn warn(warnings: &[String]) {
    for warning in warnings {
        tell("warning", warning);
    }
}

/// Prints the one line of an error on stderr.
pub fn tell_error(message: &str) {
    tell("error", message);
}

/// What went wrong and why, in one sentence. Errors that already say their cause do not say it twice.
pub fn with_causes(error: &anyhow::Error) -> String {
    let mut told = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !told.contains(&cause) {
            told.push_str(": ");
            told.push_str(&cause);
        }
    }
    told
}

fn tell(kind: &str, message: &str) {
    // With stderr gone there is nobody left to tell.
    let _ = writeln!(io::stderr().lock(), "{kind}: {}", one_line(message));
}

/// The text without line ends and other controls, which names of files may hold.
pub fn one_line(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { ' ' } else { character }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cause_is_told_once() {
        let error =
            anyhow::anyhow!("disk full").context("a.png: cannot be written: disk full").context("no picture");
        assert_eq!(with_causes(&error), "no picture: a.png: cannot be written: disk full");
    }

    #[test]
    fn names_of_files_cannot_break_a_line() {
        assert_eq!(one_line("a\nb\u{1b}[31m"), "a b [31m");
    }
}
