//! A disk that is full ends an ingest in one line, and loses nothing.
#![cfg(unix)]

use std::fs;
use std::process::{Command, Output};

use super::{Scratch, assert_one_line, files, noise};
use crate::binary::binary;

const INGEST: &str =
    "ingest {}/v.raw --extent 100x100x100 --dtype u16 --brick 32 --codec none --threads 2 -o {}/v.zarr";

/// A volume whose shards are 4 MiB.
fn prepared() -> Scratch {
    let scratch = Scratch::new();
    let bytes = noise(1_000_000);
    scratch.file("small.raw", &bytes[..2 * 20 * 20 * 20]);
    scratch.file("v.raw", &bytes);
    scratch
}

/// Runs `glassbrick` at the end of a shell script.
fn in_shell(scratch: &Scratch, shell: &[&str], before: &str, line: &str, after: &str) -> Output {
    let (binary, line) = (binary().display(), scratch.line(line));
    let script = format!("{}; '{binary}' {line}; code=$?; {}; exit $code", before, scratch.line(after));
    let (program, flags) = shell.split_first().expect("a shell");
    Command::new(program).args(flags).arg(scratch.line(&script)).output().expect("a shell can be run")
}

#[track_caller]
fn assert_refused(output: &Output, words: &str) {
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{told}");
    let message = told.strip_suffix('\n').expect("a line");
    assert_one_line(message);
    assert!(message.starts_with("error: ") && message.contains("cannot be written"), "{message}");
    assert!(message.contains(words) && message.contains("v.zarr"), "{message}");
}

/// A limit on the length of a file is met in the middle of a shard, of a table, or of metadata.
#[test]
fn files_that_cannot_grow_end_a_run_and_lose_nothing() {
    let scratch = prepared();
    for limit in [0, 1, 200, 3000] {
        let limited = format!("trap '' XFSZ; ulimit -f {limit}");
        let output = in_shell(&scratch, &["sh", "-c"], &limited, INGEST, "true");
        assert_refused(&output, "File too large");
        assert_eq!(scratch.names(), ["small.raw", "v.raw"], "limit {limit}");
    }
    scratch.run(INGEST);
    let whole = files(&scratch.path("v.zarr"));
    scratch.run("ingest {}/small.raw --extent 20x20x20 --dtype u16 --brick 16 -o {}/v.zarr --force");
    let old = files(&scratch.path("v.zarr"));
    for (number, limit) in [0, 200, 3000].into_iter().enumerate() {
        let limited = format!("trap '' XFSZ; ulimit -f {limit}");
        let force = format!("{INGEST} --force");
        assert_refused(&in_shell(&scratch, &["sh", "-c"], &limited, &force, "true"), "File too large");
        assert!(files(&scratch.path("v.zarr")) == old, "limit {limit}");
        assert_eq!(scratch.names(), ["small.raw", "v.raw", "v.zarr"], "limit {limit}");
        if number == 2 {
            let resume = format!("{INGEST} --force --resume");
            assert_refused(&in_shell(&scratch, &["sh", "-c"], &limited, &resume, "true"), "File too large");
            assert!(files(&scratch.path("v.zarr")) == old);
            scratch.run(&resume);
            assert!(files(&scratch.path("v.zarr")) == whole);
            assert_eq!(scratch.names(), ["small.raw", "v.raw", "v.zarr"]);
        }
    }
}

/// On a small file system of its own, which only the superuser can make, and not everywhere.
#[test]
fn a_full_disk_ends_a_run_and_loses_nothing() {
    let scratch = prepared();
    fs::create_dir(scratch.path("disk")).expect("a folder");
    let unshared = ["unshare", "--mount", "sh", "-c"];
    let mount = "mount -t tmpfs -o size=3m tmpfs {}/disk";
    let can_mount = Command::new(unshared[0])
        .args(&unshared[1..])
        .arg(scratch.line(mount))
        .output()
        .is_ok_and(|output| output.status.success());
    if !can_mount {
        eprintln!("SKIPPED: this user cannot mount a file system; only files that cannot grow are tested");
        return;
    }
    for (codec, more) in [("none", ""), ("lz4", " --resume")] {
        let before = format!(
            "{mount} && '{}' ingest {{}}/small.raw --extent 20x20x20 --dtype u16 --brick 16 --codec none \
             -o {{}}/disk/v.zarr > {{}}/old && cp -r {{}}/disk/v.zarr {{}}/before.{codec}",
            binary().display()
        );
        let line = INGEST.replace("-o {}/v", "-o {}/disk/v").replace("none", codec) + " --force" + more;
        let after = format!("cp -r {{}}/disk {{}}/after.{codec}");
        let output = in_shell(&scratch, &unshared, &before, &line, &after);
        assert_refused(&output, "No space left");
        let [old, new] = [format!("before.{codec}"), format!("after.{codec}/v.zarr")]
            .map(|name| files(&scratch.path(&name)));
        assert!(!old.is_empty() && old == new);
        let kept: &[&str] =
            if more.is_empty() { &["v.zarr"] } else { &[".v.zarr.glassbrick-ingest", "v.zarr"] };
        assert_eq!(super::names_in(&scratch.path(&format!("after.{codec}"))), kept);
    }
}
