//! Plots of something over the values of a setting that were tried.

use super::Plot;
use super::lines::{Line, lines as drawn};
use super::sheet::{Words, plot as both, sheet};
use crate::{BenchResults, DataSetRecord};

const SIZE: [f64; 2] = [680.0, 350.0];

/// One measurement.
pub struct Sample<'a> {
    pub tf: &'a str,
    pub executor: &'a str,
    pub category: usize,
    pub value: f64,
}

/// A line for each transfer function and executor, of means over views.
pub fn by_category<'a>(samples: impl Iterator<Item = Sample<'a>>, data_set: &DataSetRecord) -> Vec<Line> {
    let mut sums: Vec<(Line, Vec<usize>)> = Vec::new();
    for sample in samples {
        let known =
            sums.iter().position(|(line, _)| line.tf == sample.tf && line.executor == sample.executor);
        let index = known.unwrap_or(sums.len());
        if known.is_none() {
            let tf_place = data_set.transfer_functions.iter().position(|tf| tf == sample.tf).unwrap_or(0);
            let (tf, executor) = (sample.tf.to_owned(), sample.executor.to_owned());
            sums.push((Line { tf, tf_place, executor, points: Vec::new() }, Vec::new()));
        }
        let (line, counts) = &mut sums[index];
        match line.points.iter().position(|(category, _)| *category == sample.category) {
            Some(point) => {
                line.points[point].1 += sample.value;
                counts[point] += 1;
            }
            None => {
                line.points.push((sample.category, sample.value));
                counts.push(1);
            }
        }
    }
    let mean = |(mut line, counts): (Line, Vec<usize>)| {
        for (point, count) in line.points.iter_mut().zip(counts) {
            point.1 /= count as f64;
        }
        line.points.sort_by_key(|(category, _)| *category);
        line
    };
    sums.into_iter().map(mean).collect()
}

pub fn sweep(
    results: &BenchResults,
    words: Words,
    lines: &[Line],
    categories: Vec<String>,
    labels: [&str; 2],
) -> Plot {
    both(results, words, |words, shade| {
        let layout = sheet(words, SIZE, &categories, labels[1], shade).with_x_label(labels[0]);
        let (marks, layout) = drawn(lines, layout, shade);
        (marks, layout, Vec::new())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::results;

    #[test]
    fn views_of_one_step_are_averaged_and_steps_stand_in_order() {
        let sample = |category, value| Sample { tf: "skin", executor: "cpu", category, value };
        let lines = by_category(
            [sample(1, 4.0), sample(0, 1.0), sample(1, 6.0)].into_iter(),
            &results().data_sets[0],
        );
        assert_eq!(lines.len(), 1);
        assert_eq!((lines[0].tf_place, &lines[0].points[..]), (1, &[(0, 1.0), (1, 5.0)][..]));
    }
}
