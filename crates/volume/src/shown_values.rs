use crate::{Band, Rescale};

/// The ranges of stored values of which a transfer function may show something.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownValues {
    /// Of each band, the largest stored value that a range may begin with and the smallest that it may end with.
    bands: Vec<[f32; 2]>,
}

impl ShownValues {
    /// What the bands of a transfer function show of values that are rescaled so.
    pub fn new(bands: &[Band], rescale: Rescale) -> Self {
        let ends = |band: &Band| {
            let is_below_high = |stored: f32| rescale.value(f64::from(stored)) < band.high;
            let is_above_low = |stored: f32| rescale.value(f64::from(stored)) > band.low;
            if rescale.slope > 0.0 {
                [last(is_below_high), first(is_above_low)]
            } else {
                [last(is_above_low), first(is_below_high)]
            }
        };
        Self { bands: bands.iter().map(ends).collect() }
    }

    /// Whether anything is seen of some stored value between two.
    #[inline(always)]
    pub fn meets(&self, min: f32, max: f32) -> bool {
        self.bands.iter().any(|&[begin, end]| min <= begin && max >= end)
    }
}

/// The first stored value for which something holds that holds for all values behind it; infinite if there is none.
fn first(holds: impl Fn(f32) -> bool) -> f32 {
    let (mut before, mut found) = (key(f32::NEG_INFINITY), key(f32::INFINITY));
    while found - before > 1 {
        let middle = before + (found - before) / 2;
        if holds(at(middle)) {
            found = middle;
        } else {
            before = middle;
        }
    }
    at(found)
}

/// The last stored value for which something holds that holds for all values before it; infinite if there is none.
fn last(holds: impl Fn(f32) -> bool) -> f32 {
    -first(|stored| holds(-stored))
}

/// The place of a number among all numbers.
fn key(number: f32) -> i64 {
    let bits = i64::from(number.to_bits() & 0x7FFF_FFFF);
    if number.is_sign_negative() { -bits } else { bits }
}

/// The number at a place.
fn at(key: i64) -> f32 {
    let number = f32::from_bits(key.unsigned_abs() as u32);
    if key < 0 { -number } else { number }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_shown_that_meet_a_band() {
        let bands = [
            Band { low: f64::NEG_INFINITY, high: -900.5 },
            Band { low: 140.0, high: 260.0 },
            Band { low: 300.1, high: f64::INFINITY },
        ];
        let values =
            [-2000.0, -901.0, -900.5, -900.0, 0.0, 140.0, 140.1, 199.0, 260.0, 299.0, 300.0, 300.2, 4e3];
        for (slope, intercept) in [(1.0, 0.0), (1.0, -1024.0), (-0.3, 17.0), (2.5e-3, 1e-2)] {
            let rescale = Rescale { slope, intercept };
            let shown = ShownValues::new(&bands, rescale);
            for (a, b) in values.iter().flat_map(|&a| values.iter().map(move |&b| (a, b))) {
                let [a, b] = [a, b].map(|value| rescale.stored(value) as f32);
                let (min, max) = (a.min(b), a.max(b));
                let [low, high] = [min, max].map(|stored| rescale.value(f64::from(stored)));
                let by_hand = bands.iter().any(|band| band.meets(low.min(high), low.max(high)));
                assert_eq!(shown.meets(min, max), by_hand, "{min} to {max}, {rescale:?}");
            }
        }
    }
}
