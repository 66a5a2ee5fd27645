use std::f64::consts::TAU;

use glassbrick_volume::{TransferFunction, VolumeDesc};

use super::distribution::Distribution;
use super::points::{self, Point};

/// Labels, at most. More are shown as any values are.
const MOST_LABELS: usize = 64;

/// Of a label's voxels, so many have neighbours of the same.
const REPEATED: f64 = 0.6;

/// The optical depth of a label: all are as see-through, so that those inside others are seen.
const DEPTH: f64 = 4.0;

/// The colour of a mask.
const MASK: u32 = 0xE8DCC8;

/// Whether values are names: there are two of them, or few, and most neighbours share one.
pub(super) fn are_labels(distribution: &Distribution) -> bool {
    let histogram = distribution.histogram;
    let labels = labels(distribution);
    let mut repeated: Vec<f64> =
        labels.iter().map(|&bin| histogram.repeated_counts[bin] / histogram.counts[bin]).collect();
    repeated.sort_by(f64::total_cmp);
    labels.len() == 2
        || ((3..=MOST_LABELS).contains(&labels.len()) && repeated[repeated.len() / 4] > REPEATED)
}

/// The bins that are not empty.
fn labels(distribution: &Distribution) -> Vec<usize> {
    let counts = &distribution.histogram.counts;
    (0..counts.len()).filter(|&bin| counts[bin] > 0.0).collect()
}

/// Every label in a colour of its own, and what is on the volume's faces not at all.
pub(super) fn transfer_function(distribution: &Distribution, desc: &VolumeDesc) -> TransferFunction {
    let histogram = distribution.histogram;
    let labels = labels(distribution);
    let background = histogram.bin(distribution.face_mode(histogram.bin_width()));
    let point = |(index, &bin): (usize, &usize)| -> Point {
        let across_voxels = histogram.counts[bin].cbrt();
        let opacity = if bin == background { 0.0 } else { 1.0 - (-DEPTH / across_voxels).exp() };
        (histogram.value(bin), if labels.len() == 2 { MASK } else { hue(index) }, opacity)
    };
    let points: Vec<Point> = labels.iter().enumerate().map(point).collect();
    points::transfer_function(&points, Some(desc.spacing_mm.element_product().cbrt()))
}

/// Colours that differ: hues by the golden angle.
fn hue(index: usize) -> u32 {
    let turns = 0.08 + index as f64 * 0.381_966;
    [0.0, 2.0 / 3.0, 1.0 / 3.0].into_iter().fold(0, |rgb, shift| {
        let channel = 0.6 + 0.35 * (TAU * (turns + shift)).cos();
        (rgb << 8) | (255.0 * channel) as u32
    })
}
