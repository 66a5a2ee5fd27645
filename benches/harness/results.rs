//! What a benchmark found, as `bench.json` holds it; docs/BENCHMARKS.md describes every field.

use serde::{Deserialize, Serialize};

/// The version of this form. A change that readers must know of raises it.
pub const SCHEMA: u32 = 1;

/// A whole benchmark.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BenchResults {
    pub schema: u32,
    pub provenance: Provenance,
    pub settings: BenchSettings,
    pub data_sets: Vec<DataSetRecord>,
    pub executors: Vec<ExecutorRecord>,
    pub runs: Vec<Run>,
    pub budgets: Vec<BudgetPoint>,
    pub nearly_empty: Vec<NearlyEmptyPoint>,
}

/// Where the figures come from: all that is needed to get them again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// Of glassbrick.
    pub version: String,
    /// What the command was built from.
    pub commit: String,
    /// As it was typed.
    pub command: String,
    /// When it began, in UTC, as RFC 3339 has it.
    pub date: String,
    pub machine: Machine,
}

/// What it ran on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Machine {
    pub processor: String,
    /// How many threads it runs at once.
    pub processors: usize,
    /// What the CPU executor draws with.
    pub instruction_set: String,
    pub memory_bytes: Option<u64>,
    /// The operating system and its version.
    pub system: String,
    /// The GPU, its interface and its driver; nothing where there is none.
    pub adapter: Option<String>,
    /// Whether that is a driver that computes on the CPU.
    pub adapter_is_software: Option<bool>,
}

/// What all runs have in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BenchSettings {
    pub size: [u32; 2],
    /// Distance of samples, in voxels of the smallest spacing.
    pub step: f64,
    pub opacity_cutoff: f64,
    pub mode: String,
    /// `off` or `phong`.
    pub shading: String,
    /// How often a picture was drawn for its times, at most, after the first.
    pub repeat: usize,
    /// Of each data set.
    pub threads: usize,
    /// Of each GPU executor.
    pub gpu_memory_bytes: u64,
}

/// A volume that was drawn.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DataSetRecord {
    pub name: String,
    /// What it was opened from: a format's name, or how it was generated.
    pub source: String,
    pub extent: [u32; 3],
    pub spacing_mm: [f64; 3],
    pub dtype: String,
    /// Of its voxels.
    pub bytes: u64,
    /// Of level 0.
    pub bricks: usize,
    /// In the order in which they were drawn.
    pub transfer_functions: Vec<String>,
}

/// A way to draw, and whether it could be had here.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExecutorRecord {
    pub name: String,
    /// What it is, in one line.
    pub summary: String,
    pub ran: bool,
    /// Why it did not run at all, or not on everything: one sentence each.
    pub reasons: Vec<String>,
}

/// One view of one data set by one transfer function and one executor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    pub data_set: String,
    /// The transfer function.
    pub tf: String,
    pub executor: String,
    pub view: String,
    /// Of the frames behind the first, whose bricks are resident as far as memory goes.
    pub fps: Spread,
    pub render_ms: Spread,
    /// Every time that the two above are of.
    pub render_all_ms: Vec<f64>,
    pub stage_ms: StageMs,
    /// What each stage left; nothing for an executor without bricks.
    pub bricks: Option<BrickStages>,
    /// The same as fractions of `bricks.total`.
    pub fractions: Option<BrickFractions>,
    /// Of the view's first frame; nothing for an executor without bricks.
    pub residency: Option<Residency>,
    /// Evaluated for one frame; nothing where they cannot be counted.
    pub samples: Option<u64>,
    pub complete: bool,
    /// Of the process that drew this data set's views by this transfer function and executor, and nothing else.
    pub peak_anon_bytes: Option<u64>,
    pub peak_rss_bytes: Option<u64>,
    /// From SW's picture; nothing for SW itself, or where it did not run.
    pub difference: Option<Difference>,
    /// The picture's file, seen from the folder of bench.json, if it was kept.
    pub picture: Option<String>,
}

/// The middle of some measurements, and what half of them lie between.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    pub median: f64,
    pub q1: f64,
    pub q3: f64,
}

/// Milliseconds of each stage of a view's first frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageMs {
    /// Opening the volume without the scan for its ranges; once a process.
    pub open: f64,
    /// That scan, and what depends on the transfer function alone; once a process.
    pub tables: f64,
    pub plan: f64,
    /// Threads that waited for bricks, summed over them.
    pub load: f64,
    /// From the camera to the linear frame, plan and loads included.
    pub first_render: f64,
    /// The picture as a PNG; 0 where none was written.
    pub encode: f64,
}

/// How many bricks each stage of a frame left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BrickStages {
    pub total: usize,
    pub non_empty: usize,
    /// After α and β.
    pub filtered_visible: usize,
    pub in_frustum: usize,
    pub not_occluded: usize,
    pub rendered: usize,
}

/// Fractions of all bricks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct BrickFractions {
    pub non_empty: f64,
    pub filtered_visible: f64,
    pub in_frustum: f64,
    pub not_occluded: f64,
    pub rendered: f64,
}

/// What went through the memory that holds bricks: the GPU's for its passes, RAM for the CPU.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Residency {
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

/// How far two pictures in linear light are apart, over red, green, blue and alpha.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Difference {
    /// The largest of all pixels but 0.01 % of them.
    pub largest: f64,
    /// The largest of all.
    pub maximum: f64,
    pub mean: f64,
}

/// The same frame with a memory of some size.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BudgetPoint {
    pub data_set: String,
    pub tf: String,
    pub executor: String,
    pub view: String,
    pub budget_bytes: u64,
    /// Atlas textures that the budget has room for; nothing for the CPU.
    pub textures: Option<u32>,
    pub render_ms: Spread,
    /// Of the first frame.
    pub first: Residency,
    /// Of the frame behind it.
    pub again: Residency,
    /// From the same executor's picture in its largest memory.
    pub difference: Difference,
}

/// The same frame without nearly empty bricks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NearlyEmptyPoint {
    pub data_set: String,
    pub tf: String,
    pub executor: String,
    pub view: String,
    pub alpha: f64,
    pub beta: f64,
    pub bricks: BrickStages,
    pub fractions: BrickFractions,
    pub render_ms: Spread,
    /// From the same executor's picture with α = 0 and β = 1.
    pub difference: Difference,
}

impl BrickStages {
    /// As fractions of all bricks.
    pub fn fractions(&self) -> BrickFractions {
        let of_total = |bricks: usize| if self.total == 0 { 0.0 } else { bricks as f64 / self.total as f64 };
        BrickFractions {
            non_empty: of_total(self.non_empty),
            filtered_visible: of_total(self.filtered_visible),
            in_frustum: of_total(self.in_frustum),
            not_occluded: of_total(self.not_occluded),
            rendered: of_total(self.rendered),
        }
    }
}

impl Spread {
    /// Of measurements, in any order, by linear interpolation between them; zeros where there are none.
    pub fn of(measurements: &[f64]) -> Self {
        let mut sorted = measurements.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |share: f64| {
            let Some(last) = sorted.len().checked_sub(1) else { return 0.0 };
            let place = share * last as f64;
            let below = place as usize;
            let above = (below + 1).min(last);
            sorted[below] + (place - below as f64) * (sorted[above] - sorted[below])
        };
        Self { median: at(0.5), q1: at(0.25), q3: at(0.75) }
    }

    /// Frames per second of times in milliseconds; the slowest quarter is the first.
    pub fn per_second(&self) -> Self {
        let per_second = |ms: f64| if ms > 0.0 { 1e3 / ms } else { 0.0 };
        Self { median: per_second(self.median), q1: per_second(self.q3), q3: per_second(self.q1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quartiles_lie_between_measurements() {
        assert_eq!(Spread::of(&[4.0, 1.0, 3.0, 2.0, 5.0]), Spread { median: 3.0, q1: 2.0, q3: 4.0 });
        assert_eq!(Spread::of(&[1.0, 2.0]), Spread { median: 1.5, q1: 1.25, q3: 1.75 });
        assert_eq!(Spread::of(&[7.0]), Spread { median: 7.0, q1: 7.0, q3: 7.0 });
        assert_eq!(Spread::of(&[]).median, 0.0);
    }

    #[test]
    fn the_slow_quarter_of_times_is_the_low_quarter_of_rates() {
        let rates = Spread { median: 100.0, q1: 50.0, q3: 200.0 }.per_second();
        assert_eq!(rates, Spread { median: 10.0, q1: 5.0, q3: 20.0 });
    }

    #[test]
    fn fractions_are_of_all_bricks() {
        let stages = BrickStages {
            total: 8,
            non_empty: 4,
            filtered_visible: 4,
            in_frustum: 3,
            not_occluded: 2,
            rendered: 2,
        };
        assert_eq!(stages.fractions().rendered, 0.25);
        assert_eq!(BrickStages { total: 0, ..stages }.fractions().rendered, 0.0);
    }
}
