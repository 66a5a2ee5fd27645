//! The `glassbrick` command, as users run it.

use std::env;
use std::ffi::OsStr;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use serde_json::Value;

/// The binary: that which `GLASSBRICK_BIN` names, or the one of this workspace, built in the folder and profile of
/// these tests, so that little is compiled twice.
pub fn binary() -> &'static Path {
    static BINARY: OnceLock<PathBuf> = OnceLock::new();
    BINARY.get_or_init(|| env::var_os("GLASSBRICK_BIN").map_or_else(built, PathBuf::from))
}

fn built() -> PathBuf {
    let test = env::current_exe().expect("a test knows where it is");
    let profile_folder = test.parent().and_then(Path::parent).expect("tests lie in PROFILE/deps");
    let above = profile_folder.parent().expect("profiles lie in the target folder");
    let name = |folder: &Path| folder.file_name().and_then(OsStr::to_str).unwrap_or_default().to_owned();
    let profile = match name(profile_folder).as_str() {
        "debug" => "dev".to_owned(),
        other => other.to_owned(),
    };
    let mut cargo = Command::new(env!("CARGO"));
    // The tests are named too, because dependencies are built with the features that all named packages want.
    cargo.args(["build", "--quiet", "--message-format=json-render-diagnostics", "--profile", &profile]);
    cargo.args(["--package", "glassbrick-cli", "--package", "glassbrick-tests"]);
    cargo.args(["--bin", "glassbrick", "--test", "main"]);
    // Cargo marks a target folder that it makes, and keeps what it knows of rustc in any.
    if ["CACHEDIR.TAG", ".rustc_info.json"].iter().any(|name| above.join(name).exists()) {
        cargo.arg("--target-dir").arg(above);
    } else {
        let target_folder = above.parent().expect("a triple lies in the target folder");
        cargo.arg("--target").arg(name(above)).arg("--target-dir").arg(target_folder);
    }
    let output = cargo
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .stderr(Stdio::inherit())
        .output()
        .expect("cargo can be run");
    assert!(output.status.success(), "glassbrick-cli does not build");
    let messages = String::from_utf8(output.stdout).expect("JSON is text");
    let is_binary =
        |message: &Value| message["target"]["name"] == "glassbrick" && message["executable"].is_string();
    let found = messages.lines().map(|line| serde_json::from_str(line).expect("JSON")).find(is_binary);
    let executable = found.as_ref().and_then(|message| message["executable"].as_str());
    executable.expect("cargo tells where the binary is").into()
}

/// What a command line came to.
pub struct Outcome {
    line: String,
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
    pub took: Duration,
}

/// Memory that refusing an input may take, address space of the program itself and its threads included.
const LITTLE_MEMORY_KIB: u64 = 256 << 10;

/// Runs `glassbrick` with the words of `line`, split at spaces, and then `paths`.
pub fn glassbrick(line: &str, paths: &[&Path]) -> Outcome {
    outcome(Command::new(binary()), line, paths)
}

/// The same, given minutes.
pub fn glassbrick_at_length(variables: &[(&str, &str)], line: &str, paths: &[&Path]) -> Outcome {
    let mut command = Command::new(binary());
    command.envs(variables.iter().copied());
    outcome_within(Duration::from_secs(300), command, line, paths)
}

/// The same with environment variables set.
pub fn glassbrick_with(variables: &[(&str, &str)], line: &str, paths: &[&Path]) -> Outcome {
    let mut command = Command::new(binary());
    command.envs(variables.iter().copied());
    outcome(command, line, paths)
}

/// What keeps all of Linux's drivers of GPUs away.
pub const NO_DRIVERS: [(&str, &str); 4] = [
    ("VK_DRIVER_FILES", "/nonexistent"),
    ("VK_ICD_FILENAMES", "/nonexistent"),
    ("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent"),
    ("EGL_LOG_LEVEL", "fatal"),
];

/// `glassbrick` with little memory to take, where the system can be told so: elsewhere than on Linux, nothing holds it
/// back, and the tests say nothing of memory. Drivers are kept away, since what they take is not ours.
pub fn glassbrick_in_little_memory(line: &str, paths: &[&Path]) -> Outcome {
    if !cfg!(target_os = "linux") {
        return glassbrick(line, paths);
    }
    let mut shell = Command::new("sh");
    shell.arg("-c").arg(format!("ulimit -v {LITTLE_MEMORY_KIB} && exec \"$0\" \"$@\"")).arg(binary());
    // One heap: glibc sets 64 MiB of addresses aside for each thread's own, twice as many for a moment.
    shell.envs(NO_DRIVERS).env("MALLOC_ARENA_MAX", "1");
    outcome(shell, line, paths)
}

fn outcome(command: Command, line: &str, paths: &[&Path]) -> Outcome {
    outcome_within(Duration::from_secs(20), command, line, paths)
}

fn outcome_within(limit: Duration, command: Command, line: &str, paths: &[&Path]) -> Outcome {
    let mut command = assert_cmd::Command::from_std(command);
    command.args(line.split_whitespace()).args(paths).env_remove("RUST_BACKTRACE");
    // Of Mesa's drivers: without it, they say on stderr that a machine without a screen has none.
    command.env("NODEVICE_SELECT", "1");
    let words: Vec<String> = paths.iter().map(|path| path.display().to_string()).collect();
    binary();
    let start = Instant::now();
    let output = command.timeout(limit).output().expect("the binary can be run");
    Outcome {
        took: start.elapsed(),
        line: format!("glassbrick {line} {}", words.join(" ")),
        code: output.status.code(),
        stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
        stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
    }
}

impl Outcome {
    /// Nothing went wrong, and nothing was said on stderr but warnings.
    #[track_caller]
    pub fn succeeded(self) -> Self {
        assert_eq!(self.code, Some(0), "{self:?}");
        assert!(self.stderr.lines().all(|line| line.starts_with("warning: ")), "{self:?}");
        self
    }

    /// What was printed, as JSON.
    #[track_caller]
    pub fn json(&self) -> Value {
        serde_json::from_str(&self.stdout).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }
}

impl fmt::Debug for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, code, stdout, stderr, took } = self;
        write!(f, "{line}\nexit {code:?} after {took:?}\nstdout: {stdout}\nstderr: {stderr}")
    }
}
