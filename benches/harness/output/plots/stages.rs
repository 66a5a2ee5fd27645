//! How many bricks each stage of a frame leaves.

use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, TextAnchor};

use super::Plot;
use super::bars::{Category, bars, marks, place};
use super::colours::Shade;
use super::sheet::{Words, label, plot as both, sheet};
use crate::output::groups::groups;
use crate::{BenchResults, BrickFractions, DataSetRecord};

const SIZE: [f64; 2] = [680.0, 360.0];
/// Those that skip all they can, the one whose stages are shown first.
const EXECUTORS: [&str; 3] = ["slices", "raycast", "cpu"];
/// So many transfer functions leave room for figures over the bars.
const MOST_WITH_FIGURES: usize = 3;

/// Its name and its fraction.
type Stage = (&'static str, fn(&BrickFractions) -> f64);

pub fn plot(results: &BenchResults, data_set: &DataSetRecord) -> Option<Plot> {
    let groups = groups(results);
    let of = |executor: &str| -> Vec<(usize, &str, BrickFractions)> {
        groups
            .iter()
            .filter(|group| group.data_set == data_set.name && group.executor == executor)
            .filter_map(|group| {
                let place = data_set.transfer_functions.iter().position(|tf| tf == group.tf);
                Some((place.unwrap_or(0), group.tf, group.summary().fractions?))
            })
            .collect()
    };
    let (executor, tfs) =
        EXECUTORS.iter().map(|executor| (executor, of(executor))).find(|(_, tfs)| !tfs.is_empty())?;
    let stages: [Stage; 6] = [
        ("total", |_| 1.0),
        ("non-empty", |fractions| fractions.non_empty),
        ("after α, β", |fractions| fractions.filtered_visible),
        ("in frustum", |fractions| fractions.in_frustum),
        ("not occluded", |fractions| fractions.not_occluded),
        ("rendered", |fractions| fractions.rendered),
    ];
    let categories = stages.map(|(name, of)| Category {
        label: name.to_owned(),
        bars: tfs.iter().map(|(_, _, fractions)| Some(100.0 * of(fractions))).collect(),
    });
    let labels = stages.map(|(name, _)| name.to_owned());
    let words = Words {
        name: format!("stages-{}", data_set.name),
        title: format!("Bricks that each stage leaves: {}", label(&data_set.name, 30)),
        caption: format!(
            "Percent of all {} bricks that are left after each stage, from all of them to those whose samples were \
             evaluated; mean over views, executor {executor}.",
            crate::output::count(data_set.bricks as u64)
        ),
    };
    Some(both(results, words, |words, shade| {
        let series: Vec<_> =
            tfs.iter().map(|(place, tf, _)| (label(tf, 16), shade.transfer_function(*place))).collect();
        let mut layout =
            sheet(words, SIZE, &labels, "% of all bricks", shade).with_y_axis_min(0.0).with_y_axis_max(105.0);
        layout.y_range = (0.0, 100.0);
        layout.y_tick_step = Some(20.0);
        let (plot, layout) = bars(&categories, &series, " %", layout);
        let over = figures(&categories, &ComputedLayout::from_layout(&layout), shade);
        (marks(plot), layout, over)
    }))
}

/// Each bar's value over it.
fn figures(categories: &[Category], layout: &ComputedLayout, shade: Shade) -> Vec<Primitive> {
    let mut texts = Vec::new();
    for (index, category) in categories.iter().enumerate() {
        let count = category.bars.len();
        let shown = category.bars.iter().enumerate().filter(|_| count <= MOST_WITH_FIGURES);
        texts.extend(shown.filter_map(|(bar, value)| {
            let value = (*value)?;
            let [x, y] = place(layout, index, bar, count, value);
            Some(Primitive::Text {
                x,
                y: y - 4.0,
                content: if value < 9.95 { format!("{value:.1}") } else { format!("{value:.0}") },
                size: 10,
                anchor: TextAnchor::Middle,
                rotate: None,
                bold: false,
                color: Some(kuva::render::color::Color::from(shade.muted())),
            })
        }));
    }
    texts
}
