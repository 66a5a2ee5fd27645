//! The pictures: executors beside each other from one view, then the other views.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};

use super::PagePicture;
use crate::BenchResults;
use crate::output::table::printable;

pub fn section(results: &BenchResults, pictures: &[PagePicture]) -> Markup {
    let first = first_view(results, pictures);
    let (of_first, others): (Vec<&PagePicture>, Vec<&PagePicture>) =
        pictures.iter().partition(|picture| picture.view == first);
    html! {
        section #pictures {
            h2 { "Pictures" }
            h3 { "View: " (printable(first)) }
            (by_executor(results, &of_first))
            @if !others.is_empty() {
                h3 { "Other views" }
                @for (data_set, tf) in pairs(&others) {
                    h4 { (printable(data_set)) ", " (printable(tf)) }
                    div .strip {
                        @for picture in others.iter().filter(|picture| (picture.data_set.as_str(), picture.tf.as_str()) == (data_set, tf)) {
                            figure { (image(picture)) figcaption { (printable(&picture.view)) ", " (printable(&picture.executor)) } }
                        }
                    }
                }
            }
        }
    }
}

/// The first view that was drawn and has a picture.
fn first_view<'a>(results: &BenchResults, pictures: &'a [PagePicture]) -> &'a str {
    let place = |view: &str| results.runs.iter().position(|run| run.view == view).unwrap_or(usize::MAX);
    pictures.iter().map(|picture| picture.view.as_str()).min_by_key(|view| place(view)).unwrap_or("")
}

/// Rows are data sets and transfer functions, columns are executors.
fn by_executor(results: &BenchResults, pictures: &[&PagePicture]) -> Markup {
    let has_picture = |executor: &str| pictures.iter().any(|picture| picture.executor == executor);
    let executors: Vec<&str> = results
        .executors
        .iter()
        .map(|executor| executor.name.as_str())
        .filter(|executor| has_picture(executor))
        .collect();
    html! {
        div .wide tabindex="0" role="region" aria-label="Pictures by executor" {
            table .pictures {
                thead {
                    tr {
                        th scope="col" { "data set, TF" }
                        @for executor in &executors { th scope="col" { (printable(executor)) } }
                    }
                }
                tbody {
                    @for (data_set, tf) in pairs(pictures) {
                        tr {
                            th scope="row" { (printable(data_set)) br; span .muted { (printable(tf)) } }
                            @for executor in &executors { td { (cell(pictures, data_set, tf, executor)) } }
                        }
                    }
                }
            }
        }
    }
}

fn cell(pictures: &[&PagePicture], data_set: &str, tf: &str, executor: &str) -> Markup {
    let found = pictures.iter().find(|picture| {
        (picture.data_set.as_str(), picture.tf.as_str(), picture.executor.as_str())
            == (data_set, tf, executor)
    });
    html! { @match found { Some(picture) => (image(picture)), None => span .nothing { "no picture" } } }
}

/// Data sets and transfer functions, each once, in order.
fn pairs<'a>(pictures: &[&'a PagePicture]) -> Vec<(&'a str, &'a str)> {
    let mut pairs = Vec::new();
    for picture in pictures {
        let pair = (picture.data_set.as_str(), picture.tf.as_str());
        if !pairs.contains(&pair) {
            pairs.push(pair);
        }
    }
    pairs
}

fn image(picture: &PagePicture) -> Markup {
    let what =
        format!("{}, {}, from {}, by {}", picture.data_set, picture.tf, picture.view, picture.executor);
    let source = format!("data:image/png;base64,{}", STANDARD.encode(&picture.png));
    html! { img src=(source) alt=(printable(&what)) title=(printable(&what)); }
}
