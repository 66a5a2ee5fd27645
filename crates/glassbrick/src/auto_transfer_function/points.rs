use glassbrick_volume::{BAKED_ENTRIES, ControlPoint, TransferFunction};

/// Value, colour as 0xRRGGBB (sRGB), opacity.
pub(super) type Point = (f64, u32, f64);

/// Entries of the baked table between points, at least. Fewer than two are warned of; these leave room for points that
/// are added behind the last.
const ENTRIES_APART: f64 = 8.0;

/// A transfer function of points, lowest first. Points too close to others to be told apart in the baked table are left
/// out, but the first and the last, which are moved apart.
pub(super) fn transfer_function(points: &[Point], unit_mm: Option<f64>) -> TransferFunction {
    let (first, last) = (points[0], points[points.len() - 1]);
    let least = (1e-6 * first.0.abs().max(last.0.abs())).max(f64::MIN_POSITIVE.sqrt());
    let start = first.0.min(last.0 - least);
    let apart = (last.0 - start) * ENTRIES_APART / (BAKED_ENTRIES - 1) as f64;
    let mut kept = vec![last];
    for &point in points[1..points.len().max(2) - 1].iter().rev() {
        if point.0 <= kept[kept.len() - 1].0 - apart && point.0 >= start + apart {
            kept.push(point);
        }
    }
    kept.push((start, first.1, first.2));
    let point = |&(value, rgb, opacity): &Point| ControlPoint { value, color: srgb(rgb), opacity };
    // A unit too small or large for numbers would make extinctions of which nothing is left.
    let unit_mm = unit_mm.filter(|unit| unit.is_normal());
    TransferFunction { points: kept.iter().rev().map(point).collect(), unit_mm }
}

fn srgb(rgb: u32) -> [f64; 3] {
    let [_, red, green, blue] = rgb.to_be_bytes();
    [red, green, blue].map(|code| f64::from(code) / 255.0)
}
