//! An ingest that is killed leaves what was there, and the next one cleans up or goes on.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use super::{Scratch, files, noise};
use crate::binary::binary;

type Files = BTreeMap<PathBuf, Vec<u8>>;

/// Where a run is killed: once this is true of the folder in which it makes the store.
type Moment = (&'static str, fn(&Path) -> bool);

fn state(folder: &Path) -> String {
    fs::read_to_string(folder.join("ingest.json")).unwrap_or_default()
}

/// From the first file to the last.
const MOMENTS: [Moment; 8] = [
    ("the folder is made", |folder| folder.exists()),
    ("the first shard is begun", |folder| folder.join("levels/0/bricks/c/0/0/0/0/0/0").exists()),
    ("the first row of shards is done", |folder| state(folder).contains(r#""shard_rows":1,"#)),
    ("the fourth row of shards is done", |folder| state(folder).contains(r#""shard_rows":4,"#)),
    ("the last row of shards of level 0 is begun", |folder| {
        folder.join("levels/0/bricks/c/8/0/0/0/0/0").exists()
    }),
    ("level 1 is begun", |folder| folder.join("levels/1").exists()),
    ("a row of shards of level 1 is done", |folder| state(folder).contains(r#""level":1,"#)),
    ("metadata is written", |folder| folder.join("levels/zarr.json").exists()),
];

/// Noise that takes a moment to store: 34 layers of bricks, which make 9 rows of shards.
const INGEST: &str = "ingest {}/noise.raw --extent 48x48x400 --dtype u16 --brick 16 --codec lz4 --threads 2";

fn start(scratch: &Scratch, line: &str) -> Child {
    let mut command = Command::new(binary());
    command.args(scratch.line(line).split_whitespace());
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().expect("the binary can be run")
}

/// Kills a run once something is true, if it has not ended before.
fn kill_when(mut child: Child, is_time: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_time() && child.try_wait().expect("it was started").is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "the run neither ends nor gets on");
        thread::sleep(Duration::from_micros(200));
    }
    // It may have ended by itself.
    let _ = child.kill();
    child.wait().expect("it was started");
}

/// Holds that a killed run left the old store or, if it was that far, the whole new one, and hidden folders only.
#[track_caller]
fn assert_nothing_is_half_there(scratch: &Scratch, old: Option<&Files>, new: &Files, moment: &str) {
    let store = scratch.path("v.zarr");
    let names = scratch.names();
    let beside = names.iter().filter(|name| !["noise.raw", "old.raw", "v.zarr"].contains(&name.as_str()));
    for name in beside {
        assert!(name.starts_with(".v.zarr.glassbrick-"), "{moment}: {name}");
    }
    match old {
        None => assert!(!store.exists() || files(&store) == *new, "{moment}: the store is half there"),
        Some(old) => {
            let found = files(&store);
            assert!(found == *old || found == *new, "{moment}: the old store is not what it was");
        }
    }
}

/// A folder with the noise, and the files of the store that an undisturbed run makes of it.
fn prepared() -> (Scratch, Files) {
    let scratch = Scratch::new();
    scratch.file("noise.raw", &noise(48 * 48 * 400));
    scratch.run(&format!("{INGEST} -o {{}}/v.zarr"));
    let whole = files(&scratch.path("v.zarr"));
    fs::remove_dir_all(scratch.path("v.zarr")).expect("ours");
    (scratch, whole)
}

#[test]
fn a_killed_run_leaves_nothing_half_there_and_the_next_cleans_up() {
    let (scratch, whole) = prepared();
    scratch.file("old.raw", &[9; 30 * 30 * 30]);
    let old_store = "ingest {}/old.raw --extent 30x30x30 --dtype u8 --brick 16 -o {}/v.zarr --force";
    let folder = scratch.path(".v.zarr.glassbrick-ingest");
    for (number, (moment, is_time)) in MOMENTS.into_iter().enumerate() {
        let replaces = number % 2 == 0;
        let old = replaces.then(|| {
            scratch.run(old_store);
            files(&scratch.path("v.zarr"))
        });
        if !replaces {
            let _ = fs::remove_dir_all(scratch.path("v.zarr"));
        }
        kill_when(start(&scratch, &format!("{INGEST} -o {{}}/v.zarr --force")), || is_time(&folder));
        assert_nothing_is_half_there(&scratch, old.as_ref(), &whole, moment);
        scratch.run(&format!("{INGEST} -o {{}}/v.zarr --force"));
        assert!(files(&scratch.path("v.zarr")) == whole, "{moment}");
        let mut names = scratch.names();
        names.retain(|name| name != "old.raw");
        assert_eq!(names, ["noise.raw", "v.zarr"], "{moment}");
    }
}

#[test]
fn a_killed_run_that_is_resumed_makes_the_same_store_to_the_byte() {
    let (scratch, whole) = prepared();
    let folder = scratch.path(".v.zarr.glassbrick-ingest");
    let line = format!("{INGEST} -o {{}}/v.zarr --resume --force");
    // Each run goes on where the one before was killed, all the way through.
    for (moment, is_time) in MOMENTS {
        kill_when(start(&scratch, &line), || is_time(&folder));
        assert_nothing_is_half_there(&scratch, None, &whole, moment);
    }
    let told = scratch.run(&line).stdout;
    assert!(files(&scratch.path("v.zarr")) == whole, "{told}");
    assert_eq!(scratch.names(), ["noise.raw", "v.zarr"]);
}

/// Moments that are not chosen by what is in the folder: fractions of the time that an undisturbed run takes.
#[test]
fn whenever_a_run_is_killed_it_can_be_resumed() {
    let (scratch, whole) = prepared();
    let line = format!("{INGEST} -o {{}}/v.zarr --resume");
    let begin = Instant::now();
    scratch.run(&line);
    let took = begin.elapsed();
    for part in [0.1, 0.35, 0.55, 0.75, 0.9] {
        let _ = fs::remove_dir_all(scratch.path("v.zarr"));
        let begin = Instant::now();
        kill_when(start(&scratch, &line), || begin.elapsed() > took.mul_f64(part));
        assert_nothing_is_half_there(&scratch, None, &whole, &format!("after {part} of the time"));
        if !scratch.path("v.zarr").exists() {
            scratch.run(&line);
        }
        assert!(files(&scratch.path("v.zarr")) == whole, "after {part} of the time");
        assert_eq!(scratch.names(), ["noise.raw", "v.zarr"]);
    }
}

/// The lock of a killed run is free.
#[test]
fn a_run_that_another_one_makes_is_refused_until_that_is_killed() {
    let (scratch, whole) = prepared();
    let folder = scratch.path(".v.zarr.glassbrick-ingest");
    let line = format!("{INGEST} -o {{}}/v.zarr");
    let mut child = start(&scratch, &line);
    while !folder.join("levels/0").exists() {
        assert!(child.try_wait().expect("it was started").is_none(), "it is not done yet");
        thread::sleep(Duration::from_micros(200));
    }
    let second = scratch.glassbrick(&line);
    if child.try_wait().expect("it was started").is_none() {
        let message = super::failed(&second);
        assert!(message.contains("another ingest"), "{message}");
    }
    kill_when(child, || true);
    if !scratch.path("v.zarr").exists() {
        scratch.run(&line);
    }
    assert!(files(&scratch.path("v.zarr")) == whole);
}
