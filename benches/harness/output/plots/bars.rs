//! Bars side by side in groups.

use kuva::plot::BarPlot;
use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::plots::Plot as Marks;

/// Bars of one category: one for each series, nothing where there is no value.
pub struct Category {
    pub label: String,
    pub bars: Vec<Option<f64>>,
}

/// A series' name and colour.
pub type Series = (String, &'static str);

/// The bars, and the sheet with their legend.
pub fn bars(categories: &[Category], series: &[Series], unit: &str, layout: Layout) -> (BarPlot, Layout) {
    let mut plot = BarPlot::new().with_width(0.82);
    let mut hints = Vec::new();
    for category in categories {
        let values = category.bars.iter().zip(series);
        hints.extend(values.clone().map(|(value, (name, _))| {
            let value = value.map_or_else(|| "did not run".to_owned(), |value| format!("{value:.2}{unit}"));
            format!("{}, {name}: {value}", category.label).replace("\\$", "$")
        }));
        plot = plot
            .with_group(&category.label, values.map(|(value, (_, colour))| (value.unwrap_or(0.0), *colour)));
    }
    let plot = plot.with_tooltips().with_tooltip_labels(hints);
    let legend = series
        .iter()
        .map(|(name, colour)| LegendEntry {
            label: name.clone(),
            color: (*colour).to_owned(),
            shape: LegendShape::Rect,
            dasharray: None,
        })
        .collect();
    (plot, layout.with_legend_entries(legend).with_legend_box(false))
}

/// Marks that hold nothing but bars.
pub fn marks(plot: BarPlot) -> Vec<Marks> {
    vec![Marks::Bar(plot)]
}

/// Where the middle of a bar and its end lie, in pixels.
pub fn place(layout: &ComputedLayout, category: usize, bar: usize, bars: usize, value: f64) -> [f64; 2] {
    let width = 0.82 / bars as f64;
    let x = category as f64 + 1.0 - 0.41 + width * (bar as f64 + 0.5);
    [layout.map_x(x), layout.map_y(value)]
}
