use glassbrick_volume::{TransferFunction, VolumeDesc};

use super::distribution::{ALL, Distribution};
use super::object::penetration_mm;
use super::points;

/// Values on both sides of zero, which is where most are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Signed {
    /// No farther from zero, values are not shown.
    pub quiet: f64,
    /// Nearly all values are no farther from zero.
    pub reach: f64,
}

impl Signed {
    pub fn of(distribution: &Distribution) -> Option<Self> {
        let all = |fraction| distribution.quantile(fraction, ALL);
        let (low, high) = (all(0.001), all(0.999));
        let reach = high.max(-low);
        let mode = distribution.mode(0.05 * (high - low));
        let about_zero = mode.abs().min(all(0.5).abs()) < 0.1 * reach;
        if !(about_zero && high.min(-low) > 0.25 * reach) {
            return None;
        }
        let half = (all(0.75) - all(0.5)).max(all(0.5) - all(0.25));
        Some(Self { quiet: half.clamp(0.1 * reach, 0.5 * reach), reach })
    }

    /// Blue below zero, red above, and the brighter and more opaque the farther.
    pub fn transfer_function(&self, distribution: &Distribution, desc: &VolumeDesc) -> TransferFunction {
        let Self { quiet, reach } = *self;
        let middle = 0.5 * (quiet + reach);
        let shown = 1.0 - distribution.fraction([-quiet, quiet]);
        let points = [
            (-reach, 0xC8F0FF, 0.7),
            (-middle, 0x3A8CE8, 0.2),
            (-quiet, 0x1A2A80, 0.0),
            (quiet, 0x80201A, 0.0),
            (middle, 0xE8702A, 0.2),
            (reach, 0xFFF0B0, 0.7),
        ];
        points::transfer_function(&points, Some(penetration_mm(shown, desc)))
    }
}
