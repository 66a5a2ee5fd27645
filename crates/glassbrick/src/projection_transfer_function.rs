use glassbrick_volume::{ControlPoint, TransferFunction};

use crate::Histogram;

/// The fraction of voxels at each end of a histogram that may be outliers.
const OUTLIERS: f64 = 1e-4;

impl Histogram {
    /// The values between which nearly all voxels lie: without the 1 in 10,000 at each end.
    pub fn typical_range(&self) -> [f64; 2] {
        let bins = 0..self.counts.len();
        match (self.first_typical(bins.clone()), self.first_typical(bins.clone().rev())) {
            (Some(low), Some(high)) if low < high => {
                let [min, max] = self.range;
                // An end without outliers is the range's own, not the middle of its last bin.
                [
                    if low == bins.start { min } else { self.value(low) },
                    if high + 1 == bins.end { max } else { self.value(high) },
                ]
            }
            _ => self.range,
        }
    }

    /// The first of these bins that does not hold outliers alone.
    fn first_typical(&self, mut bins: impl Iterator<Item = usize>) -> Option<usize> {
        let outliers = self.voxels() * OUTLIERS;
        let mut sum = 0.0;
        bins.find(|&bin| {
            sum += self.counts[bin];
            sum > outliers
        })
    }
}

/// A transfer function for a first picture of projected values (MIP and its kin): opaque, from black to white over
/// nearly all values.
pub fn projection_transfer_function(histogram: &Histogram) -> TransferFunction {
    let [low, high] = histogram.typical_range();
    let point = |value, grey| ControlPoint { value, color: [grey; 3], opacity: 1.0 };
    TransferFunction { points: vec![point(low, 0.0), point(high, 1.0)], unit_mm: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn histogram(counts: &[f64]) -> Histogram {
        Histogram { range: [0.0, counts.len() as f64], counts: counts.to_vec() }
    }

    #[test]
    fn a_few_outliers_do_not_count() {
        let mut counts = vec![1000.0; 100];
        counts[60..].fill(0.0);
        counts[99] = 2.0;
        assert_eq!(histogram(&counts).typical_range(), [0.0, 59.5]);
        counts[99] = 1000.0;
        assert_eq!(histogram(&counts).typical_range(), [0.0, 100.0]);
    }

    #[test]
    fn one_value_or_none_keeps_the_range() {
        assert_eq!(histogram(&[0.0, 5.0, 0.0]).typical_range(), [0.0, 3.0]);
        assert_eq!(histogram(&[0.0; 4]).typical_range(), [0.0, 4.0]);
    }

    #[test]
    fn projected_values_are_seen_from_black_to_white() {
        let function = projection_transfer_function(&histogram(&[10.0; 10]));
        assert_eq!(function.at(0.0), ([0.0; 3], 1.0));
        assert_eq!(function.at(5.0), ([0.5; 3], 1.0));
        assert_eq!(function.at(10.0), ([1.0; 3], 1.0));
    }
}
