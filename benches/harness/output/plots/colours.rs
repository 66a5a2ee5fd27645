//! Colours that stay apart for the colour-blind, after Okabe and Ito; brighter ones on dark pages.

use kuva::plot::LineStyle;
use kuva::render::theme::Theme;

/// The page a plot is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    Light,
    Dark,
}

/// On light pages, on dark pages.
type Colour = [&'static str; 2];

const BLUE: Colour = ["#0072b2", "#4aa8e8"];
const ORANGE: Colour = ["#d55e00", "#ff8b3d"];
const GREEN: Colour = ["#009e73", "#2fcf9f"];
const PINK: Colour = ["#b8578f", "#e59ac4"];
const AMBER: Colour = ["#e69f00", "#f3c14b"];
const SKY: Colour = ["#56b4e9", "#9fd8fb"];
const GREY: Colour = ["#8a8a8a", "#a3a3a3"];

const IN_ORDER: [Colour; 6] = [BLUE, ORANGE, GREEN, PINK, AMBER, SKY];

impl Shade {
    fn of(self, colour: Colour) -> &'static str {
        match self {
            Self::Light => colour[0],
            Self::Dark => colour[1],
        }
    }

    /// The same for an executor in all plots.
    pub fn executor(self, name: &str, index: usize) -> &'static str {
        self.of(match name {
            "hw" => GREY,
            "sw" => AMBER,
            "slices" => BLUE,
            "raycast" => SKY,
            "cpu" => ORANGE,
            _ => IN_ORDER[index % IN_ORDER.len()],
        })
    }

    /// Of the transfer function at this place among its data set's.
    pub fn transfer_function(self, index: usize) -> &'static str {
        self.of(IN_ORDER[index % IN_ORDER.len()])
    }

    /// Of text that is not what one looks at.
    pub fn muted(self) -> &'static str {
        self.of(["#5c6670", "#98a2ad"])
    }

    pub fn theme(self) -> Theme {
        let [background, line, grid, text] = match self {
            Self::Light => ["#ffffff", "#6b7580", "#e3e7eb", "#1d2329"],
            Self::Dark => ["#14181d", "#8b949e", "#2b323a", "#e4e8ec"],
        };
        Theme {
            background: background.into(),
            axis_color: line.into(),
            grid_color: grid.into(),
            tick_color: line.into(),
            text_color: text.into(),
            legend_bg: background.into(),
            legend_border: "none".into(),
            ..Theme::light()
        }
    }
}

/// How an executor's lines are drawn beside those of others: where they lie on each other, gaps show those below.
pub fn stroke(executor: &str, beside_others: bool) -> (LineStyle, f64) {
    match executor {
        "raycast" if beside_others => (LineStyle::Custom("5 4".into()), 3.0),
        "cpu" if beside_others => (LineStyle::Custom("2 5".into()), 4.0),
        _ => (LineStyle::Solid, 1.5),
    }
}
