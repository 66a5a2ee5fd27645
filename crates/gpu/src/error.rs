use glassbrick_residency::ResidencyError;
use glassbrick_volume::ReadError;

/// Why the GPU could not draw. Each message is one line that says what is wrong and what to do.
#[derive(Debug, thiserror::Error)]
pub enum GpuError {
    #[error(
        "no GPU is found, and no driver that stands in for one; use the CPU (--backend cpu), or install a driver"
    )]
    NoAdapter,
    #[error("no adapter's name contains \"{name}\"; there are: {there}")]
    NoAdapterOfThatName { name: String, there: String },
    #[error("{adapter} cannot draw volumes: it has {lacks}; use the CPU (--backend cpu)")]
    TooWeak { adapter: String, lacks: &'static str },
    #[error("{adapter} cannot be opened: {what}; use the CPU (--backend cpu)")]
    NoDevice { adapter: String, what: String },
    #[error("the GPU was lost while it drew: {what}; draw again, or use the CPU (--backend cpu)")]
    Lost { what: String },
    #[error("the GPU says: {what}")]
    Driver { what: String },
    #[error(
        "the GPU has no memory left for {what}, {needed_bytes} bytes; close other programs that use it, or use the CPU (--backend cpu)"
    )]
    OutOfMemory { what: &'static str, needed_bytes: u64 },
    #[error(
        "--gpu-memory {budget_bytes} bytes are too few: one atlas texture of this volume has {needed_bytes} bytes"
    )]
    BudgetTooSmall { budget_bytes: u64, needed_bytes: u64 },
    #[error(
        "bricks of {brick_edge} voxels are too large for this GPU, whose textures have {largest} at most"
    )]
    BrickTooLarge { brick_edge: u32, largest: u32 },
    #[error("{0}")]
    Read(#[from] ReadError),
    #[error("{0}")]
    Residency(#[from] ResidencyError),
}

impl GpuError {
    /// What a driver said, of which wgpu makes several lines.
    pub(crate) fn driver(error: &dyn std::error::Error) -> Self {
        Self::Driver { what: one_line(&error.to_string()) }
    }
}

/// A message without its line breaks.
pub(crate) fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}
