//! What all plots share: a size, a title, text from files, and where the figures come from.

use kuva::backend::svg::SvgBackend;
use kuva::render::color::Color;
use kuva::render::layout::Layout;
use kuva::render::plots::Plot as Marks;
use kuva::render::render::{Primitive, Scene, TextAnchor, render_multiple};

use super::Plot;
use super::colours::Shade;
use crate::output::figures::shortened;
use crate::output::table::printable;
use crate::{BenchResults, Provenance};

const FONT: &str =
    "system-ui, -apple-system, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, 'DejaVu Sans', sans-serif";
const FOOTER_SIZE: u32 = 10;
/// Of a character in the footer, in pixels; wide fonts have 6.
const FOOTER_CHARACTER: f64 = 6.0;
const MARGIN: f64 = 16.0;

/// A plot's words.
pub struct Words {
    pub name: String,
    pub title: String,
    pub caption: String,
}

/// Text of a name from outside: short, without control characters, and never taken for a formula.
pub fn label(name: &str, most: usize) -> String {
    shortened(&printable(name), most).replace('\\', "＼").replace('$', "\\$")
}

/// How far names must be turned to fit beside each other in so many pixels.
pub fn turn(names: &[String], width: f64) -> Option<f64> {
    let longest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0);
    (longest as f64 * 6.2 + 5.0 > width / names.len().max(1) as f64).then_some(-35.0)
}

/// An empty sheet for categories at 1, 2, …
pub fn sheet(words: &Words, size: [f64; 2], categories: &[String], y_label: &str, shade: Shade) -> Layout {
    let mut layout = Layout::new((0.5, categories.len() as f64 + 0.5), (0.0, 1.0))
        .with_width(size[0])
        .with_height(size[1])
        .with_title(words.title.clone())
        .with_title_size(16)
        .with_label_size(12)
        .with_tick_size(12)
        .with_body_size(12)
        .with_y_label(y_label)
        .with_x_categories(categories.to_vec())
        .with_font_family(FONT)
        .with_theme(shade.theme());
    if let Some(angle) = turn(categories, size[0] - 200.0) {
        layout = layout.with_x_tick_rotate(angle);
    }
    layout
}

/// A plot for both kinds of pages; `draw` gives its marks, its sheet, and what stands on both.
pub fn plot(
    results: &BenchResults,
    words: Words,
    draw: impl Fn(&Words, Shade) -> (Vec<Marks>, Layout, Vec<Primitive>),
) -> Plot {
    let svg = |shade| {
        let (marks, layout, over) = draw(&words, shade);
        let mut scene = render_multiple(marks, layout);
        scene.elements.extend(over);
        add_footer(&mut scene, &results.provenance, shade);
        finished(&scene, &words)
    };
    let (light, dark) = (svg(Shade::Light), svg(Shade::Dark));
    Plot { name: words.name, title: words.title.replace("\\$", "$"), caption: words.caption, light, dark }
}

/// Without zeros at the end.
pub fn tick(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Where the figures come from, in small letters under the plot.
fn add_footer(scene: &mut Scene, provenance: &Provenance, shade: Shade) {
    let lines = [
        format!(
            "glassbrick {}, commit {}, {}",
            provenance.version,
            provenance.commit.get(..12).unwrap_or(&provenance.commit),
            provenance.date
        ),
        provenance.machine_in_words(),
        provenance.adapter_in_words(),
        provenance.command.clone(),
    ];
    scene.height += 6.0;
    let most = ((scene.width - 2.0 * MARGIN) / FOOTER_CHARACTER) as usize;
    for line in lines {
        scene.height += f64::from(FOOTER_SIZE) * 1.45;
        scene.add(Primitive::Text {
            x: MARGIN,
            y: scene.height - 6.0,
            content: label(&line, most),
            size: FOOTER_SIZE,
            anchor: TextAnchor::Start,
            rotate: None,
            bold: false,
            color: Some(Color::from(shade.muted())),
        });
    }
    scene.height += 6.0;
}

/// As SVG that grows and shrinks with its page, and that says what it is to those who do not see it.
fn finished(scene: &Scene, words: &Words) -> String {
    let svg = SvgBackend::new().render_scene(scene);
    let name = maud::html! { (words.title.replace("\\$", "$")) }.into_string();
    let opening = format!(
        r#"<svg role="img" aria-label="{name}" viewBox="0 0 {:.0} {:.0}" "#,
        scene.width.ceil(),
        scene.height.ceil()
    );
    svg.replacen("<svg ", &opening, 1)
}
