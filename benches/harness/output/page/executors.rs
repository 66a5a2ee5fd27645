//! Who drew, and who could not.

use maud::{Markup, html};

use crate::output::table::printable;
use crate::{BenchResults, ExecutorRecord};

pub fn section(results: &BenchResults) -> Markup {
    html! {
        section #executors {
            h2 { "Executors" }
            div .wide tabindex="0" role="region" aria-label="Executors" {
                table .words-table {
                    thead { tr { th scope="col" { "executor" } th scope="col" { "what it is" } th scope="col" { "ran" } } }
                    tbody { @for executor in &results.executors { (row(executor)) } }
                }
            }
        }
    }
}

fn row(executor: &ExecutorRecord) -> Markup {
    let (class, word) = match (executor.ran, executor.reasons.is_empty()) {
        (true, true) => ("good", "yes"),
        (true, false) => ("fair", "not on everything"),
        (false, _) => ("bad", "no"),
    };
    html! {
        tr {
            th scope="row" { (printable(&executor.name)) }
            td { (printable(&executor.summary)) }
            td {
                span .mark .(class) { (word) }
                @for reason in &executor.reasons { div .reason { (printable(reason)) } }
            }
        }
    }
}
