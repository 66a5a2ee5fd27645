use glassbrick_volume::VolumeDesc;

use super::samples::Part;

const MOST_BINS: f64 = 4096.0;

/// Values that are sorted to find strays, about.
const SORTED: usize = 100_000;

/// Fractions of the values at either end that are strays if they lie beyond so many times the width of all others.
const STRAYS: (f64, f64) = (5e-4, 16.0);

/// The same for what cannot be meant, such as what memory holds that was never written: it is not counted at all.
const ABSURD: [(f64, f64); 2] = [(2e-2, 1e5), (2e-3, 2e3)];

/// Equal bins over stored values.
pub struct Bins {
    pub count: usize,
    /// Where the first bin begins and the last one ends, in values.
    pub span: [f64; 2],
    counted: [f64; 2],
    first_stored: f64,
    bins_per_stored: f64,
}

impl Bins {
    /// Bins over [min, max] less the strays. Of whole numbers each holds equally many, and they are its middle.
    pub fn new(desc: &VolumeDesc, [min, max]: [f32; 2], parts: &[Part]) -> Self {
        let sorted = sorted_part(parts);
        let range = [f64::from(min), f64::from(max)];
        let counted = ABSURD.into_iter().fold(range, |range, strays| cut(range, &sorted, strays));
        let [low, high] = cut(counted, &sorted, STRAYS);
        let (low, high, width) = if desc.stored_type.is_integer() {
            let [low, high] = [low.floor(), high.ceil()];
            (low - 0.5, high + 0.5, ((high - low + 1.0) / MOST_BINS).ceil())
        } else {
            (low, high, (high - low) / MOST_BINS)
        };
        let count = if width > 0.0 { ((high - low) / width).ceil().clamp(1.0, MOST_BINS) } else { 1.0 };
        let [a, b] = [low, low + count * width].map(|stored| desc.rescale.value(stored));
        Self {
            count: count as usize,
            span: [a.min(b), a.max(b)],
            counted,
            first_stored: desc.rescale.stored(a.min(b)),
            bins_per_stored: if width > 0.0 { desc.rescale.slope.signum() / width } else { 0.0 },
        }
    }

    /// The bin of a stored value: strays are in the outermost, and what cannot be meant in none.
    pub fn bin(&self, stored: f32) -> Option<usize> {
        let stored = f64::from(stored);
        let bin = (stored - self.first_stored) * self.bins_per_stored;
        let [low, high] = self.counted;
        (low <= stored && stored <= high).then(|| (bin.max(0.0) as usize).min(self.count - 1))
    }
}

fn sorted_part(parts: &[Part]) -> Vec<f64> {
    let pairs: usize = parts.iter().map(|part| part.pairs.len()).sum();
    let every = (pairs / SORTED).max(1);
    let mut sorted: Vec<f64> =
        parts.iter().flat_map(|part| &part.pairs).step_by(every).map(|pair| f64::from(pair[0])).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted
}

/// [min, max] of which no more is left than `times` the width of the values in it less a fraction at either end.
fn cut([min, max]: [f64; 2], sorted: &[f64], (fraction, times): (f64, f64)) -> [f64; 2] {
    let within =
        &sorted[sorted.partition_point(|&value| value < min)..sorted.partition_point(|&value| value <= max)];
    let strays = (within.len() as f64 * fraction) as usize;
    match (within.get(strays), within.iter().rev().nth(strays)) {
        (Some(low), Some(high)) if high > low => {
            let far = 0.5 * (times - 1.0) * (high - low);
            [min.max(low - far), max.min(high + far)]
        }
        _ => [min, max],
    }
}
