use glassbrick_volume::{TransferFunction, VolumeDesc};

use super::distribution::{ALL, Distribution};
use super::points;

/// Shows the faces of the block: its values in greys, all of them opaque.
pub(super) fn transfer_function(distribution: &Distribution, desc: &VolumeDesc) -> TransferFunction {
    let [low, high] = [0.005, 0.995].map(|fraction| distribution.quantile(fraction, ALL));
    let points = [(low, 0x080808, 0.8), (high, 0xFFFFFF, 0.8)];
    points::transfer_function(&points, Some(desc.smallest_spacing_mm()))
}
