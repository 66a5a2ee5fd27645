//! `glassbrick bench`: measures every executor, or compares two such measurements.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use anyhow::{Context, Result, bail};
use glassbrick_benches::{
    BenchPlan, Executor, Runner, check_folder, compare, comparison_table, provenance, read_results, table,
    work, write_results,
};

use crate::figures::time;
use crate::job::{BenchJob, open_gpu};
use crate::progress::Progress;
use crate::terminal;

/// What is not kept stands here, in the folder for results, while a benchmark runs.
const SCRATCH: &str = ".scratch";

/// Does the job; `words` are the command as it was typed.
///
/// # Errors
/// When nothing could be measured, a file cannot be read or written, or a comparison finds something worse.
pub fn run(job: &BenchJob, words: &[OsString], start: Instant) -> Result<()> {
    match job {
        BenchJob::Measure { plan, folder } => measure(plan, folder, words, start),
        BenchJob::Task { plan, task, scratch } => {
            Ok(work(plan, *task, scratch, open_gpu, io::stdout().lock())?)
        }
        BenchJob::Compare { old, new, tolerance } => {
            let comparison = compare(&read_results(old)?, &read_results(new)?, *tolerance)?;
            terminal::print(&comparison_table(&comparison))?;
            if comparison.is_regression() {
                bail!("{}: is worse than {}", new.display(), old.display());
            }
            Ok(())
        }
    }
}

fn measure(plan: &BenchPlan, folder: &Path, words: &[OsString], start: Instant) -> Result<()> {
    check_folder(folder)?;
    let scratch = Scratch::make(folder)?;
    let opened = plan.executors.iter().any(|executor| Executor::needs_gpu(*executor)).then(open_gpu);
    let (gpu, no_gpu) = match opened {
        Some(Ok(gpu)) => (Some(gpu), None),
        Some(Err(error)) => (None, Some(error.to_string())),
        None => (None, None),
    };
    let typed: Vec<String> = words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let provenance = provenance(&as_typed(typed), gpu.as_ref());
    drop(gpu);
    let progress = Progress::start("measuring");
    let runner = Runner {
        plan,
        scratch: &scratch.0,
        no_gpu,
        worker: &|task| worker(words, task, &scratch.0),
        progress: &|what, share| {
            progress.on(what);
            if let Some(share) = share {
                progress.share(share);
            }
        },
    };
    let results = runner.run(provenance)?;
    drop(progress);
    if results.runs.is_empty() {
        let reasons = results.executors.iter().flat_map(|executor| &executor.reasons);
        bail!("nothing could be measured: {}", reasons.cloned().collect::<Vec<_>>().join("; "));
    }
    // First what would be lost if files could not be written.
    terminal::print(&table(&results))?;
    let files = write_results(&results, folder, &scratch.0)?;
    let files: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
    let took = time(start.elapsed().as_secs_f64() * 1e3);
    terminal::print(&format!("Wrote {}\nin {took}.", files.join("\n      ")))
}

/// The command without the folder that the program happens to lie in.
fn as_typed(mut words: Vec<String>) -> Vec<String> {
    if let Some(program) = words.first_mut() {
        *program = env!("CARGO_BIN_NAME").to_owned();
    }
    words
}

/// This very command, to do one task.
fn worker(words: &[OsString], task: usize, scratch: &Path) -> Command {
    let program = std::env::current_exe().unwrap_or_else(|_| words[0].clone().into());
    let mut command = Command::new(program);
    // In front of the flags that were typed, among which there may be a --.
    command
        .arg(&words[1])
        .arg("--task")
        .arg(task.to_string())
        .arg("--scratch")
        .arg(scratch)
        .args(&words[2..]);
    command
}

/// A folder that is gone with this.
struct Scratch(std::path::PathBuf);

impl Scratch {
    /// Makes it in the folder for results; one that a killed benchmark left is emptied.
    fn make(folder: &Path) -> Result<Self> {
        let path = folder.join(SCRATCH);
        if path.exists() {
            fs::remove_dir_all(&path).with_context(|| format!("{}: cannot be emptied", path.display()))?;
        }
        fs::create_dir_all(&path).with_context(|| format!("{}: cannot be made", path.display()))?;
        Ok(Self(path))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // The next benchmark empties what could not be removed.
        let _ = fs::remove_dir_all(&self.0);
    }
}
