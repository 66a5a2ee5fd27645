use super::*;
use crate::output::sample::results;
use crate::runner::NOT_ASKED_FOR;
use crate::{Run, Spread};

const TOLERANCE: f64 = 0.05;

/// What a change of the new results' first group leads to.
fn after(change: impl Fn(&mut Run)) -> Comparison {
    let (old, mut new) = (results(), results());
    let (data_set, tf) = (old.runs[0].data_set.clone(), old.runs[0].tf.clone());
    let is_cpu = |run: &&mut Run| run.executor == "cpu" && run.data_set == data_set && run.tf == tf;
    new.runs.iter_mut().filter(is_cpu).for_each(change);
    compare(&old, &new, TOLERANCE).unwrap()
}

fn row(comparison: &Comparison) -> &ComparedGroup {
    comparison.rows.iter().find(|row| row.executor == "cpu").unwrap()
}

fn times(spread: &mut Spread, factor: f64) {
    *spread = Spread { median: spread.median * factor, q1: spread.q1 * factor, q3: spread.q3 * factor };
}

#[test]
fn the_same_results_are_no_regression() {
    let comparison = after(|_| ());
    assert!(!comparison.is_regression());
    assert_eq!(comparison.rows.len(), 45);
    assert_eq!(row(&comparison).views, 12);
    assert!(comparison.warnings.is_empty() && comparison.only_in_one.is_empty());
    assert!(comparison_table(&comparison).contains("no regression in 45 groups"));
}

#[test]
fn times_are_worse_beyond_both_noise_and_tolerance() {
    let slower = after(|run| times(&mut run.render_ms, 1.3));
    assert_eq!(row(&slower).time.change, TimeChange::Slower);
    assert!(row(&slower).time.is_regression && slower.is_regression());
    let in_noise = after(|run| times(&mut run.render_ms, 1.08));
    assert_eq!(row(&in_noise).time.change, TimeChange::WithinNoise);
    assert!(!in_noise.is_regression());
    let faster = after(|run| times(&mut run.render_ms, 0.7));
    assert_eq!(row(&faster).time.change, TimeChange::Faster);
    assert!(!faster.is_regression());
}

#[test]
fn quiet_times_may_be_slower_within_the_tolerance() {
    let (mut old, mut new) = (results(), results());
    for (results, factor) in [(&mut old, 1.0), (&mut new, 1.04)] {
        for run in &mut results.runs {
            let median = run.render_ms.median * factor;
            run.render_ms = Spread { median, q1: median * 0.999, q3: median * 1.001 };
        }
    }
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!(row(&comparison).time.change, TimeChange::Slower);
    assert!(!comparison.is_regression());
    assert!(compare(&old, &new, 0.03).unwrap().is_regression());
}

#[test]
fn one_slow_view_is_weighed_with_the_others() {
    let comparison = after(|run| {
        if run.view == "front" {
            times(&mut run.render_ms, 1.3);
        }
    });
    assert_eq!(row(&comparison).time.change, TimeChange::WithinNoise);
}

#[test]
fn counts_and_memory_are_worse_when_they_grow_beyond_the_tolerance() {
    let grown = |factor: f64| {
        let scaled = move |count: u64| (count as f64 * factor) as u64;
        [
            after(|run| run.samples = run.samples.map(scaled)),
            after(|run| run.peak_anon_bytes = run.peak_anon_bytes.map(scaled)),
            after(|run| {
                let bricks = run.bricks.as_mut().unwrap();
                bricks.rendered = (bricks.rendered as f64 * factor).round() as usize;
            }),
        ]
    };
    assert!(grown(1.2).iter().all(Comparison::is_regression));
    assert!(!grown(1.02).iter().any(Comparison::is_regression));
    assert!(!grown(0.5).iter().any(Comparison::is_regression));
}

#[test]
fn pictures_are_worse_beyond_the_tolerance_and_beyond_rounding() {
    let off = |largest: f64| after(|run| run.difference.as_mut().unwrap().largest = largest).is_regression();
    assert!(!off(3.9e-4));
    assert!(off(4.2e-4));
    assert!(!off(1e-5));
}

#[test]
fn an_executor_that_no_longer_runs_is_a_regression_with_its_reason() {
    let (old, mut new) = (results(), results());
    new.runs.retain(|run| run.executor != "raycast");
    let raycast = new.executors.iter_mut().find(|executor| executor.name == "raycast").unwrap();
    (raycast.ran, raycast.reasons) = (false, vec!["no adapter".to_owned()]);
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!(comparison.no_longer_run.len(), 9);
    assert!(comparison.is_regression());
    assert!(comparison_table(&comparison).contains("raycast no longer runs: no adapter"));
}

#[test]
fn an_executor_that_was_not_asked_for_is_told_and_not_judged() {
    let (old, mut new) = (results(), results());
    new.runs.retain(|run| run.executor != "raycast");
    (new.executors[3].ran, new.executors[3].reasons) = (false, vec![NOT_ASKED_FOR.to_owned()]);
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!((comparison.only_in_one.len(), comparison.is_regression()), (9, false));
}

#[test]
fn a_group_that_died_is_a_regression_though_its_executor_ran_on_others() {
    let (old, mut new) = (results(), results());
    new.runs.retain(|run| run.executor != "raycast" || run.data_set != "head");
    new.executors[3].reasons = vec!["head: the driver died".to_owned()];
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!(comparison.no_longer_run.len(), 3);
}

#[test]
fn a_data_set_that_was_left_out_is_no_regression_whatever_happened_to_others() {
    let (old, mut new) = (results(), results());
    new.runs.retain(|run| run.data_set != "head");
    new.data_sets.retain(|data_set| data_set.name != "head");
    new.executors[3].reasons = vec!["foam: one view took too long".to_owned()];
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!((comparison.only_in_one.len(), comparison.is_regression()), (15, false));
}

#[test]
fn what_only_one_has_is_told_and_not_judged() {
    let (old, mut new) = (results(), results());
    new.runs.retain(|run| run.data_set != "head");
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!((comparison.only_in_one.len(), comparison.is_regression()), (15, false));
    let comparison = compare(&new, &old, TOLERANCE).unwrap();
    assert_eq!((comparison.only_in_one.len(), comparison.is_regression()), (15, false));
    assert!(comparison_table(&comparison).contains("not compared: head, bone, hw: only in the new results"));
}

#[test]
fn only_views_that_both_have_count() {
    let (old, mut new) = (results(), results());
    new.runs.retain(|run| run.view == "front");
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!(row(&comparison).views, 1);
    assert_eq!(row(&comparison).time.old_ms, row(&comparison).time.new_ms);
}

#[test]
fn times_of_other_machines_are_shown_and_not_judged() {
    let (old, mut new) = (results(), results());
    new.provenance.machine.processor = "Another CPU".to_owned();
    new.runs.iter_mut().for_each(|run| times(&mut run.render_ms, 2.0));
    let comparison = compare(&old, &new, TOLERANCE).unwrap();
    assert_eq!(row(&comparison).time.change, TimeChange::Slower);
    assert!(!comparison.is_regression());
    assert!(comparison.warnings[0].contains("Another CPU"));
    new.runs.iter_mut().for_each(|run| run.samples = run.samples.map(|samples| samples * 2));
    assert!(compare(&old, &new, TOLERANCE).unwrap().is_regression());
}

#[test]
fn other_pictures_are_not_compared() {
    let old = results();
    let changes: [fn(&mut BenchResults); 5] = [
        |results| results.settings.size = [256, 256],
        |results| results.settings.step = 0.5,
        |results| results.settings.mode = "mip".into(),
        |results| results.settings.shading = "phong".into(),
        |results| results.settings.opacity_cutoff = 1.0,
    ];
    for change in changes {
        let mut new = results();
        change(&mut new);
        let error = compare(&old, &new, TOLERANCE).unwrap_err();
        assert_eq!(error.to_string().lines().count(), 1);
    }
    assert!(compare(&old, &old, f64::NAN).is_err());
}
