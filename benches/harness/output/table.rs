//! The table on the terminal; the page shows the same one.

use std::fmt::Write;

use comfy_table::Table;
use comfy_table::presets::UTF8_FULL_CONDENSED;

use super::figures::{NOTHING, aligned, count, megabytes, or_nothing, percent, shortened, significant};
use super::groups::{Group, groups};
use crate::BenchResults;

/// How many of the columns are words.
pub const WORDS: usize = 3;
pub const HEADER: [&str; 16] = [
    "data set",
    "TF",
    "executor",
    "fps",
    "lowest–highest",
    "% non-empty",
    "% in frustum",
    "% not occluded",
    "% rendered",
    "misses",
    "MB read",
    "MB uploaded",
    "M samples",
    "peak MB",
    "off SW",
    "complete",
];

/// One row for each data set, transfer function and executor, and where the figures come from.
pub fn table(results: &BenchResults) -> String {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(HEADER.map(in_lines));
    for group in groups(results) {
        let mut row = summary_row(&group);
        row[0] = shortened(&row[0], 28);
        row[1] = shortened(&row[1], 20);
        table.add_row(aligned(row.map(|cell| printable(&cell)).to_vec(), WORDS));
    }
    let mut text = table.to_string();
    text.push('\n');
    for line in footer(results) {
        let _ = writeln!(text, "{}", printable(&line));
    }
    text
}

/// A column's name, narrow: a word a line.
fn in_lines(name: &str) -> String {
    name.replace([' ', '–'], "\n")
}

/// A group's figures, in the order of HEADER.
pub fn summary_row(group: &Group<'_>) -> [String; HEADER.len()] {
    let summary = group.summary();
    let stage = |of: fn(&crate::BrickFractions) -> f64| {
        or_nothing(summary.fractions, |fractions| percent(of(&fractions)))
    };
    [
        group.data_set.to_owned(),
        group.tf.to_owned(),
        group.executor.to_owned(),
        significant(summary.fps),
        format!("{}–{}", significant(summary.fps_lowest), significant(summary.fps_highest)),
        stage(|fractions| fractions.non_empty),
        stage(|fractions| fractions.in_frustum),
        stage(|fractions| fractions.not_occluded),
        stage(|fractions| fractions.rendered),
        or_nothing(summary.misses, count),
        or_nothing(summary.bytes_read, megabytes),
        or_nothing(summary.bytes_uploaded, megabytes),
        or_nothing(summary.samples, |samples| format!("{:.2}", samples as f64 / 1e6)),
        or_nothing(summary.peak_anon_bytes, megabytes),
        or_nothing(summary.difference, |largest| format!("{largest:.1e}")),
        if summary.complete { "yes" } else { "no" }.to_owned(),
    ]
}

/// What the columns mean, what did not run, and what ran on which machine.
fn footer(results: &BenchResults) -> Vec<String> {
    let provenance = &results.provenance;
    let mut lines = vec![
        "fps: median over views; stages: mean over views; misses, read, uploaded, samples: sums over views"
            .to_owned(),
    ];
    for executor in &results.executors {
        let verb = if executor.ran { "did not run on everything" } else { "did not run" };
        if !executor.ran && executor.reasons.is_empty() {
            lines.push(format!("{} {verb}", executor.name));
        }
        lines.extend(executor.reasons.iter().map(|reason| format!("{} {verb}: {reason}", executor.name)));
    }
    lines.push(format!("machine   {}", provenance.machine_in_words()));
    lines.push(format!("adapter   {}", provenance.adapter_in_words()));
    lines
        .push(format!("version   {}, commit {}, {}", provenance.version, provenance.commit, provenance.date));
    lines.push(format!("command   {}", provenance.command));
    lines
}

/// Names come from files: nothing in them may steer a terminal.
pub fn printable(text: &str) -> String {
    text.chars().map(|character| if character.is_control() { '\u{fffd}' } else { character }).collect()
}

/// Whether a cell tells nothing.
pub fn is_nothing(cell: &str) -> bool {
    cell == NOTHING
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::results;

    #[test]
    fn every_group_has_a_row_and_the_machine_stands_below() {
        let results = results();
        let text = table(&results);
        assert_eq!(text.lines().filter(|line| line.contains("┆ slices ")).count(), 9);
        for part in [&results.provenance.commit, &results.provenance.command, "Example CPU", "example driver"]
        {
            assert!(text.contains(part), "{part} is missing");
        }
    }

    #[test]
    fn an_executor_that_did_not_run_is_told_with_its_reason() {
        let mut results = results();
        results.executors[3].ran = false;
        results.executors[3].reasons = vec!["no adapter.".to_owned()];
        assert!(table(&results).contains("raycast did not run: no adapter."));
    }

    #[test]
    fn names_cannot_steer_the_terminal() {
        let mut results = results();
        for run in &mut results.runs {
            run.tf = "\u{1b}[2Jbone\n".to_owned();
        }
        assert!(!table(&results).contains('\u{1b}'));
    }
}
