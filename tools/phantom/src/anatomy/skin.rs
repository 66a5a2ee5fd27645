//! The outside of the body: one smooth surface from the crown to the toes, with skin, fat and muscle under it.

use super::parts::{Join, ball, both_sides, carve, limb, loft, oval, oval_along, part, shell};
use super::tissues::{FAT, MUSCLE, SKIN};
use crate::shape::{Layer, Part, Shape};
use crate::solid::{Section, Solid};

const SKIN_MM: f32 = 2.0;

pub fn shape() -> Shape {
    let parts = [trunk(), head(), both_sides([arm(), leg()].concat())].concat();
    let layers = vec![Layer::outer(0.0, SKIN), Layer::outer(SKIN_MM, FAT), Layer::inner(0.0, MUSCLE)];
    Shape::new(parts, layers)
}

/// The trunk from the perineum to the neck.
pub const TRUNK: [Section; 16] = [
    Section::mid(785.0, 12.0, 50.0, 20.0, 22.0),
    Section::mid(828.0, 12.0, 120.0, 60.0, 66.0),
    Section::mid(860.0, 6.0, 164.0, 94.0, 102.0),
    Section::mid(925.0, 5.0, 186.0, 112.0, 117.0),
    Section::mid(1000.0, 2.0, 177.0, 124.0, 112.0),
    Section::mid(1075.0, 0.0, 166.0, 132.0, 107.0),
    Section::mid(1140.0, 0.0, 163.0, 130.0, 108.0),
    Section::mid(1230.0, 0.0, 166.0, 124.0, 114.0),
    Section::mid(1300.0, 0.0, 168.0, 122.0, 118.0),
    Section::mid(1370.0, 2.0, 166.0, 112.0, 116.0),
    Section::mid(1420.0, 6.0, 160.0, 98.0, 108.0),
    Section::mid(1452.0, 10.0, 138.0, 80.0, 94.0),
    Section::mid(1482.0, 16.0, 92.0, 64.0, 76.0),
    Section::mid(1512.0, 22.0, 64.0, 54.0, 62.0),
    Section::mid(1545.0, 22.0, 50.0, 44.0, 48.0),
    Section::mid(1590.0, 20.0, 24.0, 20.0, 24.0),
];

fn trunk() -> Vec<Part> {
    let mut parts = vec![part(Solid::Loft(loft(&TRUNK, 0.5)), shell(22.0))];
    parts.extend(both_sides(vec![
        // Trapezius, collar, chest, buttocks.
        limb([28.0, 34.0, 1548.0], 27.0, [160.0, 16.0, 1450.0], 34.0, shell(8.0).blend(30.0)),
        limb([30.0, -24.0, 1462.0], 32.0, [158.0, -8.0, 1446.0], 36.0, shell(7.0).blend(30.0)),
        oval([80.0, -74.0, 1350.0], [76.0, 35.0, 56.0], shell(11.0).blend(34.0)),
        oval([80.0, 78.0, 915.0], [78.0, 58.0, 76.0], shell(26.0).blend(24.0)),
        ball([92.0, -108.0, 1322.0], 4.5, shell(3.0).blend(4.0)),
    ]));
    // Neck, larynx, navel, furrow of the back.
    parts.push(limb([0.0, 30.0, 1480.0], 57.0, [0.0, 16.0, 1610.0], 54.0, shell(5.0).blend(22.0)));
    parts.push(ball([0.0, -34.0, 1532.0], 9.0, shell(2.0).blend(16.0)));
    parts.push(carve(oval([0.0, -138.0, 1082.0], [6.0, 16.0, 9.0], shell(3.0).blend(8.0))));
    parts.push(carve(limb([0.0, 133.0, 1390.0], 8.0, [0.0, 124.0, 1010.0], 10.0, shell(8.0).blend(34.0))));
    parts
}

fn head() -> Vec<Part> {
    const FACE: Join = shell(4.0).blend(16.0);
    const FINE: Join = shell(2.0).blend(6.0);
    let mut parts = vec![
        oval([0.0, 2.0, 1693.0], [77.0, 98.0, 93.0], shell(3.5).blend(10.0)),
        oval([0.0, -36.0, 1640.0], [58.0, 56.0, 72.0], FACE),
        oval([0.0, -77.0, 1577.0], [20.0, 16.0, 14.0], FACE),
    ];
    parts.extend(both_sides(vec![
        // Jaw, cheek, brow, eye.
        limb([6.0, -68.0, 1578.0], 18.0, [41.0, -12.0, 1599.0], 16.0, FACE),
        limb([41.0, -12.0, 1599.0], 16.0, [56.0, 0.0, 1650.0], 16.0, FACE),
        oval([41.0, -58.0, 1640.0], [23.0, 25.0, 20.0], FACE),
        limb([57.0, -42.0, 1645.0], 9.0, [60.0, -6.0, 1648.0], 9.0, FACE),
        oval([27.0, -50.0, 1606.0], [24.0, 29.0, 28.0], FACE),
        limb([12.0, -86.0, 1687.0], 8.0, [46.0, -73.0, 1688.0], 7.5, shell(3.0).blend(22.0)),
        carve(oval([31.0, -101.0, 1668.0], [19.0, 17.0, 12.0], shell(2.0).blend(14.0))),
        oval_along([31.0, -77.0, 1667.0], [1.0, 0.25, 0.0], [16.0, 12.0, 10.5], shell(1.5).blend(7.0)),
        carve(limb([20.0, -92.0, 1664.5], 1.3, [32.0, -91.5, 1662.5], 1.3, shell(1.0).blend(2.5))),
        carve(limb([32.0, -91.5, 1662.5], 1.3, [44.0, -86.0, 1664.5], 1.3, shell(1.0).blend(2.5))),
        // The fold of the upper lid.
        carve(limb([20.0, -93.0, 1676.5], 1.6, [42.0, -88.0, 1677.0], 1.6, shell(1.0).blend(3.0))),
    ]));
    // Nose, mouth.
    parts.extend([
        limb([0.0, -90.0, 1680.0], 6.5, [0.0, -112.0, 1640.0], 7.5, shell(3.0).blend(14.0)),
        ball([0.0, -112.0, 1636.0], 9.0, FINE.blend(9.0)),
        oval([0.0, -84.0, 1602.0], [26.0, 12.0, 18.0], shell(3.0).blend(12.0)),
        oval_along([0.0, -94.5, 1606.0], [1.0, 0.0, 0.0], [23.0, 5.0, 4.4], shell(2.0).blend(3.0)),
        oval_along([0.0, -93.5, 1598.5], [1.0, 0.0, 0.0], [20.0, 5.5, 5.0], shell(2.0).blend(3.0)),
        carve(limb([-20.0, -96.0, 1602.4], 1.2, [20.0, -96.0, 1602.4], 1.2, shell(1.0).blend(3.0))),
        carve(limb([0.0, -104.0, 1626.0], 2.5, [0.0, -100.0, 1611.0], 2.5, shell(1.0).blend(4.0))),
        carve(oval([0.0, -102.0, 1588.0], [16.0, 7.0, 5.0], shell(1.5).blend(10.0))),
    ]);
    parts.extend(both_sides(vec![
        ball([9.5, -102.0, 1632.5], 7.0, FINE.blend(9.0)),
        carve(limb([6.5, -108.0, 1624.0], 2.4, [6.0, -100.0, 1632.0], 2.4, shell(1.0).blend(2.0))),
        // Ear: the shell with its hollow, and the lobe.
        oval_along([80.0, 17.0, 1660.0], [0.8, -0.6, 0.0], [4.5, 18.0, 28.0], shell(4.0).blend(6.0)),
        carve(oval_along([87.0, 11.0, 1660.0], [0.8, -0.6, 0.0], [5.0, 10.0, 18.0], shell(1.0).blend(5.0))),
        oval([77.0, 9.0, 1632.0], [5.0, 8.0, 10.0], shell(4.0).blend(5.0)),
    ]));
    parts
}

/// Outlines of the left arm from the wrist to the shoulder.
pub const ARM: [Section; 15] = [
    Section::at(815.0, [207.0, -12.0], 5.0, 10.0, 10.0),
    Section::at(845.0, [207.0, -12.0], 14.0, 22.0, 22.0),
    Section::at(872.0, [206.0, -12.0], 20.0, 28.0, 28.0),
    Section::at(905.0, [205.0, -10.0], 22.0, 30.0, 30.0),
    Section::at(960.0, [201.0, -5.0], 28.0, 34.0, 34.0),
    Section::at(1030.0, [196.0, 3.0], 35.0, 39.0, 39.0),
    Section::at(1080.0, [193.0, 9.0], 38.0, 42.0, 41.0),
    Section::at(1125.0, [192.0, 13.0], 37.0, 39.0, 40.0),
    Section::at(1170.0, [190.0, 13.0], 38.0, 40.0, 41.0),
    Section::at(1230.0, [187.0, 11.0], 43.0, 45.0, 45.0),
    Section::at(1300.0, [184.0, 9.0], 45.0, 48.0, 48.0),
    Section::at(1360.0, [180.0, 8.0], 48.0, 50.0, 51.0),
    Section::at(1410.0, [174.0, 7.0], 50.0, 52.0, 52.0),
    Section::at(1440.0, [168.0, 6.0], 42.0, 45.0, 45.0),
    Section::at(1470.0, [160.0, 6.0], 18.0, 20.0, 20.0),
];

/// The left arm, hanging at the side with the palm inwards.
fn arm() -> Vec<Part> {
    const SHOULDER: Join = shell(8.0).blend(34.0);
    const HAND: Join = shell(2.5).blend(7.0);
    let mut parts = vec![
        ball([174.0, 6.0, 1420.0], 52.0, SHOULDER),
        part(Solid::Loft(loft(&ARM, 0.1)), shell(6.0).blend(6.0)),
        oval_along([207.0, -12.0, 822.0], [1.0, 0.0, 0.06], [16.0, 42.0, 54.0], HAND.blend(12.0)),
        limb([204.0, -34.0, 850.0], 14.0, [198.0, -62.0, 808.0], 11.5, HAND),
        limb([198.0, -62.0, 808.0], 11.5, [194.0, -70.0, 768.0], 9.0, HAND.blend(3.0)),
    ];
    for (finger, [length, y]) in
        [[72.0, -40.0], [82.0, -20.5], [77.0, -1.0], [60.0, 17.0]].into_iter().enumerate()
    {
        let spread = (finger as f32 - 1.5) * 2.0;
        let knuckle = [208.0, y, 782.0 + if finger == 3 { 6.0 } else { 0.0 }];
        let middle = [205.0, y + spread * 0.5, knuckle[2] - length * 0.52];
        let tip = [197.0, y + spread, knuckle[2] - length];
        parts.push(limb(knuckle, 10.5, middle, 9.3, HAND.blend(3.0)));
        parts.push(limb(middle, 9.3, tip, 7.6, HAND.blend(3.0)));
    }
    parts
}

/// Outlines of the left leg, from above the heel to the hip.
pub const LEG: [Section; 16] = [
    Section::at(40.0, [98.0, 20.0], 16.0, 18.0, 20.0),
    Section::at(96.0, [98.0, 20.0], 31.0, 36.0, 38.0),
    Section::at(120.0, [98.0, 18.0], 32.0, 35.0, 36.0),
    Section::at(165.0, [98.0, 16.0], 39.0, 40.0, 43.4),
    Section::at(240.0, [98.0, 15.0], 50.1, 46.7, 55.6),
    Section::at(320.0, [98.0, 15.0], 61.3, 52.3, 70.1),
    Section::at(385.0, [97.0, 14.0], 64.6, 56.8, 75.7),
    Section::at(450.0, [97.0, 9.0], 61.3, 61.3, 66.8),
    Section::at(510.0, [97.0, 6.0], 65.6, 70.1, 63.4),
    Section::at(580.0, [97.0, 4.0], 75.7, 77.9, 75.7),
    Section::at(680.0, [95.0, 3.0], 89.0, 89.0, 91.2),
    Section::at(780.0, [92.0, 4.0], 98.0, 98.0, 102.3),
    Section::at(860.0, [91.0, 5.0], 100.2, 103.5, 111.3),
    Section::at(920.0, [90.0, 5.0], 95.7, 93.0, 111.3),
    Section::at(965.0, [78.0, 5.0], 64.5, 72.8, 77.0),
    Section::at(1010.0, [66.0, 5.0], 31.2, 31.2, 35.4),
];

fn leg() -> Vec<Part> {
    const FOOT: Join = shell(5.0).blend(16.0);
    let mut parts = vec![
        part(Solid::Loft(loft(&LEG, 0.12)), shell(10.0).blend(14.0)),
        // Kneecap and ankles.
        oval([97.0, -40.0, 514.0], [26.0, 24.0, 32.0], shell(4.0).blend(24.0)),
        ball([70.0, 16.0, 96.0], 9.0, shell(3.0).blend(12.0)),
        ball([127.0, 24.0, 88.0], 9.0, shell(3.0).blend(12.0)),
        // Heel, instep, ball of the foot.
        oval([98.0, 36.0, 66.0], [29.0, 32.0, 36.0], FOOT),
        limb([98.0, 14.0, 96.0], 36.0, [101.0, -40.0, 58.0], 29.0, FOOT),
        limb([100.0, -20.0, 56.0], 27.0, [92.0, -82.0, 34.0], 22.0, FOOT),
        limb([102.0, 20.0, 52.0], 24.0, [122.0, -68.0, 32.0], 18.0, FOOT),
    ];
    for (toe, [x, y, radius]) in [
        [83.0, -112.0, 12.5],
        [100.0, -110.0, 9.0],
        [113.0, -104.0, 8.5],
        [124.0, -96.0, 8.0],
        [134.0, -86.0, 7.5],
    ]
    .into_iter()
    .enumerate()
    {
        let root = [x + 1.0 - toe as f32 * 1.2, y + 30.0, 31.0];
        parts.push(limb(root, radius + 2.0, [x, y, 21.0], radius, shell(2.5).blend(4.0)));
    }
    parts
}
