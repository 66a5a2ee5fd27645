//! Tests that cannot be run say so.

use std::env;
use std::io::{Write, stderr};

/// Says aloud that the test which runs is skipped, because of what is missing.
///
/// # Panics
/// In CI, where nothing may be missing.
pub fn skipped(missing: &str) {
    assert!(env::var_os("CI").is_none(), "{missing}");
    let thread = std::thread::current();
    let test = thread.name().unwrap_or("a test");
    // Past the test harness, which shows nothing of tests that pass.
    writeln!(stderr(), "\nSKIPPED: {test}: {missing}").expect("stderr is open");
}
