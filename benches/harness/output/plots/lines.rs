//! Lines over categories: a colour for each transfer function, a stroke for each executor.

use kuva::plot::legend::{LegendEntry, LegendShape};
use kuva::plot::{LinePlot, ScatterPlot};
use kuva::render::layout::Layout;
use kuva::render::plots::Plot as Marks;

use super::colours::{Shade, stroke};
use super::sheet::{label, tick};
use crate::output::figures::significant;
use crate::output::table::printable;

const MARKER_RADIUS: f64 = 2.5;
const LEGEND_WIDTH: f64 = 145.0;
/// What fits beside the legend's marks.
const LEGEND_CHARACTERS: usize = 15;

/// Values of one transfer function and executor.
pub struct Line {
    pub tf: String,
    /// Among its data set's.
    pub tf_place: usize,
    pub executor: String,
    /// The category's index and the value there.
    pub points: Vec<(usize, f64)>,
}

/// The lines, and the sheet with their legend, from 0 to somewhat above the most.
pub fn lines(lines: &[Line], layout: Layout, shade: Shade) -> (Vec<Marks>, Layout) {
    let values = lines.iter().flat_map(|line| line.points.iter().map(|(_, value)| *value));
    let most = values.filter(|value| value.is_finite()).fold(0.0, f64::max);
    let top = if most > 0.0 { most * 1.08 } else { 1.0 };
    let mut layout = layout.with_y_axis_min(0.0).with_y_axis_max(top);
    layout.y_range = (0.0, top);
    layout.y_tick_format = kuva::TickFormat::Custom(std::sync::Arc::new(tick));
    let mut marks = Vec::new();
    let several = lines.iter().any(|line| line.executor != lines[0].executor);
    for line in lines {
        let finite = || line.points.iter().filter(|(_, value)| value.is_finite());
        let points: Vec<(f64, f64)> =
            finite().map(|&(category, value)| (category as f64 + 1.0, value)).collect();
        let colour = shade.transfer_function(line.tf_place);
        let (style, width) = stroke(&line.executor, several);
        let drawn = LinePlot::new().with_data(points.clone()).with_color(colour).with_stroke_width(width);
        marks.push(Marks::Line(drawn.with_line_style(style)));
        let named = printable(&format!("{}, {}", line.tf, line.executor));
        let hints = finite().map(|(_, value)| format!("{named}: {}", significant(*value)));
        let markers = ScatterPlot::new().with_data(points).with_color(colour).with_size(MARKER_RADIUS);
        marks.push(Marks::Scatter(markers.with_tooltips().with_tooltip_labels(hints)));
    }
    (marks, with_legend(layout, lines, shade, several))
}

fn with_legend(layout: Layout, lines: &[Line], shade: Shade, several: bool) -> Layout {
    let mut tfs: Vec<LegendEntry> = Vec::new();
    let mut executors: Vec<LegendEntry> = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let before = &lines[..index];
        if before.iter().all(|other| other.tf != line.tf) {
            let label = label(&line.tf, LEGEND_CHARACTERS);
            let color = shade.transfer_function(line.tf_place).to_owned();
            tfs.push(LegendEntry { label, color, shape: LegendShape::Rect, dasharray: None });
        }
        if before.iter().all(|other| other.executor != line.executor) {
            let label = label(&line.executor, LEGEND_CHARACTERS);
            let dasharray = stroke(&line.executor, several).0.dasharray();
            let color = shade.muted().to_owned();
            executors.push(LegendEntry { label, color, shape: LegendShape::Line, dasharray });
        }
    }
    layout
        .with_legend_group("Transfer function", tfs)
        .with_legend_group("Executor", executors)
        .with_legend_box(false)
        .with_legend_width(LEGEND_WIDTH)
}
