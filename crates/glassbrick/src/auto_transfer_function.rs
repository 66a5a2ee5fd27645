use glassbrick_volume::TransferFunction;

use crate::{Histogram, preset};

/// A transfer function for a first picture, from how often values occur.
pub fn auto_transfer_function(histogram: &Histogram) -> TransferFunction {
    preset("grey", histogram.range).expect("grey is a preset")
}
