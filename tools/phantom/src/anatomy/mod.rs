//! The body, as shapes in the order in which they are painted.
//!
//! Millimetres from the middle of the body at its soles: x to the patient's left, y posterior, z superior. The body
//! is 1787 mm tall. Where the sides differ, they do as in most people: the heart points to the left, the liver and
//! the higher dome of the diaphragm are on the right, the spleen and the stomach on the left. A marker ball sits on
//! the left shoulder, and only the left teeth have fillings.

mod abdomen;
mod arteries;
mod heart;
mod limbs;
mod lungs;
mod parts;
mod pelvis;
mod skin;
mod skull;
mod spine;
mod thorax;
mod tissues;
mod tree;

use crate::shape::{Layer, Shape};
use crate::vector::Vec3;

/// The middle of the marker ball on the left shoulder.
pub const MARKER: Vec3 = [166.0, -44.0, 1474.0];

/// Every shape of the body, innermost last.
pub fn body(seed: u64) -> Vec<Shape> {
    let mut shapes = vec![skin::shape()];
    shapes.extend(lungs::spaces());
    shapes.extend(abdomen::shapes(seed));
    shapes.push(lungs::gullet());
    shapes.extend(heart::shapes());
    shapes.extend(lungs::trees(seed));
    shapes.extend(thorax::shapes());
    shapes.extend(spine::shapes());
    shapes.extend(pelvis::shapes());
    shapes.extend(limbs::shapes());
    shapes.push(lungs::windpipe());
    shapes.extend(skull::shapes());
    shapes.push(arteries::shape(seed));
    shapes.push(Shape::new(
        vec![parts::ball(MARKER, 11.0, parts::SOLID)],
        vec![Layer::outer(0.0, tissues::MARKER)],
    ));
    shapes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Phantom;

    /// The mean of 3×3×3 voxels of the Visible-Human-sized phantom around a place.
    fn hounsfield(place: Vec3) -> f32 {
        let phantom = Phantom::new(Phantom::VISIBLE_HUMAN, 1);
        let (origin, spacing) = (phantom.origin_mm(), phantom.spacing_mm());
        let [x, y, z] =
            [0, 1, 2].map(|axis| ((f64::from(place[axis]) - origin[axis]) / spacing[axis]).round() as usize);
        let mut slices = vec![0; 3 * phantom.slice_voxels()];
        phantom.fill_slices(z as u32 - 1, &mut slices);
        let [width, height, _] = phantom.extent.map(|n| n as usize);
        let mut sum = 0.0;
        for offset in 0..27 {
            let (dx, dy, dz) = (offset % 3, offset / 3 % 3, offset / 9);
            sum += f32::from(slices[(dz * height + y + dy - 1) * width + x + dx - 1]);
        }
        sum / 27.0
    }

    #[test]
    fn tissues_are_where_a_person_has_them() {
        for (name, place, expected, tolerance) in [
            ("air beside the head", [200.0, -100.0, 1700.0], -1000.0, 5.0),
            ("right lung", [-95.0, 20.0, 1330.0], -860.0, 80.0),
            ("windpipe", [0.5, -9.0, 1470.0], -990.0, 30.0),
            ("fat of the belly", [60.0, -108.0, 1075.0], -102.0, 25.0),
            ("thigh muscle", [70.0, 20.0, 760.0], 52.0, 40.0),
            ("liver", [-100.0, 30.0, 1215.0], 88.0, 70.0),
            ("left ventricle", [34.0, -24.0, 1304.0], 390.0, 15.0),
            ("aorta", [21.0, 36.0, 1330.0], 390.0, 15.0),
            ("brain", [30.0, -20.0, 1745.0], 34.0, 40.0),
            ("bladder", [2.0, -30.0, 912.0], 8.0, 15.0),
            ("marrow of the thigh", [116.0, -8.0, 680.0], -40.0, 60.0),
            ("cortex of the thigh", [106.0, -8.0, 680.0], 1450.0, 200.0),
            ("lumbar vertebra", [0.0, 32.0, 1137.0], 260.0, 130.0),
            ("marker", MARKER, 1700.0, 15.0),
        ] {
            let hu = hounsfield(place);
            assert!((hu - expected).abs() < tolerance, "{name}: {hu} HU at {place:?}");
        }
    }

    #[test]
    fn left_and_right_can_be_told() {
        let mirror = crate::vector::mirror;
        assert!(hounsfield(mirror(MARKER)) < 100.0, "only the left shoulder has a marker");
        let apex = [56.0, -50.0, 1295.0];
        let (left, right) = (hounsfield(apex), hounsfield(mirror(apex)));
        assert!(left > 50.0 && right < -500.0, "the heart points to the left: {left} and {right} HU");
        let dome = [85.0, -6.0, 1271.0];
        let (left, right) = (hounsfield(dome), hounsfield(mirror(dome)));
        assert!(left < -500.0 && right > 0.0, "the right dome is higher: {left} and {right} HU");
    }
}
