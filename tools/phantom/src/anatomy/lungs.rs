//! Chest cavity, diaphragm, lungs with their vessels, windpipe and airways.

use super::parts::{SOLID, loft, part, shell, tube};
use super::thorax::CAGE;
use super::tissues::{AIR, FAT, LUNG, LUNG_VESSEL, ORGAN_WALL};
use super::tree::{Girth, grow, scatter};
use crate::noise::Sequence;
use crate::shape::{Clip, Keep, Layer, Part, Shape};
use crate::solid::{Dome, Domes, Section, Solid};
use crate::vector::Vec3;

/// The diaphragm: the right dome (over the liver) is higher than the left.
pub fn diaphragm() -> Solid {
    Solid::Domes(Domes([
        Dome { top: [68.0, -6.0, 1266.0], fall: [0.012, 0.011] },
        Dome { top: [-62.0, -6.0, 1286.0], fall: [0.011, 0.011] },
    ]))
}

/// Between the lungs; it bulges to the left around the heart.
const MEDIASTINUM: [Section; 8] = [
    Section::at(1180.0, [0.0, 10.0], 30.0, 110.0, 80.0),
    Section::at(1260.0, [22.0, 6.0], 50.0, 112.0, 86.0),
    Section::at(1300.0, [20.0, 4.0], 54.0, 112.0, 90.0),
    Section::at(1340.0, [8.0, 4.0], 46.0, 106.0, 90.0),
    Section::at(1380.0, [2.0, 6.0], 34.0, 100.0, 84.0),
    Section::at(1425.0, [2.0, 8.0], 36.0, 90.0, 72.0),
    Section::at(1465.0, [0.0, 14.0], 34.0, 60.0, 50.0),
    Section::at(1500.0, [0.0, 20.0], 34.0, 40.0, 40.0),
];

const RIBS_MM: f32 = 7.0;

fn cage() -> Solid {
    Solid::Loft(loft(&CAGE, 0.1))
}

fn mediastinum() -> Solid {
    Solid::Loft(loft(&MEDIASTINUM, 0.0))
}

/// The space between the lungs, filled with fat, and the lungs.
pub fn spaces() -> Vec<Shape> {
    // Clips bound the tissue itself, and its layer begins under the ribs.
    let clip = |solid, keep, gap_mm| Clip { solid, keep, gap_mm, shell_mm: 0.0 };
    let mut between = Shape::new(vec![part(cage(), SOLID)], vec![Layer::outer(RIBS_MM, FAT)]);
    between.clips =
        vec![clip(diaphragm(), Keep::Outside, 1.0 - RIBS_MM), clip(mediastinum(), Keep::Inside, -RIBS_MM)];
    let mut lungs = Shape::new(vec![part(cage(), SOLID)], vec![Layer::outer(RIBS_MM, LUNG)]);
    lungs.clips =
        vec![clip(diaphragm(), Keep::Outside, -RIBS_MM), clip(mediastinum(), Keep::Outside, -RIBS_MM)];
    vec![between, lungs]
}

/// Arteries and veins of the lungs, and the airways.
pub fn trees(seed: u64) -> Vec<Shape> {
    let (cage, domes, between) = (cage(), diaphragm(), mediastinum());
    let inside = |side: f32, depth: f32| {
        let (cage, domes, between) = (&cage, &domes, &between);
        move |point: Vec3| {
            point[0] * side > 0.0
                && cage.distance(point) < -RIBS_MM - depth
                && domes.distance(point) > depth
                && between.distance(point) > 1.0
        }
    };
    let (mut vessels, mut airways): (Vec<Part>, Vec<Part>) = (Vec::new(), Vec::new());
    for side in [1.0, -1.0] {
        let mut random = Sequence::new(seed, if side > 0.0 { 1 } else { 2 });
        let (low, high) = ([-140.0, -100.0, 1170.0], [140.0, 100.0, 1490.0]);
        for (root, count) in [([38.0 * side, 8.0, 1362.0], 420), ([34.0 * side, 4.0, 1336.0], 260)] {
            let targets = scatter(low, high, count, &mut random, inside(side, 5.0));
            let girth = Girth { twig_mm: 0.62, trunk_mm: 8.0, join: SOLID };
            vessels.extend(grow(root, targets, girth, &mut random));
        }
        let targets = scatter(low, high, 60, &mut random, inside(side, 22.0));
        let girth = Girth { twig_mm: 1.5, trunk_mm: 6.0, join: shell(1.0) };
        airways.extend(grow([36.0 * side, 16.0, 1358.0], targets, girth, &mut random));
    }
    let wall = vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, AIR)];
    vec![Shape::new(vessels, vec![Layer::outer(0.0, LUNG_VESSEL)]), Shape::new(airways, wall)]
}

/// The windpipe and the main bronchi.
pub fn windpipe() -> Shape {
    let trachea = [
        ([0.0, -18.0, 1522.0], 9.5),
        ([0.0, -12.0, 1480.0], 9.5),
        ([1.0, 2.0, 1430.0], 9.5),
        ([1.0, 12.0, 1384.0], 10.0),
    ];
    let left = [([2.0, 12.0, 1384.0], 8.0), ([20.0, 16.0, 1368.0], 7.0), ([38.0, 17.0, 1357.0], 6.0)];
    let right = [([0.0, 12.0, 1384.0], 8.5), ([-16.0, 16.0, 1370.0], 7.5), ([-37.0, 17.0, 1357.0], 6.5)];
    let wall = shell(1.6);
    let parts = [tube(&trachea, wall), tube(&left, wall), tube(&right, wall)].concat();
    Shape::new(parts, vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, AIR)])
}

/// The gullet, behind the windpipe.
pub fn gullet() -> Shape {
    let points = [
        ([3.0, 4.0, 1510.0], 7.0),
        ([5.0, 16.0, 1440.0], 7.0),
        ([4.0, 26.0, 1360.0], 7.0),
        ([10.0, 22.0, 1290.0], 7.5),
        ([30.0, 4.0, 1250.0], 8.0),
    ];
    let layers = vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, AIR)];
    Shape::new(tube(&points, shell(5.5)), layers)
}
