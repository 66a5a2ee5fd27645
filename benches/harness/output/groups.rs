//! Runs of one data set, transfer function and executor, and what their views have in common.

use crate::{BenchResults, BrickFractions, Run, Spread};

/// All views of one data set by one transfer function and one executor.
#[derive(Clone, Debug)]
pub(crate) struct Group<'a> {
    pub data_set: &'a str,
    pub tf: &'a str,
    pub executor: &'a str,
    pub runs: Vec<&'a Run>,
}

/// A group's views in a few figures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Summary {
    pub views: usize,
    /// The median over views of their medians.
    pub fps: f64,
    /// Of the slowest view.
    pub fps_lowest: f64,
    /// Of the fastest view.
    pub fps_highest: f64,
    /// Means over views.
    pub fractions: Option<BrickFractions>,
    /// Sums over the first frames of views.
    pub misses: Option<u64>,
    pub bytes_read: Option<u64>,
    pub bytes_uploaded: Option<u64>,
    /// Sum over views.
    pub samples: Option<u64>,
    /// The largest.
    pub peak_anon_bytes: Option<u64>,
    /// The largest.
    pub difference: Option<f64>,
    pub complete: bool,
}

/// All runs by group: in the order of the data sets, their transfer functions and the executors.
pub(crate) fn groups(results: &BenchResults) -> Vec<Group<'_>> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for run in &results.runs {
        match groups.iter_mut().find(|group| group.holds(run)) {
            Some(group) => group.runs.push(run),
            None => {
                let Run { data_set, tf, executor, .. } = run;
                groups.push(Group { data_set, tf, executor, runs: vec![run] });
            }
        }
    }
    groups.sort_by_key(|group| group.place(results));
    groups
}

impl Group<'_> {
    fn holds(&self, run: &Run) -> bool {
        (self.data_set, self.tf, self.executor) == (&run.data_set, &run.tf, &run.executor)
    }

    fn place(&self, results: &BenchResults) -> [usize; 3] {
        let data_set = results.data_sets.iter().position(|data_set| data_set.name == self.data_set);
        let tfs = data_set.map(|index| &results.data_sets[index].transfer_functions);
        let tf = tfs.and_then(|tfs| tfs.iter().position(|tf| tf == self.tf));
        let executor = results.executors.iter().position(|executor| executor.name == self.executor);
        [data_set, tf, executor].map(|place| place.unwrap_or(usize::MAX))
    }

    pub fn summary(&self) -> Summary {
        let fps: Vec<f64> = self.runs.iter().map(|run| run.fps.median).collect();
        let residencies = || self.runs.iter().filter_map(|run| run.residency.as_ref());
        Summary {
            views: self.runs.len(),
            fps: Spread::of(&fps).median,
            fps_lowest: fps.iter().copied().fold(f64::INFINITY, f64::min),
            fps_highest: fps.iter().copied().fold(0.0, f64::max),
            fractions: mean_fractions(self.runs.iter().filter_map(|run| run.fractions)),
            misses: sum(residencies().map(|residency| residency.misses)),
            bytes_read: sum(residencies().map(|residency| residency.bytes_read)),
            bytes_uploaded: sum(residencies().map(|residency| residency.bytes_uploaded)),
            samples: sum(self.runs.iter().filter_map(|run| run.samples)),
            peak_anon_bytes: self.runs.iter().filter_map(|run| run.peak_anon_bytes).max(),
            difference: self
                .runs
                .iter()
                .filter_map(|run| run.difference.map(|difference| difference.largest))
                .max_by(f64::total_cmp),
            complete: self.runs.iter().all(|run| run.complete),
        }
    }
}

/// The sum of what is there; nothing where nothing is.
fn sum(values: impl Iterator<Item = u64>) -> Option<u64> {
    values.reduce(u64::saturating_add)
}

/// Of each stage apart.
pub(crate) fn mean_fractions(fractions: impl Iterator<Item = BrickFractions>) -> Option<BrickFractions> {
    let fractions: Vec<BrickFractions> = fractions.collect();
    let mean =
        |of: fn(&BrickFractions) -> f64| fractions.iter().map(of).sum::<f64>() / fractions.len() as f64;
    (!fractions.is_empty()).then(|| BrickFractions {
        non_empty: mean(|fractions| fractions.non_empty),
        filtered_visible: mean(|fractions| fractions.filtered_visible),
        in_frustum: mean(|fractions| fractions.in_frustum),
        not_occluded: mean(|fractions| fractions.not_occluded),
        rendered: mean(|fractions| fractions.rendered),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::results;

    #[test]
    fn groups_follow_the_records_and_not_the_order_of_runs() {
        let mut results = results();
        results.runs.reverse();
        let groups = groups(&results);
        assert_eq!(groups.len(), 3 * 3 * 5);
        let named = |group: &Group<'_>| [group.data_set, group.tf, group.executor].map(str::to_owned);
        let first = &results.data_sets[0];
        assert_eq!(named(&groups[1]), [&first.name, &first.transfer_functions[0], "sw"]);
        assert_eq!(named(&groups[5])[1], first.transfer_functions[1]);
    }

    #[test]
    fn a_summary_holds_the_middle_the_ends_and_the_sums() {
        let mut results = results();
        results.runs.truncate(3);
        for (index, run) in results.runs.iter_mut().enumerate() {
            (run.data_set, run.tf, run.executor) = ("d".into(), "t".into(), "e".into());
            run.fps.median = [10.0, 40.0, 20.0][index];
            run.samples = [Some(5), None, Some(7)][index];
            run.residency = None;
            run.fractions = None;
            run.peak_anon_bytes = [Some(3), Some(9), None][index];
        }
        let summary = groups(&results)[0].summary();
        assert_eq!((summary.fps_lowest, summary.fps, summary.fps_highest), (10.0, 20.0, 40.0));
        assert_eq!((summary.samples, summary.misses, summary.peak_anon_bytes), (Some(12), None, Some(9)));
        assert_eq!(summary.fractions, None);
    }
}
