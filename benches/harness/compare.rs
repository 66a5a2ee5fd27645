//! Whether a benchmark came out worse than an earlier one.

mod judge;
mod table;
#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::BenchResults;
pub use table::comparison_table;

/// Two benchmarks beside each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// What both have: one for each data set, transfer function and executor.
    pub rows: Vec<ComparedGroup>,
    /// What an executor drew before and does not draw any more.
    pub no_longer_run: Vec<NoLongerRun>,
    /// What only one of them has: told, not judged.
    pub only_in_one: Vec<String>,
    /// What makes comparing them doubtful.
    pub warnings: Vec<String>,
    /// By which fraction figures may grow.
    pub tolerance: f64,
}

/// A data set, transfer function and executor, over the views that both have.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparedGroup {
    pub data_set: String,
    pub tf: String,
    pub executor: String,
    pub views: usize,
    pub time: ComparedTime,
    /// Bricks rendered, summed over views.
    pub rendered: Option<Compared>,
    /// Summed over views.
    pub samples: Option<Compared>,
    /// Bytes; the largest.
    pub peak_anon: Option<Compared>,
    /// From SW's picture; the largest.
    pub difference: Option<Compared>,
}

/// Sums of medians over views, in milliseconds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ComparedTime {
    pub old_ms: f64,
    pub new_ms: f64,
    pub change: TimeChange,
    /// Slower than noise explains, by more than the tolerance, on the same machine.
    pub is_regression: bool,
}

/// Where the middle halves of two times lie to each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimeChange {
    /// They do not overlap: new times are longer.
    Slower,
    /// They overlap.
    WithinNoise,
    /// They do not overlap: new times are shorter.
    Faster,
}

/// A figure that is better small.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compared {
    pub old: f64,
    pub new: f64,
    /// It grew by more than it may.
    pub is_regression: bool,
}

/// An executor that drew something before.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoLongerRun {
    pub data_set: String,
    pub tf: String,
    pub executor: String,
    pub reason: String,
}

/// Why two benchmarks cannot be compared.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum CompareError {
    #[error(
        "{setting} was {old} and is {new}: pictures differ, nothing can be compared; measure again with the same {setting}"
    )]
    OtherPictures { setting: &'static str, old: String, new: String },
    #[error("the tolerance is {0}: give a fraction of 0 or more, such as 0.05")]
    Tolerance(String),
}

/// Holds new results against old ones; figures may grow by `tolerance`, a fraction.
pub fn compare(old: &BenchResults, new: &BenchResults, tolerance: f64) -> Result<Comparison, CompareError> {
    if !(tolerance >= 0.0 && tolerance.is_finite()) {
        return Err(CompareError::Tolerance(tolerance.to_string()));
    }
    must_be_same_pictures(old, new)?;
    Ok(judge::judge(old, new, tolerance))
}

fn must_be_same_pictures(old: &BenchResults, new: &BenchResults) -> Result<(), CompareError> {
    let (old, new) = (&old.settings, &new.settings);
    let size = |[width, height]: [u32; 2]| format!("{width}x{height}");
    let settings = [
        ("size", size(old.size), size(new.size)),
        ("step", old.step.to_string(), new.step.to_string()),
        ("mode", old.mode.clone(), new.mode.clone()),
        ("shading", old.shading.clone(), new.shading.clone()),
        ("opacity cutoff", old.opacity_cutoff.to_string(), new.opacity_cutoff.to_string()),
    ];
    match settings.into_iter().find(|(_, old, new)| old != new) {
        Some((setting, old, new)) => Err(CompareError::OtherPictures { setting, old, new }),
        None => Ok(()),
    }
}

impl Comparison {
    /// Whether anything came out worse.
    pub fn is_regression(&self) -> bool {
        !self.no_longer_run.is_empty() || self.rows.iter().any(ComparedGroup::is_regression)
    }
}

impl ComparedGroup {
    /// Whether any of its figures came out worse.
    pub fn is_regression(&self) -> bool {
        let counts = [self.rendered, self.samples, self.peak_anon, self.difference];
        self.time.is_regression || counts.iter().flatten().any(|count| count.is_regression)
    }
}
