use glassbrick::Band;

use super::directions::patient_direction;
use super::{Info, Needs};
use crate::figures::{bytes, count, number, percent, time};
use crate::terminal::one_line;

/// Width of the column of names.
const NAME_WIDTH: usize = 12;

/// What is told as lines of a name and a value each, below the path.
pub fn text(info: &Info) -> String {
    let mut lines = vec![one_line(&info.job.input.path.to_string_lossy())];
    let told = [volume_lines(info), bricks_lines(info), info.needs.as_ref().map_or(Vec::new(), needs_lines)];
    for (name, value) in told.into_iter().flatten() {
        lines.push(format!("  {name:<NAME_WIDTH$} {value}"));
    }
    for note in info.volume.notes() {
        lines.push(format!("  {:<NAME_WIDTH$} {}", "note", one_line(note)));
    }
    lines.join("\n")
}

type Line = (&'static str, String);

fn volume_lines(info: &Info) -> Vec<Line> {
    let (volume, desc) = (info.volume, info.volume.desc());
    let size_mm = desc.extent.as_dvec3() * desc.spacing_mm;
    let direction = desc.direction;
    let axes = [("x", direction.x_axis), ("y", direction.y_axis), ("z", direction.z_axis)];
    let rescale = desc.rescale;
    let [low, high] = volume.value_range();
    let mut lines = vec![
        ("format", volume.format().to_owned()),
        ("extent", format!("{} voxels", list(desc.extent.to_array().map(f64::from), " × "))),
        ("spacing", format!("{} mm", list(desc.spacing_mm.to_array(), " × "))),
        ("size", format!("{} mm", list(size_mm.to_array(), " × "))),
        ("origin", format!("{} mm", list(desc.origin_mm.to_array(), ", "))),
        ("directions", axes.map(|(name, axis)| format!("{name} → {}", patient_direction(axis))).join(", ")),
        ("dtype", desc.stored_type.to_string()),
        ("rescale", format!("value = {} · stored + {}", number(rescale.slope), number(rescale.intercept))),
        ("values", format!("{} to {}", number(low), number(high))),
        ("bytes", format!("{} ({})", count(desc.bytes()), bytes(desc.bytes()))),
    ];
    let not_finite = volume.bricks().not_finite();
    if not_finite > 0 {
        lines.push(("not finite", format!("{} voxels, read as 0", count(not_finite))));
    }
    lines
}

fn bricks_lines(info: &Info) -> Vec<Line> {
    let grid = info.volume.bricks().grid(0);
    let counts = list(grid.counts.to_array().map(f64::from), " × ");
    let (edge, halo) = (grid.layout.edge, grid.layout.halo);
    let bricks = format!("{} ({counts}) of {edge}³ voxels, halo {halo}", count(grid.len() as u64));
    let mut lines = vec![("bricks", bricks)];
    if let Some(store) = info.volume.store() {
        let last = info.volume.bricks().grid(store.levels() - 1).extent.to_array().map(f64::from);
        lines.push(("levels", format!("{}, the last of {} voxels", store.levels(), list(last, " × "))));
        let codec = store.codec.name();
        lines.push(("stored", format!("from {}, codec {codec}", one_line(&store.source_format))));
    }
    lines.push(("backend", format!("{}: {}", info.backend_auto.0, one_line(&info.backend_auto.1))));
    lines
}

fn needs_lines(needs: &Needs) -> Vec<Line> {
    let bands: Vec<String> = needs.bands.iter().map(band).collect();
    let total = (needs.empty + needs.filtered_visible).max(1);
    let visible = count(needs.filtered_visible as u64);
    let fraction = percent(needs.filtered_visible as f64 / total as f64);
    vec![
        ("tf shows", if bands.is_empty() { "nothing".to_owned() } else { bands.join(", ") }),
        ("tf bricks", format!("{visible} visible ({fraction}), {} empty", count(needs.empty as u64))),
        ("tf bytes", format!("{} ({}) of bricks", count(needs.bytes), bytes(needs.bytes))),
        (
            "tf loading",
            format!(
                "{} from files, about {}",
                bytes(needs.file_bytes.round() as u64),
                time(needs.load_seconds * 1e3)
            ),
        ),
        ("tf voxels", format!("{} visible", percent(needs.visible_voxels))),
    ]
}

fn band(band: &Band) -> String {
    match (band.low.is_finite(), band.high.is_finite()) {
        (true, true) => format!("{} to {}", number(band.low), number(band.high)),
        (true, false) => format!("above {}", number(band.low)),
        (false, true) => format!("below {}", number(band.high)),
        (false, false) => "every value".to_owned(),
    }
}

fn list(numbers: [f64; 3], between: &str) -> String {
    numbers.map(number).join(between)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_told_with_their_ends() {
        let told = |low, high| band(&Band { low, high });
        assert_eq!(told(-100.0, 250.5), "-100 to 250.5");
        assert_eq!(told(300.0, f64::INFINITY), "above 300");
        assert_eq!(told(f64::NEG_INFINITY, 0.0), "below 0");
        assert_eq!(told(f64::NEG_INFINITY, f64::INFINITY), "every value");
    }
}
