//! The heart with its chambers, and the great vessels of the lungs.

use super::parts::{SOLID, both_sides, oval, oval_along, tube};
use super::tissues::{ARTERY, MYOCARDIUM, RIGHT_HEART_BLOOD, VEIN};
use crate::shape::{Layer, Part, Shape, Tissue};
use crate::vector::Vec3;

/// From base to apex: to the left, forwards and down.
const AXIS: Vec3 = [0.66, -0.52, -0.54];

pub fn shapes() -> Vec<Shape> {
    let fill = |parts: Vec<Part>, tissue: Tissue| Shape::new(parts, vec![Layer::outer(0.0, tissue)]);
    let muscle = vec![
        oval_along([22.0, -24.0, 1312.0], AXIS, [62.0, 44.0, 46.0], SOLID.blend(10.0)),
        oval([8.0, 6.0, 1338.0], [34.0, 24.0, 28.0], SOLID.blend(10.0)),
        oval([-26.0, -14.0, 1318.0], [24.0, 28.0, 34.0], SOLID.blend(10.0)),
    ];
    let right = vec![
        oval_along([8.0, -42.0, 1304.0], [0.6, -0.3, -0.45], [42.0, 15.0, 27.0], SOLID),
        oval([-27.0, -14.0, 1318.0], [19.0, 23.0, 29.0], SOLID),
    ];
    let left = vec![
        oval_along([34.0, -24.0, 1304.0], AXIS, [38.0, 19.0, 20.0], SOLID),
        oval([8.0, 8.0, 1340.0], [29.0, 18.0, 22.0], SOLID),
    ];
    let trunk = [
        ([12.0, -50.0, 1338.0], 12.0),
        ([16.0, -40.0, 1358.0], 13.0),
        ([16.0, -16.0, 1376.0], 12.0),
        ([38.0, 8.0, 1364.0], 9.0),
    ];
    let right_branch =
        [([16.0, -14.0, 1375.0], 11.0), ([-10.0, -2.0, 1366.0], 9.5), ([-38.0, 8.0, 1362.0], 9.0)];
    let veins = both_sides(tube(&[([34.0, 4.0, 1336.0], 7.0), ([14.0, 8.0, 1338.0], 8.0)], SOLID));
    let upper_cava =
        [([-24.0, -20.0, 1452.0], 8.0), ([-25.0, -18.0, 1400.0], 10.0), ([-26.0, -14.0, 1345.0], 11.0)];
    let lower_cava = [
        ([-26.0, -8.0, 1300.0], 12.0),
        ([-24.0, 10.0, 1230.0], 12.0),
        ([-20.0, 14.0, 1150.0], 11.0),
        ([-17.0, 6.0, 1070.0], 10.0),
    ];
    vec![
        fill(muscle, MYOCARDIUM),
        fill(right, RIGHT_HEART_BLOOD),
        fill([tube(&trunk, SOLID), tube(&right_branch, SOLID)].concat(), RIGHT_HEART_BLOOD),
        fill(left, ARTERY),
        fill(veins, ARTERY),
        fill([tube(&upper_cava, SOLID), tube(&lower_cava, SOLID)].concat(), VEIN),
    ]
}
