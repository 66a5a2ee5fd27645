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

    /// Whether any value of the closed interval has an extinction above zero. Between entries extinction is linear, so it
    /// is above zero somewhere if it is at an end, or at an entry within.
    pub fn shows_any(&self, low: f64, high: f64) -> bool {
        let is_within = |&index: &usize| (low..=high).contains(&self.entry_value(index));
        let within = (0..ENTRIES).filter(is_within).map(|index| self.entries[index]);
        within.chain([self.at(low), self.at(high)]).any(|entry| entry.extinction > 0.0)
    }

    /// The open intervals of values on which extinction is above zero, as long as they can be.
    pub fn bands(&self) -> Vec<[f64; 2]> {
        // Between two entries without extinction that have none between them, all is shown or nothing.
        let zeros = (0..ENTRIES).filter(|&index| self.entries[index].extinction == 0.0);
        let mut ends: Vec<f64> = zeros.map(|index| self.entry_value(index)).collect();
        ends.insert(0, f64::NEG_INFINITY);
        ends.push(f64::INFINITY);
        let between = |low: f64, high: f64| match (low.is_finite(), high.is_finite()) {
            (true, true) => (low + high) / 2.0,
            (true, false) => self.last.max(low) + 1.0,
            _ => self.first.min(high) - 1.0,
        };
        let pairs = ends.windows(2).map(|pair| [pair[0], pair[1]]);
        pairs.filter(|&[low, high]| self.at(between(low, high)).extinction > 0.0).collect()
    }

    fn entry_value(&self, index: usize) -> f64 {
        self.first + index as f64 / (ENTRIES - 1) as f64 * (self.last - self.first)
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
