//! A comparison on the terminal.

use std::fmt::Write;

use comfy_table::Table;
use comfy_table::presets::UTF8_FULL_CONDENSED;

use super::{Compared, ComparedGroup, ComparedTime, Comparison, TimeChange};
use crate::output::{NOTHING, aligned, count, megabytes, or_nothing, printable, significant};

const HEADER: [&str; 10] = [
    "data set",
    "TF",
    "executor",
    "views",
    "ms",
    "× time",
    "rendered bricks",
    "M samples",
    "peak MB",
    "off SW",
];
const WORDS: usize = 3;
/// Stands behind what came out worse.
const WORSE: &str = " ✗";

/// Old and new figures of each group; what came out worse is marked; then warnings and the verdict.
pub fn comparison_table(comparison: &Comparison) -> String {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(HEADER);
    for row in &comparison.rows {
        table.add_row(aligned(cells(row).map(|cell| printable(&cell)).to_vec(), WORDS));
    }
    let mut text = if comparison.rows.is_empty() { String::new() } else { format!("{table}\n") };
    for line in lines(comparison) {
        let _ = writeln!(text, "{}", printable(&line));
    }
    text
}

fn cells(row: &ComparedGroup) -> [String; HEADER.len()] {
    let megasamples = |samples: f64| format!("{:.2}", samples / 1e6);
    [
        row.data_set.clone(),
        row.tf.clone(),
        row.executor.clone(),
        row.views.to_string(),
        format!("{} → {}", significant(row.time.old_ms), significant(row.time.new_ms)),
        ratio(&row.time),
        figure(row.rendered, |bricks| count(bricks as u64)),
        figure(row.samples, megasamples),
        figure(row.peak_anon, |bytes| megabytes(bytes as u64)),
        figure(row.difference, |largest| format!("{largest:.1e}")),
    ]
}

fn ratio(time: &ComparedTime) -> String {
    let ratio =
        if time.old_ms > 0.0 { format!("{:.2}", time.new_ms / time.old_ms) } else { NOTHING.to_owned() };
    let word = match time.change {
        TimeChange::Slower => " slower",
        TimeChange::WithinNoise => " noise",
        TimeChange::Faster => " faster",
    };
    format!("{ratio}{word}{}", if time.is_regression { WORSE } else { "" })
}

fn figure(compared: Option<Compared>, text: impl Fn(f64) -> String) -> String {
    or_nothing(compared, |compared| {
        let (old, new) = (text(compared.old), text(compared.new));
        let worse = if compared.is_regression { WORSE } else { "" };
        if old == new { format!("{new}{worse}") } else { format!("{old} → {new}{worse}") }
    })
}

fn lines(comparison: &Comparison) -> Vec<String> {
    let mut lines: Vec<String> =
        comparison.warnings.iter().map(|warning| format!("warning: {warning}")).collect();
    lines.extend(comparison.no_longer_run.iter().map(|gone| {
        format!("{}, {}: {} no longer runs: {}{WORSE}", gone.data_set, gone.tf, gone.executor, gone.reason)
    }));
    lines.extend(comparison.only_in_one.iter().map(|only| format!("not compared: {only}")));
    let worse =
        comparison.rows.iter().filter(|row| row.is_regression()).count() + comparison.no_longer_run.len();
    let all = comparison.rows.len() + comparison.no_longer_run.len();
    lines.push(match (all, worse) {
        (0, _) => "nothing is in both: nothing was compared".to_owned(),
        (_, 0) => format!(
            "no regression in {all} groups, at a tolerance of {} %",
            significant(comparison.tolerance * 100.0)
        ),
        _ => format!(
            "regression in {worse} of {all} groups, marked{WORSE}, at a tolerance of {} %",
            significant(comparison.tolerance * 100.0)
        ),
    });
    lines
}
