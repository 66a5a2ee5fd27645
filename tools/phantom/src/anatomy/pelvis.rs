//! The hip bones with their sockets.

use super::parts::{SOLID, ball, both_sides, limb, oval, plate, shell, tube};
use super::tissues::{CARTILAGE, CORTEX, MUSCLE, SPONGY_BONE};
use crate::shape::{Layer, Part, Shape};
use crate::vector::Vec3;

/// The middle of the left hip joint.
pub const HIP: Vec3 = [88.0, -2.0, 928.0];

pub fn shapes() -> Vec<Shape> {
    let bone = vec![Layer::outer(0.0, CORTEX), Layer::inner(0.0, SPONGY_BONE)];
    let joint = both_sides(vec![ball(HIP, 27.5, SOLID), limb(HIP, 25.0, [125.0, -8.0, 915.0], 25.0, SOLID)]);
    let symphysis = vec![oval([0.0, -66.0, 888.0], [6.0, 8.0, 17.0], SOLID)];
    vec![
        Shape::new(symphysis, vec![Layer::outer(0.0, CARTILAGE)]),
        Shape::new(both_sides(hip_bone()), bone),
        Shape::new(joint, vec![Layer::outer(0.0, MUSCLE)]),
    ]
}

fn hip_bone() -> Vec<Part> {
    let wing = shell(1.3);
    let rod = shell(2.0).blend(5.0);
    // The crest from back to front, the middle of the wing, and the line where it leaves the pelvic ring.
    const CREST: [Vec3; 6] = [
        [40.0, 88.0, 992.0],
        [66.0, 76.0, 1046.0],
        [104.0, 42.0, 1080.0],
        [130.0, 4.0, 1084.0],
        [137.0, -32.0, 1062.0],
        [126.0, -62.0, 1014.0],
    ];
    const MIDDLE: [Vec3; 6] = [
        [42.0, 76.0, 972.0],
        [64.0, 60.0, 1006.0],
        [90.0, 36.0, 1022.0],
        [110.0, 6.0, 1024.0],
        [122.0, -26.0, 1010.0],
        [122.0, -52.0, 985.0],
    ];
    const RING: [Vec3; 6] = [
        [46.0, 66.0, 958.0],
        [64.0, 48.0, 962.0],
        [80.0, 26.0, 962.0],
        [92.0, 2.0, 964.0],
        [100.0, -20.0, 960.0],
        [102.0, -38.0, 955.0],
    ];
    let mut parts = Vec::new();
    for strip in [[&CREST, &MIDDLE], [&MIDDLE, &RING]] {
        for index in 0..5 {
            let [[a, b], [c, d]] = strip.map(|line| [line[index], line[index + 1]]);
            parts.push(plate([a, b, c], 2.4, wing));
            parts.push(plate([b, d, c], 2.4, wing));
        }
    }
    parts.extend(tube(&CREST.map(|point| (point, 5.2)), shell(1.6)));
    parts.extend(tube(&RING.map(|point| (point, 7.5)), rod));
    parts.push(limb(CREST[5], 6.0, RING[5], 7.5, rod));
    parts.push(limb(CREST[0], 7.0, RING[0], 8.0, rod));
    // Around the joint.
    parts.push(oval([80.0, 0.0, 932.0], [28.0, 33.0, 34.0], shell(2.5).blend(8.0)));
    // Pubis, ischium, and the ring that they close.
    parts.extend(tube(
        &[([76.0, -26.0, 926.0], 10.0), ([48.0, -50.0, 912.0], 8.0), ([16.0, -64.0, 898.0], 9.0)],
        rod,
    ));
    parts.push(limb([9.0, -65.0, 898.0], 8.0, [9.0, -62.0, 878.0], 7.0, rod));
    parts.extend(tube(
        &[([11.0, -60.0, 876.0], 6.5), ([32.0, -42.0, 852.0], 6.0), ([50.0, -8.0, 834.0], 9.0)],
        rod,
    ));
    parts.extend(tube(
        &[([76.0, 26.0, 918.0], 15.0), ([66.0, 30.0, 876.0], 13.0), ([56.0, 14.0, 836.0], 14.0)],
        rod,
    ));
    parts.push(limb([54.0, 2.0, 834.0], 12.0, [56.0, 20.0, 842.0], 13.0, rod));
    parts.push(limb([74.0, 36.0, 930.0], 8.0, [58.0, 54.0, 946.0], 8.0, rod));
    parts
}
