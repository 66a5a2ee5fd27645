//! Plots as SVG, for light and for dark pages.

mod bars;
mod budgets;
mod colours;
mod fps;
mod fractions;
mod lines;
mod nearly_empty;
mod sheet;
mod stages;
mod sweep;

use std::collections::HashSet;

use crate::BenchResults;

/// A picture of some of the results.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Plot {
    /// A file's name without its ending, in plain characters; no two plots share one.
    pub name: String,
    pub title: String,
    /// One sentence on how to read it.
    pub caption: String,
    /// An SVG of its own for light pages.
    pub light: String,
    /// The same for dark pages.
    pub dark: String,
}

/// Every plot that there are results for.
pub fn plots(results: &BenchResults) -> Vec<Plot> {
    let mut plots: Vec<Plot> = fps::plot(results).into_iter().collect();
    plots.extend(results.data_sets.iter().filter_map(|data_set| fractions::plot(results, data_set)));
    plots.extend(results.data_sets.iter().filter_map(|data_set| stages::plot(results, data_set)));
    plots.extend(results.data_sets.iter().flat_map(|data_set| budgets::plots(results, data_set)));
    plots.extend(results.data_sets.iter().flat_map(|data_set| nearly_empty::plots(results, data_set)));
    give_each_its_name(&mut plots);
    plots
}

/// Data sets whose names differ in strange characters alone have the same plain name.
fn give_each_its_name(plots: &mut [Plot]) {
    let mut taken = HashSet::new();
    for plot in plots {
        let plain = plain_name(&plot.name);
        let mut name = plain.clone();
        let mut number = 2;
        while !taken.insert(name.to_lowercase()) {
            name = format!("{plain}-{number}");
            number += 1;
        }
        plot.name = name;
    }
}

/// A name that every file system takes.
fn plain_name(name: &str) -> String {
    let plain = |character: char| {
        if character.is_ascii_alphanumeric() || "._-".contains(character) { character } else { '-' }
    };
    name.chars().take(80).map(plain).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::results;

    #[test]
    fn every_kind_of_plot_is_drawn_of_whole_results_and_none_of_empty_ones() {
        let mut results = results();
        let names: Vec<String> = plots(&results).into_iter().map(|plot| plot.name).collect();
        for name in [
            "fps",
            "fractions-head",
            "stages-foam",
            "budget-gpu-time-head",
            "budget-cpu-misses-head",
            "alpha-rendered-foam",
            "beta-error-body-512x304x1730",
        ] {
            assert!(names.iter().any(|other| other == name), "{name} is missing from {names:?}");
        }
        assert_eq!(names.len(), 1 + 3 * (1 + 1 + 4 + 4));
        results.budgets.clear();
        assert!(plots(&results).iter().all(|plot| !plot.name.starts_with("budget")));
        results.runs.clear();
        results.nearly_empty.clear();
        assert_eq!(plots(&results), []);
    }

    #[test]
    fn names_of_files_are_plain_and_differ() {
        let mut results = results();
        let evil = ["../a b", "../a/b", "..-A-B"];
        for (index, name) in evil.iter().enumerate() {
            let old = std::mem::replace(&mut results.data_sets[index].name, (*name).to_owned());
            for run in results.runs.iter_mut().filter(|run| run.data_set == old) {
                run.data_set = (*name).to_owned();
            }
        }
        let plots = plots(&results);
        let names: HashSet<String> = plots.iter().map(|plot| plot.name.to_lowercase()).collect();
        assert_eq!(names.len(), plots.len());
        assert!(
            names.iter().all(|name| !name.contains('/') && !name.contains(' ') && !name.starts_with('.'))
        );
    }

    #[test]
    fn names_of_data_sets_and_transfer_functions_are_text_and_nothing_else() {
        let mut results = results();
        let evil = "</title><script>$x^2$\u{1}</script>\"'&";
        for run in &mut results.runs {
            run.tf = evil.to_owned();
        }
        results.data_sets[0].transfer_functions = vec![evil.to_owned()];
        for plot in plots(&results) {
            for svg in [&plot.light, &plot.dark] {
                assert!(!svg.contains("<script"), "{}", plot.name);
                assert!(!svg.contains('\u{1}'), "{}", plot.name);
                assert!(!svg.contains('²'), "{}", plot.name);
            }
        }
    }

    #[test]
    fn files_say_where_their_figures_come_from() {
        let results = results();
        for plot in plots(&results) {
            for part in ["0123456789ab", "Example CPU", "example driver", "2026-11-22", "glassbrick bench"] {
                assert!(plot.light.contains(part) && plot.dark.contains(part), "{}: {part}", plot.name);
            }
        }
    }

    #[test]
    fn odd_results_are_drawn_too() {
        let mut results = results();
        let first = results.runs[0].clone();
        results
            .runs
            .retain(|run| (&run.data_set, &run.tf, &run.view) == (&first.data_set, &first.tf, &first.view));
        for (run, odd) in results.runs.iter_mut().zip([0.0, f64::NAN, f64::INFINITY, -1.0, 1e300]) {
            run.fps.median = odd;
        }
        results.data_sets.truncate(1);
        results.data_sets[0].transfer_functions.clear();
        for point in &mut results.budgets {
            (point.render_ms.median, point.budget_bytes) = (f64::NAN, 0);
        }
        for point in &mut results.nearly_empty {
            point.difference.largest = f64::INFINITY;
        }
        results.provenance.commit = "ä".repeat(40);
        results.provenance.command = "x".repeat(5000);
        for plot in plots(&results) {
            assert!(!plot.light.contains("NaN") && !plot.light.contains("inf\""), "{}", plot.name);
        }
    }
}
