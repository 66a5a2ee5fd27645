//! What the operating system tells of this process's memory and this machine's.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// The peak is looked for this often, besides at the end of every stage.
const SAMPLING_INTERVAL: Duration = Duration::from_millis(20);

static PEAK_ANON_BYTES: AtomicU64 = AtomicU64::new(0);

/// Peaks of this process's memory, where the system tells them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MemoryPeaks {
    /// Memory that is not a mapped file's.
    pub anon_bytes: Option<u64>,
    /// Resident memory.
    pub rss_bytes: Option<u64>,
}

/// Starts to watch for the peak of anonymous memory, of which systems tell only the present amount.
pub fn watch() {
    static WATCHING: OnceLock<()> = OnceLock::new();
    WATCHING.get_or_init(|| {
        if status_field("RssAnon:").is_none() {
            return;
        }
        // Without the thread, the peak is that of the stages' ends.
        let _ = std::thread::Builder::new().name("memory-watch".into()).spawn(|| {
            loop {
                note_anon();
                std::thread::sleep(SAMPLING_INTERVAL);
            }
        });
    });
}

/// The peaks so far.
pub fn peaks() -> MemoryPeaks {
    note_anon();
    let anon_bytes = PEAK_ANON_BYTES.load(Ordering::Relaxed);
    MemoryPeaks { anon_bytes: (anon_bytes > 0).then_some(anon_bytes), rss_bytes: status_field("VmHWM:") }
}

/// Memory of this machine, or of the container that this process runs in, where it can be told.
pub fn total_bytes() -> Option<u64> {
    system_memory(sysinfo::System::total_memory, |limits| limits.total_memory)
}

/// Memory that can be had without pushing others out, where it can be told.
pub fn available_bytes() -> Option<u64> {
    system_memory(sysinfo::System::available_memory, |limits| limits.free_memory)
}

/// Whether so much can be had at once: a process may be held to less than is free.
pub fn can_reserve(bytes: u64) -> bool {
    let Ok(bytes) = usize::try_from(bytes) else { return false };
    let mut reserved = Vec::<u8>::new();
    let is_reserved = reserved.try_reserve_exact(bytes).is_ok();
    // Else compilers see that nothing is put there, and take it to succeed.
    std::hint::black_box(&reserved);
    is_reserved
}

fn system_memory(
    of_machine: fn(&sysinfo::System) -> u64,
    of_container: fn(&sysinfo::CGroupLimits) -> u64,
) -> Option<u64> {
    let mut system = sysinfo::System::new().ok()?;
    system.refresh_memory();
    let container = system.cgroup_limits().map_or(u64::MAX, |limits| of_container(&limits));
    Some(of_machine(&system).min(container)).filter(|&bytes| bytes > 0)
}

fn note_anon() {
    if let Some(bytes) = status_field("RssAnon:") {
        PEAK_ANON_BYTES.fetch_max(bytes, Ordering::Relaxed);
    }
}

/// A field of Linux's `/proc/self/status`, which is in KiB.
fn status_field(name: &str) -> Option<u64> {
    if !cfg!(target_os = "linux") {
        return None;
    }
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}
