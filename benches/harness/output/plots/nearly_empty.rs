//! What is saved, and what is lost, without nearly empty bricks.

use super::Plot;
use super::lines::Line;
use super::sheet::{Words, label};
use super::sweep::{Sample, by_category, sweep};
use crate::{BenchResults, DataSetRecord, NearlyEmptyPoint};

/// One of α and β, with the other one left where it drops nothing.
struct Axis {
    name: &'static str,
    letter: &'static str,
    x_label: &'static str,
    /// How far the point is along this axis; nothing for points that are not on it.
    place: fn(&NearlyEmptyPoint) -> Option<f64>,
}

const AXES: [Axis; 2] = [
    Axis {
        name: "alpha",
        letter: "α",
        x_label: "α (β = 1)",
        place: |point| (point.beta == 1.0).then_some(point.alpha),
    },
    Axis {
        name: "beta",
        letter: "β",
        x_label: "1 − β (α = 0)",
        place: |point| (point.alpha == 0.0).then_some(1.0 - point.beta),
    },
];

pub fn plots(results: &BenchResults, data_set: &DataSetRecord) -> Vec<Plot> {
    let points: Vec<&NearlyEmptyPoint> =
        results.nearly_empty.iter().filter(|point| point.data_set == data_set.name).collect();
    let mut plots = Vec::new();
    for axis in &AXES {
        let words = |what: &str, title: &str, caption: &str| Words {
            name: format!("{}-{what}-{}", axis.name, data_set.name),
            title: format!("{title} by {}: {}", axis.letter, label(&data_set.name, 30)),
            caption: format!(
                "{caption} Steps of the axis are the values that were tried; the first drops nothing."
            ),
        };
        let rendered = words(
            "rendered",
            "Bricks rendered",
            "Percent of all bricks whose samples were evaluated, without nearly empty bricks.",
        );
        plots.extend(plot(
            results,
            data_set,
            &points,
            axis,
            rendered,
            "rendered, % of all bricks",
            |point| 100.0 * point.fractions.rendered,
        ));
        let error = words(
            "error",
            "Picture error",
            "Largest difference of a pixel (but for 0.01 % of them) from the exact picture, in linear light.",
        );
        plots.extend(plot(results, data_set, &points, axis, error, "largest difference", |point| {
            point.difference.largest
        }));
    }
    plots
}

fn plot(
    results: &BenchResults,
    data_set: &DataSetRecord,
    points: &[&NearlyEmptyPoint],
    axis: &Axis,
    words: Words,
    y_label: &str,
    value: fn(&NearlyEmptyPoint) -> f64,
) -> Option<Plot> {
    let on_axis: Vec<(String, f64, &NearlyEmptyPoint)> = points
        .iter()
        .filter_map(|point| (axis.place)(point).map(|place| (shown(place), place, *point)))
        .collect();
    let mut places: Vec<(&String, f64)> = on_axis.iter().map(|(shown, place, _)| (shown, *place)).collect();
    places.sort_by(|a, b| a.1.total_cmp(&b.1));
    places.dedup_by(|a, b| a.0 == b.0);
    if places.len() < 2 {
        return None;
    }
    let samples = on_axis.iter().filter_map(|(shown, _, point)| {
        let category = places.iter().position(|(other, _)| *other == shown)?;
        Some(Sample { tf: &point.tf, executor: &point.executor, category, value: value(point) })
    });
    let lines: Vec<Line> = by_category(samples, data_set);
    let categories = places.iter().map(|(shown, _)| (*shown).clone()).collect();
    Some(sweep(results, words, &lines, categories, [axis.x_label, y_label]))
}

/// Without the noise of 1 − β.
fn shown(place: f64) -> String {
    let text = format!("{place:.6}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
