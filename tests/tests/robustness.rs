//! Bad input is refused at once: in one line that names what is wrong, in little memory, and with nothing left behind.
//!
//! Every refusal here is asked for by `render`, over a picture that is there already.

mod broken_files;
mod companions;
mod hostile_fields;
mod hostile_headers;
mod no_volumes;
mod outputs;
mod settings;
mod sound_files;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tempfile::TempDir;

use crate::binary::{Outcome, glassbrick_in_little_memory};

pub const EXIT_FAILURE: i32 = 1;
const EXIT_USAGE: i32 = 2;

/// Long enough for a busy machine; a refusal takes a few milliseconds.
const AT_ONCE: Duration = Duration::from_secs(2);

/// A folder to put input in, and beside it one that holds a picture drawn before.
struct Scratch {
    input: TempDir,
    output: TempDir,
}

const PREVIOUS: &[u8] = b"the picture that was there before";

impl Scratch {
    fn new() -> Self {
        let scratch = Self { input: folder(), output: folder() };
        fs::write(scratch.picture(), PREVIOUS).expect("a scratch file");
        scratch
    }

    /// A file in the folder of inputs.
    fn file(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.input.path().join(name);
        fs::write(&path, bytes).expect("a scratch file");
        path
    }

    fn picture(&self) -> PathBuf {
        self.output.path().join("out.png")
    }

    /// Holds that `glassbrick render INPUT -o out.png` with `flags` is refused as it must be; returns the message.
    #[track_caller]
    fn refuses(&self, code: i32, input: &Path, flags: &str) -> String {
        let usual =
            [("--size", "16x16"), ("--threads", "2")].into_iter().filter(|(flag, _)| !flags.contains(flag));
        let usual: String = usual.map(|(flag, value)| format!("{flag} {value} ")).collect();
        let line = format!("render {usual}{flags}");
        let outcome = glassbrick_in_little_memory(&line, &[input, Path::new("-o"), &self.picture()]);
        let message = refused(&outcome, code);
        assert_eq!(names_in(self.output.path()), ["out.png"], "{outcome:?}");
        assert_eq!(fs::read(self.picture()).expect("there"), PREVIOUS, "{outcome:?}");
        message
    }
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a scratch folder")
}

pub fn names_in(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

/// Holds that a command line was refused in one line, and at once; returns that line.
#[track_caller]
pub fn refused(outcome: &Outcome, code: i32) -> String {
    assert_eq!(outcome.code, Some(code), "{outcome:?}");
    assert_eq!(outcome.stdout, "", "{outcome:?}");
    let message = outcome.stderr.strip_suffix('\n').unwrap_or_else(|| panic!("no line: {outcome:?}"));
    assert!(message.starts_with("error: ") && message.lines().count() == 1, "{outcome:?}");
    let is_panic =
        ["panicked", "RUST_BACKTRACE", "unwrap", ".rs:", "Err("].iter().any(|word| message.contains(word));
    assert!(!is_panic, "{outcome:?}");
    assert!((20..900).contains(&message.len()), "{outcome:?}");
    assert!(outcome.took < AT_ONCE, "{outcome:?}");
    message.to_owned()
}
