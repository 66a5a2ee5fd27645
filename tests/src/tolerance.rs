//! How far a picture may be from the reference, and how far it is.

use std::fmt;

use crate::reference::Mode;

/// What an executor must keep to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Of the largest difference, all but 0.01 % of the pixels.
    pub largest: f64,
    /// Of the mean difference.
    pub mean: f64,
}

/// The CPU, scalar and SIMD, against the reference.
pub const CPU: Tolerance = Tolerance { largest: 1e-3, mean: 1e-5 };
/// The GPU's raycast, and slices into an `Rgba32Float` target, against the reference.
pub const GPU: Tolerance = Tolerance { largest: 4e-3, mean: 2e-4 };
/// Slices into an `Rgba16Float` target against the reference.
pub const GPU_HALF_FLOAT: Tolerance = Tolerance { largest: 3e-2, mean: 3e-3 };
/// One CPU kernel against itself: bricked or not, whatever the memory, threads, skipping and source.
pub const SAME_KERNEL: Tolerance = Tolerance { largest: 1e-6, mean: 1e-6 };

/// Holds depths to the reference's. They are sample planes, `plane_mm` apart: a sample more or less of rounding at A = 0.5 is
/// the next plane, and rare; extremal samples that are equal but for rounding may be told apart either way.
///
/// # Panics
/// When more depths differ than that explains.
pub fn assert_depths(name: &str, mode: Mode, plane_mm: f64, drawn: &[f32], truth: &[f64]) {
    let differs = |(&drawn, &truth): (&f32, &f64)| {
        let drawn = f64::from(drawn);
        drawn != truth && (drawn - truth).abs() > 1e-4 * plane_mm
    };
    let off = drawn.iter().zip(truth).filter(|&pair| differs(pair)).count();
    let allowed = 1 + truth.len() / if mode == Mode::Dvr { 500 } else { 50 };
    assert!(drawn.len() == truth.len() && off <= allowed, "{name}: {off} of {} depths differ", truth.len());
}

/// How far two pictures are apart. A pixel's difference is the largest of its four channels'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// The largest difference, once the worst 0.01 % of the pixels are set aside. Their number is rounded down: of
    /// fewer than 10,000 pixels, none is set aside.
    pub largest_all_but_0_01_percent: f64,
    /// The mean over all pixels.
    pub mean: f64,
}

/// Compares a picture with the reference; a channel that is not finite is infinitely far off.
///
/// # Panics
/// When the pictures are not of the same size, or have no pixel.
pub fn compare(frame: &[[f32; 4]], reference: &[[f64; 4]]) -> Difference {
    assert_eq!(frame.len(), reference.len(), "the pictures have the same number of pixels");
    let mut differences: Vec<f64> =
        frame.iter().zip(reference).map(|(a, b)| pixel_difference(a, b)).collect();
    let mean = differences.iter().sum::<f64>() / differences.len() as f64;
    differences.sort_by(f64::total_cmp);
    let set_aside = differences.len() / 10_000;
    Difference { largest_all_but_0_01_percent: differences[differences.len() - 1 - set_aside], mean }
}

fn pixel_difference(a: &[f32; 4], b: &[f64; 4]) -> f64 {
    let channels = a.iter().zip(b).map(|(&a, &b)| (f64::from(a) - b).abs());
    channels.fold(
        0.0,
        |largest, difference| {
            if difference.is_finite() { largest.max(difference) } else { f64::INFINITY }
        },
    )
}

impl Difference {
    /// Whether both figures keep to the tolerance.
    pub fn is_within(self, tolerance: Tolerance) -> bool {
        self.largest_all_but_0_01_percent <= tolerance.largest && self.mean <= tolerance.mean
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "largest {:.2e} (all but 0.01 %), mean {:.2e}",
            self.largest_all_but_0_01_percent, self.mean
        )
    }
}
