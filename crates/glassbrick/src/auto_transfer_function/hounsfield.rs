use glassbrick_volume::{TransferFunction, VolumeDesc};

use super::distribution::{ALL, Distribution};
use super::object::size_mm;
use super::points::{self, Point};

/// What is added to Hounsfield units: nothing, or what makes air zero where values are stored without a sign.
const OFFSETS: [f64; 3] = [0.0, 1024.0, 1000.0];

/// Bone in ivory, and what is soft as a veil around it; nothing of what is lighter than fat, such as foam and wood.
const POINTS: [Point; 9] = [
    (-200.0, 0xD0A890, 0.0),
    (-100.0, 0xD0A890, 0.002),
    (0.0, 0xB86A5A, 0.004),
    (80.0, 0xB05048, 0.005),
    (150.0, 0x8E4A38, 0.006),
    (260.0, 0xA9674A, 0.06),
    (450.0, 0xDDBB8E, 0.35),
    (900.0, 0xF1E3C6, 0.75),
    (1800.0, 0xFFFBF0, 0.95),
];

/// The opacities are per this fraction of the body's size, about 1 mm for a head, so that a mouse looks like a man.
const UNIT: f64 = 1.0 / 170.0;

/// What to subtract from values to get Hounsfield units, if this looks like a CT.
pub(super) fn offset(distribution: &Distribution) -> Option<f64> {
    OFFSETS.into_iter().find(|&offset| is_ct(distribution, offset))
}

/// A CT of a body is air, and what is soft in a narrow peak near water; little lies between the two. Whatever else
/// there is below air is padding.
fn is_ct(distribution: &Distribution, offset: f64) -> bool {
    let fraction = |low: f64, high: f64| distribution.fraction([low + offset, high + offset]);
    let [min, max] = distribution.histogram.range.map(|value| value - offset);
    let air = fraction(-1100.0, -850.0);
    let soft = fraction(-150.0, 150.0);
    let body = fraction(-250.0, f64::INFINITY);
    let peak = distribution.quantile(0.5, [offset - 200.0, offset + 300.0]) - offset;
    let parted = fraction(-650.0, -250.0) / 400.0 < 0.35 * soft / 300.0;
    if !(parted && soft > 0.5 * body && (-140.0..=120.0).contains(&peak) && max > 150.0) {
        return false;
    }
    if offset == 0.0 {
        // Few volumes but CTs go so far below zero. One cut out of a body holds hardly any air.
        return min < -800.0 && (air > 0.02 || soft > 0.5);
    }
    // An MR may well have its tissue at 1000, but not in so narrow a peak.
    min > -1100.0 && max > 500.0 && air > 0.05 && fraction(peak - 75.0, peak + 75.0) > 0.4 * body
}

pub(super) fn transfer_function(
    offset: f64,
    distribution: &Distribution,
    desc: &VolumeDesc,
) -> TransferFunction {
    let body = distribution.fraction([offset + POINTS[0].0, ALL[1]]);
    let points = POINTS.map(|(value, color, opacity)| (value + offset, color, opacity));
    points::transfer_function(&points, Some(UNIT * size_mm(body, desc)))
}
