//! What differs between operating systems.

/// Whether this machine may have a GPU of its own. Starting graphics drivers to find out takes tens of milliseconds and
/// of megabytes, which a picture by the CPU need not pay for: Linux shows devices in its file system, others are asked.
#[cfg(target_os = "linux")]
pub fn may_have_a_gpu() -> bool {
    let has = |folder: &str, name: &str| {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries.into_iter().any(|entry| entry.file_name().to_string_lossy().starts_with(name))
    };
    // Kernel drivers with a render node, NVIDIA's own, Windows' subsystem for Linux, and those of ARM boards.
    has("/dev/dri", "renderD") || has("/dev", "nvidia") || has("/dev", "dxg") || has("/dev", "mali")
}

#[cfg(not(target_os = "linux"))]
pub fn may_have_a_gpu() -> bool {
    true
}
