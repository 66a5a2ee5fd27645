//! Transfer functions of every kind, and what they show, looked up by hand.

use glassbrick_volume::{BAKED_ENTRIES, BakedTransferFunction, ControlPoint, TransferFunction};
use proptest::prelude::*;
use proptest::sample::select;

/// Points at whole numbers from `low` to `high`, many of them clear, some of them steps.
pub fn transfer_function(low: i32, high: i32) -> impl Strategy<Value = TransferFunction> {
    let value = prop_oneof![2 => low..=high, 1 => select(vec![low, high, (low + high) / 2])];
    let opacity = prop_oneof![3 => Just(0.0), 1 => Just(1.0), 2 => 0.0..1.0];
    prop::collection::vec((value, opacity), 1..9).prop_map(|mut points| {
        points.sort_by_key(|&(value, _)| value);
        let point =
            |(value, opacity)| ControlPoint { value: f64::from(value), color: [0.9, 0.5, 0.2], opacity };
        TransferFunction { points: points.into_iter().map(point).collect(), unit_mm: None }
    })
}

/// Interpolated extinction at a value, exactly that of an entry where the value is an entry's.
pub fn extinction_by_hand(baked: &BakedTransferFunction, value: f64) -> f64 {
    let last = BAKED_ENTRIES - 1;
    let entries = &baked.extinction;
    if baked.first_value == baked.last_value || value >= baked.last_value {
        return entries[last].into();
    }
    if value <= baked.first_value {
        return entries[0].into();
    }
    let right = (1..last).find(|&entry| baked.entry_value(entry) > value).unwrap_or(last);
    let [a, b] = [right - 1, right].map(|entry| baked.entry_value(entry));
    let fraction = (value - a) / (b - a);
    f64::from(entries[right - 1]) * (1.0 - fraction) + f64::from(entries[right]) * fraction
}

/// Whether anything in [min, max] has an extinction above zero.
pub fn shows_any_of(baked: &BakedTransferFunction, [min, max]: [f64; 2]) -> bool {
    let inside = (0..BAKED_ENTRIES).filter(|&entry| (min..=max).contains(&baked.entry_value(entry)));
    [min, max].into_iter().any(|value| extinction_by_hand(baked, value) > 0.0)
        || (baked.first_value < baked.last_value
            && inside.into_iter().any(|entry| baked.extinction[entry] > 0.0))
}
