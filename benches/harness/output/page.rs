//! The page: all results in one file that needs no network and runs no script.

mod executors;
mod pictures;
mod provenance;
mod tables;
mod words;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::Plot;
use crate::BenchResults;

const CSS: &str = include_str!("page.css");

/// A picture of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PagePicture {
    pub data_set: String,
    pub tf: String,
    pub executor: String,
    pub view: String,
    pub png: Vec<u8>,
}

/// The page as HTML. Names may hold anything: they are text in it, and nothing else.
pub fn page(results: &BenchResults, plots: &[Plot], pictures: &[PagePicture]) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; style-src 'unsafe-inline'; img-src data:";
                link rel="icon" href="data:,";
                title { "glassbrick benchmark, " (results.provenance.date) }
                style { (PreEscaped(CSS)) }
            }
            body {
                (header(results, !plots.is_empty(), !pictures.is_empty()))
                main {
                    (words::section())
                    (provenance::section(results))
                    (executors::section(results))
                    (tables::summary(results))
                    @if !plots.is_empty() { (plot_section(plots)) }
                    @if !pictures.is_empty() { (pictures::section(results, pictures)) }
                    (tables::runs(results))
                }
            }
        }
    }
    .into_string()
}

fn header(results: &BenchResults, plots: bool, pictures: bool) -> Markup {
    let (sets, runs) = (results.data_sets.len(), results.runs.len());
    let transfer_functions: usize = results.data_sets.iter().map(|set| set.transfer_functions.len()).sum();
    let ran = results.executors.iter().filter(|executor| executor.ran).count();
    html! {
        header {
            h1 { "glassbrick benchmark" }
            p .lead {
                (plural(sets, "data set")) ", " (plural(transfer_functions, "pair"))
                " of data set and transfer function, " (plural(ran, "executor")) ", " (plural(runs, "run")) "."
            }
            nav aria-label="Sections" {
                a href="#about" { "What this is" }
                a href="#provenance" { "Machine" }
                a href="#executors" { "Executors" }
                a href="#summary" { "Summary" }
                @if plots { a href="#plots" { "Plots" } }
                @if pictures { a href="#pictures" { "Pictures" } }
                a href="#runs" { "All runs" }
            }
        }
    }
}

fn plural(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

fn plot_section(plots: &[Plot]) -> Markup {
    html! {
        section #plots {
            h2 { "Plots" }
            p { "Each plot is also a file beside this page. A pointer held on a bar or a point shows its value." }
            div .plots {
                @for plot in plots {
                    figure .plot .full[plot.name == "fps"] {
                        div .light { (PreEscaped(&plot.light)) }
                        div .dark { (PreEscaped(&plot.dark)) }
                        figcaption { (plot.caption) }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::plots;
    use crate::output::sample::{pictures, results};

    #[test]
    fn the_page_asks_nothing_of_a_network_and_runs_no_script() {
        let results = results();
        let html = page(&results, &plots(&results), &pictures(&results));
        let named = html.replace("http://www.w3.org/2000/svg", "");
        for word in ["http://", "https://", "<script", "@import", "url(//"] {
            assert!(!named.contains(word), "{word}");
        }
        assert_eq!(html.matches("data:image/png;base64,").count(), pictures(&results).len());
    }

    #[test]
    fn names_from_files_are_text_and_nothing_else() {
        let mut results = results();
        let evil = "<img src=x onerror=alert(1)>\"'&amp;";
        results.provenance.command = evil.to_owned();
        results.data_sets[0].source = evil.to_owned();
        results.executors[0].reasons = vec![evil.to_owned()];
        for run in &mut results.runs {
            run.view = evil.to_owned();
        }
        let mut pictures = pictures(&results);
        pictures[0].tf = evil.to_owned();
        let html = page(&results, &plots(&results), &pictures);
        assert!(!html.contains("<img src=x"));
        assert!(html.contains("&lt;img src=x onerror=alert(1)&gt;"));
    }

    #[test]
    fn the_page_tells_where_its_figures_come_from() {
        let results = results();
        let html = page(&results, &[], &[]);
        for part in
            ["Example CPU", "example driver", "0123456789abcdef", "2026-11-22T10:00:00Z", "glassbrick bench"]
        {
            assert!(html.contains(part), "{part} is missing");
        }
        assert!(!html.contains("id=\"plots\"") && !html.contains("id=\"pictures\""));
        assert!(!html.contains("href=\"#plots\"") && !html.contains("href=\"#pictures\""));
    }

    #[test]
    fn every_link_within_the_page_leads_somewhere() {
        let results = results();
        let html = page(&results, &plots(&results), &pictures(&results));
        for link in html.split("href=\"#").skip(1) {
            let name = link.split('"').next().unwrap();
            assert!(html.contains(&format!("id=\"{name}\"")), "{name}");
        }
    }
}
