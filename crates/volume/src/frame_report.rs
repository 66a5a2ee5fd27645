use crate::VolumeDesc;

/// What was drawn, skipped and loaded for a frame, and whether its picture is complete.
#[derive(Clone, Debug)]
pub struct FrameReport {
    pub volume: VolumeDesc,
    /// Voxels that were not finite and are read as 0.
    pub not_finite: u64,
    pub backend: &'static str,
    /// What the backend ran on.
    pub adapter: String,
    /// Which pass drew the frame.
    pub pass: &'static str,
    pub mode: &'static str,
    pub size: [u32; 2],
    pub level: u32,
    pub step: f64,
    pub opacity_cutoff: f64,
    pub alpha: f64,
    pub beta: f64,
    pub bricks: BrickCounts,
    pub residency: ResidencyCounts,
    /// Samples evaluated; nothing where they cannot be counted.
    pub samples: Option<u64>,
    pub complete: bool,
    pub time_ms: StageTimes,
    /// Peak of memory that is not a mapped file's; nothing where the system does not tell.
    pub peak_anon_bytes: Option<u64>,
    /// Peak of resident memory; nothing where the system does not tell.
    pub peak_rss_bytes: Option<u64>,
    pub warnings: Vec<String>,
}

/// How many bricks each stage of a frame left.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BrickCounts {
    pub total: usize,
    /// Bricks that the transfer function cannot show anything of.
    pub empty: usize,
    /// What remains without the empty and, by α and β, the nearly empty ones.
    pub filtered_visible: usize,
    /// Of these, what lies in the frustum.
    pub in_frustum: usize,
    /// Of these, what was hidden before the CPU loaded it; on a GPU, what was not rendered, loaded or not.
    pub occluded: usize,
    /// Bricks of which at least one sample was evaluated.
    pub rendered: usize,
    pub boundary_pinned: usize,
    /// Bricks that could not be read and were left out.
    pub damaged: usize,
}

impl BrickCounts {
    /// Rendered of all bricks.
    pub fn rendered_fraction(&self) -> f64 {
        if self.total == 0 { 0.0 } else { self.rendered as f64 / self.total as f64 }
    }
}

/// What went through the memory that holds bricks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ResidencyCounts {
    pub budget_bytes: u64,
    pub peak_bytes: u64,
    pub hits: u64,
    pub misses: u64,
    pub uploads: u64,
    pub bytes_uploaded: u64,
    pub evictions: u64,
    /// From files, before decoding.
    pub bytes_read: u64,
}

/// Milliseconds of each stage.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StageTimes {
    pub open: f64,
    pub tables: f64,
    pub plan: f64,
    pub load: f64,
    /// From a given camera to the finished linear frame; the median of `render_all`.
    pub render: f64,
    pub render_all: Vec<f64>,
    pub encode: f64,
    pub total: f64,
}
