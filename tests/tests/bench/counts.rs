//! Counts are those of the picture, not of the run: the small phantoms' are written down.

use std::fmt::Write;

use glassbrick_tests::gpu::gpu;
use glassbrick_tests::skipped::skipped;
use serde_json::Value;

use super::results::{bench, list};

/// Of each executor, data set, transfer function and view: bricks total, not empty, in the frustum, not occluded, rendered.
const OF_THE_CPU: &str = include_str!("counts_cpu.tsv");
const OF_A_GPU: &str = include_str!("counts_gpu.tsv");

const STAGES: [&str; 5] = ["total", "non_empty", "in_frustum", "not_occluded", "rendered"];

fn counts(results: &Value) -> String {
    let mut lines = String::new();
    for run in list(results, "runs") {
        let text = |field: &str| run[field].as_str().expect("a text").to_owned();
        let name = [text("executor"), text("data_set"), text("tf"), text("view")].join("\t");
        let stages = STAGES.map(|stage| run["bricks"][stage].to_string()).join("\t");
        writeln!(lines, "{name}\t{stages}").expect("a text grows");
    }
    lines
}

/// Everything but times and memory, of all runs.
fn without_times(results: &Value) -> Vec<Value> {
    let fields =
        ["executor", "data_set", "tf", "view", "bricks", "fractions", "residency", "samples", "difference"];
    let kept = |run: &Value| fields.iter().map(|field| run[*field].clone()).collect::<Value>();
    let mut kept: Vec<Value> = list(results, "runs").iter().map(kept).collect();
    let point = |point: &Value| {
        let fields =
            ["executor", "tf", "budget_bytes", "first", "again", "alpha", "beta", "bricks", "difference"];
        fields.iter().map(|field| point[*field].clone()).collect::<Value>()
    };
    kept.extend(list(results, "budgets").iter().chain(list(results, "nearly_empty")).map(point));
    kept
}

/// Holds one benchmark to be another's equal in all but times and memory.
fn assert_same(results: &Value, again: &Value) {
    let (first, second) = (without_times(results), without_times(again));
    assert_eq!(first.len(), second.len());
    for (first, second) in first.iter().zip(&second) {
        assert!(first == second, "{first}\n{second}");
    }
}

/// Holds what was counted to what is written down.
fn assert_counts(results: &Value, written: &str) {
    let found = counts(results);
    let differ = found.lines().zip(written.lines()).find(|(found, written)| found != written);
    assert!(
        found == written,
        "first difference, found and written: {differ:?}; all that was found:\n{found}"
    );
}

#[test]
fn the_cpus_counts_are_those_written_down() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (results, _) = bench(&[], "--quick --executors cpu", folder.path());
    assert_counts(&results, OF_THE_CPU);
    let again = tempfile::tempdir().expect("a scratch folder");
    let (results_again, _) = bench(&[], "--quick --executors cpu", again.path());
    assert_same(&results, &results_again);
}

#[test]
fn a_gpus_counts_are_those_written_down() {
    let Some(gpu) = gpu() else { return };
    let folder = tempfile::tempdir().expect("a scratch folder");
    let flags = "--phantom 128x76x432 --tf ct-skin --executors hw,slices,raycast";
    let (results, _) = bench(&[], flags, folder.path());
    let again = tempfile::tempdir().expect("a scratch folder");
    let (results_again, _) = bench(&[], flags, again.path());
    assert_same(&results, &results_again);
    if gpu.is_software() {
        assert_counts(&results, OF_A_GPU);
    } else {
        skipped("counts of a GPU are written down for the driver that computes on the CPU");
    }
}
