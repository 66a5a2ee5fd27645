//! Frames per second by executor, as figure 2a of Xie, Yang and Zhu (2007) has them.

use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::render::{Primitive, TextAnchor};

use super::Plot;
use super::bars::{Category, bars, marks};
use super::sheet::{Words, label, plot as both, sheet, tick};
use crate::BenchResults;
use crate::output::groups::{Group, groups};

const HEIGHT: f64 = 440.0;

/// Categories next to each other that are of one data set.
struct Span<'a> {
    data_set: &'a str,
    first: usize,
    last: usize,
}

pub fn plot(results: &BenchResults) -> Option<Plot> {
    let groups = groups(results);
    let rows = rows(&groups);
    let executors: Vec<(usize, &str)> = results
        .executors
        .iter()
        .map(|executor| executor.name.as_str())
        .enumerate()
        .filter(|(_, name)| groups.iter().any(|group| group.executor == *name))
        .collect();
    let all: Vec<f64> = groups.iter().filter_map(shown).collect();
    if all.is_empty() || executors.is_empty() {
        return None;
    }
    let categories: Vec<Category> = rows
        .iter()
        .map(|row| Category {
            label: label(row[0].tf, 18),
            bars: executors
                .iter()
                .map(|(_, name)| row.iter().find(|group| group.executor == *name).and_then(shown))
                .collect(),
        })
        .collect();
    let labels: Vec<String> = categories.iter().map(|category| category.label.clone()).collect();
    let width = (260.0 + 18.0 * (categories.len() * executors.len()) as f64).clamp(860.0, 2000.0);
    let spans = spans(&rows);
    let words = Words {
        name: "fps".to_owned(),
        title: "Frames per second by executor".to_owned(),
        caption: "For each data set and transfer function, the median over views of each executor's frames per second; \
                  the axis is logarithmic, so equal distances are equal ratios."
            .to_owned(),
    };
    Some(both(results, words, |words, shade| {
        let series: Vec<_> =
            executors.iter().map(|&(index, name)| (label(name, 24), shade.executor(name, index))).collect();
        let mut layout = sheet(words, [width, HEIGHT], &labels, "frames per second", shade).with_log_y();
        layout.y_range = decades(&all);
        layout.y_tick_format = kuva::TickFormat::Custom(std::sync::Arc::new(tick));
        let (plot, layout) = bars(&categories, &series, " fps", layout);
        let layout = with_room_below(layout);
        let over = data_set_names(&spans, &ComputedLayout::from_layout(&layout));
        (marks(plot), layout, over)
    }))
}

/// What a logarithmic axis can show.
fn shown(group: &Group<'_>) -> Option<f64> {
    Some(group.summary().fps).filter(|fps| fps.is_finite() && *fps > 0.0)
}

/// Groups of one data set and transfer function.
fn rows<'g, 'r>(groups: &'g [Group<'r>]) -> Vec<&'g [Group<'r>]> {
    groups.chunk_by(|a, b| (a.data_set, a.tf) == (b.data_set, b.tf)).collect()
}

fn spans<'a>(rows: &[&[Group<'a>]]) -> Vec<Span<'a>> {
    let mut spans: Vec<Span<'a>> = Vec::new();
    for (index, row) in rows.iter().enumerate() {
        match spans.last_mut() {
            Some(span) if span.data_set == row[0].data_set => span.last = index,
            _ => spans.push(Span { data_set: row[0].data_set, first: index, last: index }),
        }
    }
    spans
}

/// A range from somewhat below the least to above the most.
fn decades(values: &[f64]) -> (f64, f64) {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(0.0, f64::max);
    (least * 0.7, most * 1.1)
}

/// Room for the names of data sets under those of transfer functions.
fn with_room_below(layout: Layout) -> Layout {
    let placed = ComputedLayout::from_layout(&layout);
    let room = if layout.x_tick_rotate.is_some() { 28.0 } else { 14.0 };
    layout.with_force_margins_y(placed.margin_top, placed.margin_bottom + room)
}

/// Each under the middle of its transfer functions, with a line above it from the first to the last.
fn data_set_names(spans: &[Span<'_>], layout: &ComputedLayout) -> Vec<Primitive> {
    let y = layout.height - 12.0;
    let text = kuva::render::color::Color::from(&layout.theme.text_color);
    let line = kuva::render::color::Color::from(&layout.theme.axis_color);
    spans
        .iter()
        .flat_map(|span| {
            let [left, right] =
                [span.first as f64 + 1.0 - 0.42, span.last as f64 + 1.0 + 0.42].map(|x| layout.map_x(x));
            [
                Primitive::Line {
                    x1: left,
                    y1: y - 15.0,
                    x2: right,
                    y2: y - 15.0,
                    stroke: line.clone(),
                    stroke_width: 1.0,
                    stroke_dasharray: None,
                },
                Primitive::Text {
                    x: (left + right) / 2.0,
                    y,
                    content: label(span.data_set, ((right - left) / 8.0) as usize),
                    size: 12,
                    anchor: TextAnchor::Middle,
                    rotate: None,
                    bold: true,
                    color: Some(text.clone()),
                },
            ]
        })
        .collect()
}
