//! The contrast-filled arteries, from the aorta to hands, feet and brain.

use super::parts::{SOLID, both_sides, tube};
use super::skull::CRANIUM;
use super::spine::line_y;
use super::tissues::ARTERY;
use super::tree::{Girth, grow, scatter};
use crate::noise::Sequence;
use crate::shape::{Layer, Part, Shape};
use crate::vector::{Vec3, length, mirror, sub};

pub fn shape(seed: u64) -> Shape {
    let parts = [aorta(), neck(), both_sides([arm(), leg()].concat()), trees(seed), coronaries()].concat();
    Shape::new(parts, vec![Layer::outer(0.0, ARTERY)])
}

fn aorta() -> Vec<Part> {
    let arch = [
        ([2.0, -22.0, 1338.0], 13.0),
        ([-10.0, -32.0, 1372.0], 14.5),
        ([-8.0, -24.0, 1408.0], 14.0),
        ([6.0, -4.0, 1424.0], 13.0),
        ([20.0, 20.0, 1412.0], 12.5),
        ([23.0, 36.0, 1385.0], 12.0),
        ([21.0, 36.0, 1330.0], 11.5),
        ([15.0, 30.0, 1260.0], 11.0),
        ([6.0, line_y(1190.0) - 28.0, 1190.0], 10.5),
        ([2.0, line_y(1130.0) - 30.0, 1130.0], 9.5),
        ([2.0, line_y(1072.0) - 30.0, 1072.0], 9.0),
    ];
    let gut = [
        ([3.0, 8.0, 1168.0], 4.0),
        ([1.0, -10.0, 1158.0], 4.0),
        ([-2.0, -24.0, 1110.0], 3.5),
        ([-14.0, -28.0, 1050.0], 2.2),
    ];
    let celiac = [([4.0, 8.0, 1182.0], 3.6), ([0.0, -10.0, 1184.0], 3.4), ([-28.0, -10.0, 1190.0], 2.4)];
    let splenic = [
        ([0.0, -10.0, 1184.0], 3.0),
        ([30.0, 0.0, 1192.0], 2.8),
        ([54.0, 10.0, 1186.0], 2.6),
        ([82.0, 28.0, 1208.0], 2.2),
    ];
    let renal = |side: f32, z: f32| {
        [
            ([side * 4.0, 8.0, z + 8.0], 3.2),
            ([side * 28.0, 20.0, z + 2.0], 3.0),
            ([side * 52.0, 36.0, z], 2.6),
        ]
    };
    let tubes: [&[(Vec3, f32)]; 6] =
        [&arch, &gut, &celiac, &splenic, &renal(1.0, 1140.0), &renal(-1.0, 1124.0)];
    tubes.into_iter().flat_map(|points| tube(points, SOLID)).collect()
}

/// Carotid, vertebral and subclavian arteries.
fn neck() -> Vec<Part> {
    let right_trunk =
        [([-4.0, -14.0, 1420.0], 7.0), ([-14.0, -16.0, 1442.0], 6.5), ([-20.0, -10.0, 1458.0], 6.0)];
    let right_carotid = [([-20.0, -10.0, 1458.0], 4.0), ([-21.0, -6.0, 1490.0], 3.6)];
    let left_carotid = [([6.0, -6.0, 1424.0], 4.2), ([14.0, -8.0, 1455.0], 3.8), ([21.0, -6.0, 1490.0], 3.6)];
    let right_subclavian = [([-20.0, -10.0, 1458.0], 5.0), ([-44.0, -2.0, 1474.0], 4.6)];
    let left_subclavian =
        [([15.0, 8.0, 1420.0], 5.0), ([22.0, 4.0, 1452.0], 4.8), ([44.0, -2.0, 1474.0], 4.6)];
    let up = [([21.0, -6.0, 1490.0], 3.6), ([25.0, -4.0, 1530.0], 3.5), ([27.0, -6.0, 1562.0], 4.0)];
    let internal = [
        ([27.0, -6.0, 1562.0], 3.0),
        ([28.0, 2.0, 1600.0], 2.6),
        ([26.0, 0.0, 1640.0], 2.5),
        ([14.0, -10.0, 1662.0], 2.4),
        ([12.0, -20.0, 1676.0], 2.3),
    ];
    let external = [
        ([27.0, -6.0, 1562.0], 2.4),
        ([38.0, -12.0, 1590.0], 2.0),
        ([52.0, 6.0, 1620.0], 1.6),
        ([69.0, -2.0, 1660.0], 1.3),
        ([69.0, -24.0, 1710.0], 1.0),
    ];
    let facial = [
        ([33.0, -10.0, 1580.0], 1.5),
        ([36.0, -34.0, 1577.0], 1.4),
        ([33.0, -62.0, 1598.0], 1.2),
        ([14.0, -86.0, 1632.0], 0.9),
    ];
    let vertebral = [
        ([36.0, 2.0, 1470.0], 2.0),
        ([17.0, 26.0, 1512.0], 1.8),
        ([17.0, 20.0, 1570.0], 1.8),
        ([22.0, 18.0, 1618.0], 1.8),
        ([4.0, 8.0, 1644.0], 1.8),
        ([0.0, -8.0, 1668.0], 1.8),
    ];
    let sides: [&[(Vec3, f32)]; 5] = [&up, &internal, &external, &facial, &vertebral];
    let mut parts = both_sides(sides.into_iter().flat_map(|points| tube(points, SOLID)).collect());
    let single: [&[(Vec3, f32)]; 5] =
        [&right_trunk, &right_carotid, &left_carotid, &right_subclavian, &left_subclavian];
    parts.extend(single.into_iter().flat_map(|points| tube(points, SOLID)));
    parts
}

fn arm() -> Vec<Part> {
    let upper = [
        ([44.0, -2.0, 1474.0], 4.6),
        ([86.0, -6.0, 1462.0], 4.4),
        ([130.0, 4.0, 1432.0], 4.0),
        ([160.0, 8.0, 1370.0], 3.6),
        ([172.0, 6.0, 1270.0], 3.0),
        ([180.0, -4.0, 1150.0], 2.6),
        ([190.0, -6.0, 1105.0], 2.4),
    ];
    let radial = [
        ([190.0, -6.0, 1105.0], 2.0),
        ([198.0, -16.0, 1040.0], 1.8),
        ([205.0, -30.0, 900.0], 1.7),
        ([200.0, -30.0, 850.0], 1.5),
        ([202.0, -20.0, 815.0], 1.2),
    ];
    let ulnar = [
        ([190.0, -6.0, 1105.0], 2.0),
        ([190.0, 2.0, 1030.0], 1.8),
        ([196.0, 4.0, 900.0], 1.6),
        ([200.0, 2.0, 840.0], 1.5),
        ([202.0, -20.0, 815.0], 1.2),
    ];
    let fingers = [-30.0, -11.0, 8.0].map(|y: f32| {
        [([202.0, y * 0.6 - 8.0, 815.0], 1.1), ([202.0, y, 780.0], 1.0), ([198.0, y, 730.0], 0.8)]
    });
    let long: [&[(Vec3, f32)]; 6] = [&upper, &radial, &ulnar, &fingers[0], &fingers[1], &fingers[2]];
    long.into_iter().flat_map(|points| tube(points, SOLID)).collect()
}

fn leg() -> Vec<Part> {
    let femoral = [
        ([2.0, 1.0, 1076.0], 6.5),
        ([24.0, 8.0, 1040.0], 6.0),
        ([54.0, 0.0, 985.0], 5.4),
        ([76.0, -50.0, 925.0], 5.0),
        ([84.0, -42.0, 840.0], 4.6),
        ([84.0, -22.0, 720.0], 4.2),
        ([84.0, 12.0, 590.0], 3.8),
        ([96.0, 36.0, 510.0], 3.5),
        ([104.0, 28.0, 440.0], 3.2),
    ];
    let internal = [([40.0, 8.0, 1012.0], 4.0), ([42.0, 34.0, 975.0], 3.4), ([30.0, 44.0, 930.0], 2.2)];
    let gluteal = [([42.0, 34.0, 975.0], 2.6), ([58.0, 70.0, 950.0], 2.2), ([92.0, 82.0, 930.0], 1.4)];
    let deep = [
        ([79.0, -48.0, 890.0], 3.4),
        ([102.0, -24.0, 830.0], 3.0),
        ([110.0, 14.0, 740.0], 2.4),
        ([108.0, 22.0, 640.0], 1.6),
    ];
    let front = [
        ([104.0, 28.0, 440.0], 2.2),
        ([114.0, 4.0, 415.0], 2.0),
        ([112.0, -2.0, 260.0], 1.8),
        ([98.0, -14.0, 110.0], 1.6),
        ([92.0, -60.0, 66.0], 1.2),
    ];
    let back = [
        ([104.0, 28.0, 440.0], 2.4),
        ([98.0, 34.0, 330.0], 2.1),
        ([88.0, 30.0, 200.0], 1.8),
        ([78.0, 28.0, 90.0], 1.6),
        ([84.0, -10.0, 46.0], 1.2),
    ];
    let fibular = [([102.0, 32.0, 390.0], 1.9), ([116.0, 36.0, 280.0], 1.6), ([116.0, 36.0, 120.0], 1.2)];
    let tubes: [&[(Vec3, f32)]; 7] = [&femoral, &internal, &gluteal, &deep, &front, &back, &fibular];
    tubes.into_iter().flat_map(|points| tube(points, SOLID)).collect()
}

/// Branches in the brain and the kidneys, and along the gut.
fn trees(seed: u64) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut random = Sequence::new(seed, 5);
    let (center, radii) = CRANIUM;
    for side in [1.0, -1.0] {
        let place = |p: Vec3| if side > 0.0 { p } else { mirror(p) };
        for (root, low, high, count) in [
            // Middle, anterior and posterior cerebral arteries.
            ([14.0, -20.0, 1677.0], [22.0, -60.0, 1668.0], [66.0, 60.0, 1760.0], 70),
            ([6.0, -24.0, 1680.0], [2.0, -80.0, 1690.0], [12.0, 50.0, 1775.0], 30),
            ([2.0, -8.0, 1670.0], [4.0, 20.0, 1650.0], [50.0, 86.0, 1720.0], 30),
        ] {
            let inside = |p: Vec3| {
                let q = sub(p, center);
                let depth =
                    length([q[0] / (radii[0] - 10.0), q[1] / (radii[1] - 10.0), q[2] / (radii[2] - 10.0)]);
                depth < 1.0 && (depth > 0.6 || high[0] < 20.0)
            };
            let targets: Vec<_> =
                scatter(low, high, count, &mut random, inside).into_iter().map(place).collect();
            let girth = Girth { twig_mm: 0.55, trunk_mm: 1.8, join: SOLID };
            parts.extend(grow(place(root), targets, girth, &mut random));
        }
        let z = if side > 0.0 { 1138.0 } else { 1122.0 };
        let inside = |p: Vec3| {
            let q = sub(p, [66.0, 42.0, z]);
            length([q[0] / 24.0, q[1] / 22.0, q[2] / 48.0]) < 1.0
        };
        let targets: Vec<_> =
            scatter([40.0, 15.0, z - 50.0], [95.0, 70.0, z + 50.0], 30, &mut random, inside)
                .into_iter()
                .map(place)
                .collect();
        let girth = Girth { twig_mm: 0.7, trunk_mm: 2.6, join: SOLID };
        parts.extend(grow(place([52.0, 36.0, z]), targets, girth, &mut random));
    }
    let targets = scatter([-80.0, -75.0, 990.0], [80.0, -10.0, 1110.0], 60, &mut random, |_| true);
    let girth = Girth { twig_mm: 0.6, trunk_mm: 2.6, join: SOLID };
    parts.extend(grow([-4.0, -26.0, 1100.0], targets, girth, &mut random));
    parts
}

/// The arteries of the heart muscle, on its surface.
fn coronaries() -> Vec<Part> {
    let front = [
        ([6.0, -26.0, 1352.0], 2.0),
        ([24.0, -44.0, 1350.0], 1.9),
        ([38.0, -62.0, 1326.0], 1.7),
        ([56.0, -66.0, 1296.0], 1.4),
        ([68.0, -56.0, 1272.0], 1.0),
    ];
    let around = [
        ([22.0, -36.0, 1352.0], 1.8),
        ([44.0, -18.0, 1350.0], 1.7),
        ([58.0, 4.0, 1322.0], 1.5),
        ([52.0, 12.0, 1290.0], 1.1),
    ];
    let right = [
        ([-4.0, -34.0, 1352.0], 2.0),
        ([-18.0, -46.0, 1340.0], 1.9),
        ([-24.0, -50.0, 1310.0], 1.7),
        ([-8.0, -42.0, 1280.0], 1.5),
        ([14.0, -16.0, 1268.0], 1.2),
    ];
    let tubes: [&[(Vec3, f32)]; 3] = [&front, &around, &right];
    tubes.into_iter().flat_map(|points| tube(points, SOLID)).collect()
}
