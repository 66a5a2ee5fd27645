//! Transfer functions over a range of values. None has a ramp shorter than 5/4096 of that range.

use crate::reference::ControlPoint;

const SKIN: [f64; 3] = [0.9, 0.6, 0.45];
const BONE: [f64; 3] = [1.0, 0.95, 0.8];
const BLUE: [f64; 3] = [0.1, 0.3, 0.95];
const GREEN: [f64; 3] = [0.2, 0.85, 0.3];

/// The shortest ramp that the agreement table holds for, as a fraction of the value range.
pub const STEEPEST_RAMP: f64 = 5.0 / 4096.0;

type Points = Vec<ControlPoint>;

/// A band of a twelfth of the range, with nothing to see on either side.
pub fn narrow_band(range: [f64; 2]) -> Points {
    points(
        range,
        &[(0.0, SKIN, 0.0), (0.46, SKIN, 0.0), (0.5, BONE, 0.7), (0.54, BLUE, 0.0), (1.0, BLUE, 0.0)],
    )
}

/// Three bands of different colour and strength, the last one up to the end.
pub fn several_bands(range: [f64; 2]) -> Points {
    let low = [(0.0, BLUE, 0.0), (0.12, BLUE, 0.0), (0.17, GREEN, 0.06), (0.22, BLUE, 0.0)];
    let middle = [(0.4, SKIN, 0.0), (0.45, SKIN, 0.35), (0.52, SKIN, 0.02), (0.56, SKIN, 0.0)];
    let high = [(0.7, BONE, 0.0), (0.8, BONE, 0.9), (1.0, BONE, 0.95)];
    points(range, &[&low[..], &middle[..], &high[..]].concat())
}

/// Nothing below the middle, opaque one steepest ramp above it, and less so toward the end.
pub fn steepest_ramp(range: [f64; 2]) -> Points {
    points(range, &[(0.0, SKIN, 0.0), (0.5, SKIN, 0.0), (0.5 + STEEPEST_RAMP, BONE, 1.0), (1.0, BLUE, 0.5)])
}

/// Everything a little.
pub fn haze(range: [f64; 2]) -> Points {
    points(range, &[(0.0, BLUE, 0.002), (0.5, SKIN, 0.012), (1.0, BONE, 0.04)])
}

/// Points in the middle of the range only, so that the bands at both ends are unbounded.
pub fn bounded_away_from_ends(range: [f64; 2]) -> Points {
    points(range, &[(0.3, BLUE, 0.01), (0.45, SKIN, 0.0), (0.55, SKIN, 0.25), (0.7, BONE, 0.4)])
}

/// Nothing in the lower part, opaque above.
pub fn opaque_above(range: [f64; 2]) -> Points {
    points(range, &[(0.0, SKIN, 0.0), (0.55, SKIN, 0.0), (0.65, BONE, 1.0), (1.0, GREEN, 1.0)])
}

/// All values alike.
pub fn one_point() -> Points {
    vec![ControlPoint { value: 0.0, color: SKIN, opacity: 0.6 }]
}

/// Points far outside the range on both sides.
pub fn wider_than_the_values(range: [f64; 2]) -> Points {
    points(range, &[(-2.0, BLUE, 0.0), (0.45, GREEN, 0.0), (0.6, SKIN, 0.3), (2.5, BONE, 0.8)])
}

/// Colour and opacity that tell every value from its neighbours, for modes that show one value.
pub fn rainbow(range: [f64; 2]) -> Points {
    points(
        range,
        &[(0.0, BLUE, 0.0), (0.25, GREEN, 0.3), (0.5, SKIN, 0.5), (0.75, BLUE, 0.8), (1.0, BONE, 1.0)],
    )
}

/// The same with low and high values exchanged.
pub fn reversed(mut points: Points) -> Points {
    let sum = points[0].value + points[points.len() - 1].value;
    points.reverse();
    for point in &mut points {
        point.value = sum - point.value;
    }
    points
}

/// Points at fractions of the range.
fn points([low, high]: [f64; 2], at: &[(f64, [f64; 3], f64)]) -> Points {
    let point =
        |&(fraction, color, opacity)| ControlPoint { value: low + fraction * (high - low), color, opacity };
    at.iter().map(point).collect()
}
