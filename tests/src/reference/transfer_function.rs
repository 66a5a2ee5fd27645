use glam::DVec3;

use crate::srgb;

const ENTRIES: usize = 1024;

/// Colour and opacity at a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    pub value: f64,
    /// sRGB-encoded red, green and blue, 0 to 1.
    pub color: [f64; 3],
    /// Opacity per unit length, 0 to 1.
    pub opacity: f64,
}

/// What the transfer function gives for a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// Extinction per mm.
    pub extinction: f64,
    /// Opacity per unit length.
    pub opacity: f64,
    /// Colour in linear light.
    pub color: DVec3,
}

/// A transfer function as a table of 1024 entries from the first point's value to the last's.
#[derive(Clone, Debug)]
pub struct BakedTransferFunction {
    first: f64,
    last: f64,
    entries: Vec<Entry>,
}

impl BakedTransferFunction {
    /// Bakes points that are sorted by value; opacities are of `unit` mm.
    pub fn new(points: &[ControlPoint], unit: f64) -> Self {
        let first = points.first().expect("a transfer function has a point").value;
        let last = points.last().expect("a transfer function has a point").value;
        let entry = |index: usize| {
            let t = index as f64 / (ENTRIES - 1) as f64;
            let value = if t < 1.0 { first + t * (last - first) } else { last };
            let (color, opacity) = interpolated(points, value);
            Entry {
                extinction: -(1.0 - opacity.min(0.9999)).ln() / unit,
                opacity,
                color: color.map(srgb::decode),
            }
        };
        Self { first, last, entries: (0..ENTRIES).map(entry).collect() }
    }

    /// What the table gives for a value: linear between entries, clamped to the table.
    pub fn at(&self, value: f64) -> Entry {
        if self.first == self.last {
            return self.entries[0];
        }
        let end = (ENTRIES - 1) as f64;
        let place = ((value - self.first) / (self.last - self.first) * end).clamp(0.0, end);
        let index = (place as usize).min(ENTRIES - 2);
        let (a, b, t) = (self.entries[index], self.entries[index + 1], place - index as f64);
        Entry {
            extinction: a.extinction + t * (b.extinction - a.extinction),
            opacity: a.opacity + t * (b.opacity - a.opacity),
            color: a.color.lerp(b.color, t),
        }
    }
}

/// Colour (still sRGB-encoded) and opacity between the points. Of points at one value, the last holds there.
fn interpolated(points: &[ControlPoint], value: f64) -> (DVec3, f64) {
    let after = points.partition_point(|point| point.value <= value);
    let b = points[after.min(points.len() - 1)];
    let a = points[after.saturating_sub(1)];
    let t = if b.value > a.value { (value - a.value) / (b.value - a.value) } else { 0.0 };
    let color = DVec3::from_array(a.color).lerp(DVec3::from_array(b.color), t);
    (color, a.opacity + t * (b.opacity - a.opacity))
}
