//! The rules by which a figure is worse.

use super::{Compared, ComparedGroup, ComparedTime, Comparison, NoLongerRun, TimeChange};
use crate::output::{Group, groups};
use crate::runner::NOT_ASKED_FOR;
use crate::{BenchResults, Run};

/// Pictures may differ by so much more whatever the tolerance: a driver's rounding is of this size.
const DIFFERENCE_FLOOR: f64 = 1e-4;

pub fn judge(old: &BenchResults, new: &BenchResults, tolerance: f64) -> Comparison {
    let mut comparison = Comparison {
        rows: Vec::new(),
        no_longer_run: Vec::new(),
        only_in_one: Vec::new(),
        warnings: warnings(old, new),
        tolerance,
    };
    let times_count = same_machine(old, new);
    let (old_groups, new_groups) = (groups(old), groups(new));
    for group in &old_groups {
        match new_groups.iter().find(|other| is_same(group, other)) {
            Some(other) => match compared(group, other, tolerance, times_count) {
                Some(row) => comparison.rows.push(row),
                None => comparison.only_in_one.push(format!("{}: no view is in both", named(group))),
            },
            None => match reason(new, group) {
                Some(reason) => comparison.no_longer_run.push(NoLongerRun {
                    data_set: group.data_set.to_owned(),
                    tf: group.tf.to_owned(),
                    executor: group.executor.to_owned(),
                    reason,
                }),
                None => comparison.only_in_one.push(format!("{}: only in the old results", named(group))),
            },
        }
    }
    let is_new = |group: &&Group<'_>| !old_groups.iter().any(|other| is_same(group, other));
    let only_new = new_groups.iter().filter(is_new);
    comparison.only_in_one.extend(only_new.map(|group| format!("{}: only in the new results", named(group))));
    comparison
}

fn is_same(a: &Group<'_>, b: &Group<'_>) -> bool {
    (a.data_set, a.tf, a.executor) == (b.data_set, b.tf, b.executor)
}

fn named(group: &Group<'_>) -> String {
    format!("{}, {}, {}", group.data_set, group.tf, group.executor)
}

/// Why an executor did not draw a group that it should have drawn, if it says so.
fn reason(results: &BenchResults, group: &Group<'_>) -> Option<String> {
    let data_set = results.data_sets.iter().find(|data_set| data_set.name == group.data_set)?;
    data_set.transfer_functions.iter().find(|tf| *tf == group.tf)?;
    let record = results.executors.iter().find(|record| record.name == group.executor)?;
    match (record.reasons.is_empty(), record.ran) {
        (false, _) if record.reasons == [NOT_ASKED_FOR] => None,
        (false, _) => Some(record.reasons.join(" ")),
        (true, false) => Some("no reason was given".to_owned()),
        (true, true) => None,
    }
}

fn compared(old: &Group<'_>, new: &Group<'_>, tolerance: f64, times_count: bool) -> Option<ComparedGroup> {
    let pairs: Vec<(&Run, &Run)> = old
        .runs
        .iter()
        .filter_map(|run| Some((*run, *new.runs.iter().find(|other| other.view == run.view)?)))
        .collect();
    if pairs.is_empty() {
        return None;
    }
    let grew = |figures: Option<(f64, f64)>, floor: f64| {
        figures.map(|(old, new)| {
            let is_regression = new > old * (1.0 + tolerance) && new - old > floor;
            Compared { old, new, is_regression }
        })
    };
    let rendered = |run: &Run| run.bricks.map(|bricks| bricks.rendered as f64);
    Some(ComparedGroup {
        data_set: old.data_set.to_owned(),
        tf: old.tf.to_owned(),
        executor: old.executor.to_owned(),
        views: pairs.len(),
        time: time(&pairs, tolerance, times_count),
        rendered: grew(folded(&pairs, rendered, |a, b| a + b), 0.0),
        samples: grew(folded(&pairs, |run| run.samples.map(|samples| samples as f64), |a, b| a + b), 0.0),
        peak_anon: grew(folded(&pairs, |run| run.peak_anon_bytes.map(|bytes| bytes as f64), f64::max), 0.0),
        difference: grew(folded(&pairs, |run| run.difference.map(|d| d.largest), f64::max), DIFFERENCE_FLOOR),
    })
}

/// Of the views where both have the figure.
fn folded(
    pairs: &[(&Run, &Run)],
    figure: impl Fn(&Run) -> Option<f64>,
    fold: impl Fn(f64, f64) -> f64,
) -> Option<(f64, f64)> {
    let figures = pairs.iter().filter_map(|(old, new)| Some((figure(old)?, figure(new)?)));
    figures.reduce(|all, one| (fold(all.0, one.0), fold(all.1, one.1)))
}

fn time(pairs: &[(&Run, &Run)], tolerance: f64, times_count: bool) -> ComparedTime {
    let old = |of: fn(&Run) -> f64| pairs.iter().map(|(old, _)| of(old)).sum::<f64>();
    let new = |of: fn(&Run) -> f64| pairs.iter().map(|(_, new)| of(new)).sum::<f64>();
    let (old_ms, new_ms) = (old(|run| run.render_ms.median), new(|run| run.render_ms.median));
    let change = if new(|run| run.render_ms.q1) > old(|run| run.render_ms.q3) {
        TimeChange::Slower
    } else if new(|run| run.render_ms.q3) < old(|run| run.render_ms.q1) {
        TimeChange::Faster
    } else {
        TimeChange::WithinNoise
    };
    let is_regression = times_count && change == TimeChange::Slower && new_ms > old_ms * (1.0 + tolerance);
    ComparedTime { old_ms, new_ms, change, is_regression }
}

fn same_machine(old: &BenchResults, new: &BenchResults) -> bool {
    let (old, new) = (&old.provenance.machine, &new.provenance.machine);
    (&old.processor, &old.adapter) == (&new.processor, &new.adapter)
}

fn warnings(old: &BenchResults, new: &BenchResults) -> Vec<String> {
    let mut warnings = Vec::new();
    if !same_machine(old, new) {
        warnings.push(format!(
            "the machines differ ({}; {}): times are shown but not judged, counts are",
            machine(old),
            machine(new)
        ));
    }
    let settings = [
        ("threads", old.settings.threads as u64, new.settings.threads as u64),
        ("bytes of GPU memory", old.settings.gpu_memory_bytes, new.settings.gpu_memory_bytes),
        (
            "threads of the machine",
            old.provenance.machine.processors as u64,
            new.provenance.machine.processors as u64,
        ),
    ];
    for (name, old, new) in settings {
        if old != new {
            warnings.push(format!("{name}: {old} then, {new} since; times may differ for that alone"));
        }
    }
    for set in &old.data_sets {
        let other = new.data_sets.iter().find(|other| other.name == set.name);
        if other.is_some_and(|other| (other.extent, &other.dtype) != (set.extent, &set.dtype)) {
            warnings.push(format!(
                "{}: the volumes differ in extent or type; their figures are not of one thing",
                set.name
            ));
        }
    }
    warnings
}

fn machine(results: &BenchResults) -> String {
    let machine = &results.provenance.machine;
    format!("{}, {}", machine.processor, machine.adapter.as_deref().unwrap_or("no GPU"))
}
