use glassbrick_volume::{TransferFunction, VolumeDesc};

use super::background::Background;
use super::distribution::Distribution;
use super::points::{self, Point};

/// How deep one looks into an object, as a fraction of its size.
const PENETRATION: f64 = 0.025;

/// Objects that fill less of the volume than this are shown in glowing colours.
const SPARSE: f64 = 0.05;

/// Fraction of the object's voxels that stand out less, colour, and opacity over the depth that one looks into it.
const DENSE_POINTS: [Point; 5] = [
    (0.0, 0x2A1612, 0.0),
    (0.2, 0x6A3A30, 0.12),
    (0.5, 0xB4806C, 0.45),
    (0.85, 0xE2CDBB, 0.75),
    (0.99, 0xFFFAF0, 0.95),
];
const SPARSE_POINTS: [Point; 5] = [
    (0.0, 0x200828, 0.0),
    (0.2, 0x6A1A60, 0.12),
    (0.5, 0xC83A4A, 0.35),
    (0.85, 0xF89A3A, 0.7),
    (0.99, 0xFFF8C0, 0.95),
];

/// What is left of the opacity of values that hardly stand out: where values range widely, they are a veil.
const VEIL: f64 = 0.2;

/// Shows what stands out from the background, by how far it does.
pub(super) fn transfer_function(
    background: &Background,
    distribution: &Distribution,
    desc: &VolumeDesc,
) -> TransferFunction {
    let object = background.object();
    let shown = distribution.fraction(object);
    let points = if shown < SPARSE { SPARSE_POINTS } else { DENSE_POINTS };
    let value = |outstanding: f64| {
        distribution.quantile(if background.object_below { 1.0 - outstanding } else { outstanding }, object)
    };
    let [start, top] = [value(0.0), value(0.99)];
    let mut points = points.map(|(outstanding, color, opacity)| {
        let value = value(outstanding);
        let height = if top == start { 1.0 } else { (value - start) / (top - start) };
        (value, color, opacity * (VEIL + (1.0 - VEIL) * height))
    });
    if background.object_below {
        points.reverse();
    }
    points::transfer_function(&points, Some(penetration_mm(shown, desc)))
}

/// How deep one looks into an object that fills this fraction of the volume.
pub(super) fn penetration_mm(fraction: f64, desc: &VolumeDesc) -> f64 {
    (PENETRATION * size_mm(fraction, desc)).max(0.5 * desc.smallest_spacing_mm())
}

/// The edge of a cube as large as this fraction of the volume.
pub(super) fn size_mm(fraction: f64, desc: &VolumeDesc) -> f64 {
    (fraction * (desc.extent.as_dvec3() * desc.spacing_mm).element_product()).cbrt()
}
