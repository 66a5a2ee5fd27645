//! The fraction of bricks that were rendered, by view, as figure 2b of Xie, Yang and Zhu (2007) has it.

use super::Plot;
use super::lines::{Line, lines};
use super::sheet::{Words, label, plot as both, sheet};
use crate::output::groups::{Group, groups};
use crate::{BenchResults, DataSetRecord};

const SIZE: [f64; 2] = [680.0, 380.0];
const EXECUTORS: [&str; 3] = ["slices", "raycast", "cpu"];

pub fn plot(results: &BenchResults, data_set: &DataSetRecord) -> Option<Plot> {
    let groups: Vec<Group<'_>> = groups(results)
        .into_iter()
        .filter(|group| group.data_set == data_set.name && EXECUTORS.contains(&group.executor))
        .collect();
    let mut views: Vec<&str> = Vec::new();
    for run in groups.iter().flat_map(|group| &group.runs) {
        if run.fractions.is_some() && !views.contains(&run.view.as_str()) {
            views.push(&run.view);
        }
    }
    if views.is_empty() {
        return None;
    }
    let drawn: Vec<Line> = groups.iter().map(|group| line(group, data_set, &views)).collect();
    let categories: Vec<String> = views.iter().map(|view| label(view, 20)).collect();
    let words = Words {
        name: format!("fractions-{}", data_set.name),
        title: format!("Bricks rendered by view: {}", label(&data_set.name, 30)),
        caption: "Percent of all bricks whose samples were evaluated, for each view; lines of one colour lie on each \
                  other where executors need the same bricks."
            .to_owned(),
    };
    Some(both(results, words, |words, shade| {
        let layout = sheet(words, SIZE, &categories, "rendered, % of all bricks", shade).with_x_label("view");
        let (marks, layout) = lines(&drawn, layout, shade);
        (marks, layout, Vec::new())
    }))
}

fn line(group: &Group<'_>, data_set: &DataSetRecord, views: &[&str]) -> Line {
    let points = group.runs.iter().filter_map(|run| {
        let view = views.iter().position(|view| *view == run.view)?;
        Some((view, 100.0 * run.fractions?.rendered))
    });
    let mut points: Vec<(usize, f64)> = points.collect();
    points.sort_by_key(|(view, _)| *view);
    Line {
        tf: group.tf.to_owned(),
        tf_place: data_set.transfer_functions.iter().position(|tf| tf == group.tf).unwrap_or(0),
        executor: group.executor.to_owned(),
        points,
    }
}
