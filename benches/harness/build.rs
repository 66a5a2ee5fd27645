//! Tells the harness which commit it was built from.

use std::process::Command;

/// What a build that is no checkout of git says.
const UNKNOWN: &str = "unknown";

fn main() {
    let commit = git(&["rev-parse", "--short=12", "HEAD"]).map_or_else(
        || UNKNOWN.to_owned(),
        |hash| {
            let is_changed = git(&["status", "--porcelain", "--untracked-files=no"]).is_some();
            if is_changed { format!("{hash} with changes") } else { hash }
        },
    );
    println!("cargo::rustc-env=GLASSBRICK_COMMIT={commit}");
    // Whatever can change what is measured, and the commit that it is of.
    for path in
        ["../crates", "../shaders", "../benches", "../tools/phantom", "../Cargo.lock", "../.git/logs/HEAD"]
    {
        if std::path::Path::new(path).exists() {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}

/// What git answers, if there is a git and it answers anything.
fn git(arguments: &[&str]) -> Option<String> {
    let output =
        Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    let answer = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    (!answer.is_empty()).then_some(answer)
}
