//! The terminal's table, and every run.

use maud::{Markup, html};

use crate::output::csv::{Column, RUN_COLUMNS};
use crate::output::figures::{count, significant};
use crate::output::groups::{Group, groups};
use crate::output::table::{HEADER, WORDS, is_nothing, printable, summary_row};
use crate::{BenchResults, Run};

/// Columns that only machines read.
const LEFT_OUT: [&str; 2] = ["render_ms_all", "picture"];
/// How many of a run's columns are words.
const RUN_WORDS: usize = 4;

pub fn summary(results: &BenchResults) -> Markup {
    let groups = groups(results);
    html! {
        section #summary {
            h2 { "Summary" }
            p {
                "One row for each data set, transfer function (TF) and executor. Frames per second are the median over views, with "
                "the slowest and the fastest view; stages are means over views, in percent of all bricks; misses, what was "
                "read and uploaded, and samples are sums over views; "
                em { "off SW" } " is the largest difference from SW's picture, but for 0.01 % of the pixels."
            }
            div .wide tabindex="0" role="region" aria-label="Summary" {
                table .summary {
                    thead { tr { @for name in HEADER { th scope="col" { (name) } } } }
                    @for rows in groups.chunk_by(|a, b| (a.data_set, a.tf) == (b.data_set, b.tf)) {
                        tbody { @for group in rows { (summary_cells(group)) } }
                    }
                }
            }
        }
    }
}

fn summary_cells(group: &Group<'_>) -> Markup {
    html! {
        tr {
            @for (index, cell) in summary_row(group).iter().enumerate() {
                @if index < WORDS {
                    th scope="row" { (printable(cell)) }
                } @else if is_nothing(cell) {
                    td .nothing { (cell) }
                } @else {
                    td { (cell) }
                }
            }
        }
    }
}

pub fn runs(results: &BenchResults) -> Markup {
    let columns: Vec<&Column> = RUN_COLUMNS.iter().filter(|(name, _)| !LEFT_OUT.contains(name)).collect();
    html! {
        section #runs {
            h2 { "All runs" }
            p { "The same rows, with all digits, are in the CSV file; everything is in the JSON file." }
            details {
                summary { (count(results.runs.len() as u64)) " runs" }
                div .wide tabindex="0" role="region" aria-label="All runs" {
                    table .runs {
                        thead { tr { @for (name, _) in &columns { th scope="col" { (name.replace('_', " ")) } } } }
                        tbody { @for run in &results.runs { (run_cells(run, &columns)) } }
                    }
                }
            }
        }
    }
}

fn run_cells(run: &Run, columns: &[&Column]) -> Markup {
    html! {
        tr {
            @for (index, (_, cell)) in columns.iter().enumerate() {
                @if index < RUN_WORDS { th scope="row" { (printable(&cell(run))) } } @else { td { (readable(cell(run))) } }
            }
        }
    }
}

/// With commas if whole, with three digits if not.
fn readable(cell: String) -> String {
    if let Ok(whole) = cell.parse() {
        count(whole)
    } else if let Ok(number) = cell.parse() {
        significant(number)
    } else {
        cell
    }
}
