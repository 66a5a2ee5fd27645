//! What the figures are of.

use maud::{Markup, html};

/// Words and what they mean.
const STAGES: [(&str, &str); 6] = [
    ("total", "all bricks of the volume's full resolution."),
    ("non-empty", "bricks in whose range of values the transfer function shows anything at all."),
    (
        "after α, β",
        "those left without nearly empty bricks; with α = 0 and β = 1 the same as non-empty, and the picture is exact.",
    ),
    ("in frustum", "those that the camera sees some part of."),
    ("not occluded", "those not hidden behind what is opaque in front of them."),
    ("rendered", "those of which at least one sample was evaluated."),
];
const EXECUTORS: [(&str, &str); 5] = [
    (
        "hw",
        "slices on the GPU, every brick in the frustum drawn and nothing skipped: the usual way to draw with graphics hardware.",
    ),
    (
        "sw",
        "a plain software ray caster over the whole volume, without bricks: what the other pictures are compared with.",
    ),
    ("slices", "view-aligned slices, brick by brick, on the GPU, with empty and occluded bricks left out."),
    ("raycast", "rays on the GPU that skip empty bricks and end where nothing shines through."),
    ("cpu", "the same rays on the processor, many at once."),
];

pub fn section() -> Markup {
    html! {
        section #about {
            h2 { "What this is" }
            p {
                "Each volume was drawn with each transfer function from each view by each executor. "
                "A volume is cut into bricks, and most of the speed comes from bricks that need not be drawn: "
                "so the number of bricks that each stage leaves stands beside the time. "
                "Times are of a finished picture in linear light, medians of several; "
                "what was read and uploaded is of the first picture of a view."
            }
            div .columns {
                div { h3 { "Stages" } (definitions(&STAGES)) }
                div { h3 { "Executors" } (definitions(&EXECUTORS)) }
            }
        }
    }
}

fn definitions(words: &[(&str, &str)]) -> Markup {
    html! {
        dl .words {
            @for (word, meaning) in words {
                dt { (word) }
                dd { (meaning) }
            }
        }
    }
}
