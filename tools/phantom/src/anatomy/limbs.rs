//! The bones of arms and legs.

use super::parts::{Join, SOLID, ball, both_sides, limb, oval, plate, shell, tube};
use super::pelvis::HIP;
use super::tissues::{CORTEX, FAT, MARROW, SHAFT_CORTEX, SPONGY_BONE};
use crate::shape::{Layer, Part, Shape, Tissue};
use crate::vector::{Vec3, add};

/// The end of a long bone: a thin cortex, softly joined.
const END: Join = shell(1.6).blend(8.0);
const SMALL: Join = shell(1.2).blend(2.0);

pub fn shapes() -> Vec<Shape> {
    let bone = |parts: Vec<Part>, cortex: Tissue| {
        Shape::new(both_sides(parts), vec![Layer::outer(0.0, cortex), Layer::inner(0.0, SPONGY_BONE)])
    };
    // The marrow of the shafts: their middle lines again, thinner by the cortex, and short of the spongy ends.
    let marrow = [
        (&HUMERUS[..3], 4.5),
        (&ULNA[1..4], 3.0),
        (&RADIUS[1..4], 3.0),
        (&FEMUR[..], 6.5),
        (&TIBIA[..4], 4.5),
        (&FIBULA[1..4], 2.8),
    ];
    let marrow = marrow.into_iter().flat_map(|(shaft, cortex_mm)| {
        let core: Vec<_> = shaft.iter().map(|&(at, radius)| (at, radius - cortex_mm)).collect();
        tube(&core, SOLID)
    });
    let marrow = both_sides(marrow.collect());
    vec![
        septa(),
        bone(humerus(), SHAFT_CORTEX),
        bone(forearm(), SHAFT_CORTEX),
        bone(hand(), CORTEX),
        bone(femur(), SHAFT_CORTEX),
        bone(shin(), SHAFT_CORTEX),
        bone(foot(), CORTEX),
        Shape::new(marrow, vec![Layer::outer(0.0, MARROW)]),
    ]
}

/// Sheets of fat between the muscles of thigh, calf and upper arm.
fn septa() -> Shape {
    let sheets = |low: Vec3, high: Vec3, reach: [f32; 2], angles: &[f32]| -> Vec<Part> {
        let sheet = |angle: &f32| {
            let out = |point: Vec3, reach: f32| add(point, [reach * angle.sin(), -reach * angle.cos(), 0.0]);
            let (low_out, high_out) = (out(low, reach[0]), out(high, reach[1]));
            let join = SOLID.blend(1.5);
            [plate([low, high, low_out], 0.9, join), plate([high, high_out, low_out], 0.9, join)]
        };
        angles.iter().flat_map(sheet).collect()
    };
    let thigh = sheets([108.0, -2.0, 600.0], [118.0, -2.0, 845.0], [50.0, 68.0], &[0.5, 2.1, 3.6, 4.9]);
    let calf = sheets([98.0, 8.0, 210.0], [98.0, 8.0, 430.0], [26.0, 40.0], &[0.8, 2.2, 3.3, 4.4]);
    let arm = sheets([189.0, 12.0, 1170.0], [184.0, 10.0, 1340.0], [30.0, 34.0], &[1.4, 4.8]);
    Shape::new(both_sides([thigh, calf, arm].concat()), vec![Layer::outer(0.0, FAT)])
}

const HUMERUS: [(Vec3, f32); 4] = [
    ([178.0, 10.0, 1408.0], 14.0),
    ([182.0, 10.0, 1350.0], 11.0),
    ([185.0, 12.0, 1250.0], 10.0),
    ([190.0, 14.0, 1165.0], 10.5),
];
const ULNA: [(Vec3, f32); 5] = [
    ([186.0, 30.0, 1142.0], 8.0),
    ([187.0, 24.0, 1112.0], 9.0),
    ([190.0, 18.0, 1060.0], 6.5),
    ([199.0, 10.0, 960.0], 5.5),
    ([203.0, 6.0, 885.0], 5.5),
];
const RADIUS: [(Vec3, f32); 5] = [
    ([202.0, 6.0, 1106.0], 8.5),
    ([200.0, 2.0, 1075.0], 6.5),
    ([206.0, -12.0, 990.0], 6.5),
    ([207.0, -22.0, 910.0], 7.5),
    ([206.0, -24.0, 880.0], 11.0),
];
const FEMUR: [(Vec3, f32); 4] = [
    ([134.0, 4.0, 885.0], 17.0),
    ([129.0, -2.0, 800.0], 14.0),
    ([116.0, -8.0, 680.0], 13.5),
    ([103.0, -2.0, 560.0], 16.0),
];
const TIBIA: [(Vec3, f32); 5] = [
    ([97.0, 4.0, 448.0], 19.0),
    ([93.0, -6.0, 380.0], 14.0),
    ([92.0, 0.0, 250.0], 12.0),
    ([93.0, 8.0, 150.0], 12.5),
    ([94.0, 14.0, 116.0], 17.0),
];
const FIBULA: [(Vec3, f32); 5] = [
    ([130.0, 22.0, 452.0], 9.0),
    ([130.0, 24.0, 410.0], 6.0),
    ([126.0, 22.0, 260.0], 5.8),
    ([122.0, 24.0, 130.0], 6.0),
    ([122.0, 24.0, 88.0], 8.5),
];

fn humerus() -> Vec<Part> {
    let mut parts = tube(&HUMERUS, shell(4.5));
    parts.extend([
        ball([171.0, 10.0, 1430.0], 23.0, END),
        oval([190.0, 6.0, 1426.0], [9.0, 12.0, 18.0], END),
        limb([190.0, 14.0, 1165.0], 10.5, [191.0, 15.0, 1138.0], 9.0, END),
        limb([173.0, 18.0, 1136.0], 7.0, [210.0, 16.0, 1136.0], 7.0, END),
        limb([179.0, 12.0, 1128.0], 8.5, [203.0, 10.0, 1128.0], 9.0, END),
    ]);
    parts
}

fn forearm() -> Vec<Part> {
    let mut parts = [tube(&ULNA, shell(2.8)), tube(&RADIUS, shell(2.8))].concat();
    parts.push(limb([202.0, 6.0, 1113.0], 10.0, [202.0, 6.0, 1108.0], 9.5, END.blend(2.0)));
    parts.push(limb([205.0, -30.0, 876.0], 8.0, [206.0, -14.0, 876.0], 8.0, END.blend(2.0)));
    parts
}

fn hand() -> Vec<Part> {
    let mut parts = Vec::new();
    for (row, z) in [860.0, 847.0].into_iter().enumerate() {
        for column in 0..4 {
            let y = -34.0 + 11.5 * column as f32 + row as f32 * 1.5;
            parts.push(oval([206.0, y, z], [6.5, 5.9, 6.3], shell(1.2)));
        }
    }
    for (finger, [length, y]) in
        [[72.0, -40.0], [82.0, -20.5], [77.0, -1.0], [60.0, 17.0]].into_iter().enumerate()
    {
        let spread = (finger as f32 - 1.5) * 2.0;
        let knuckle_z = 782.0 + if finger == 3 { 6.0 } else { 0.0 };
        let root = [206.5, -31.0 + 10.5 * finger as f32, 838.0];
        let knuckle = [208.0, y, knuckle_z + 4.0];
        parts.push(limb(root, 4.4, knuckle, 4.2, SMALL));
        parts.push(ball(knuckle, 6.0, SMALL.blend(4.0)));
        let at = |share: f32| [208.0 - 11.0 * share * share, y + spread * share, knuckle_z - length * share];
        for (from, to, radius) in [(0.04, 0.47, 4.2), (0.53, 0.75, 3.6), (0.80, 0.95, 3.0)] {
            parts.push(limb(at(from), radius + 0.6, at(to), radius - 0.3, SMALL));
            parts.push(ball(at(to), radius + 0.4, SMALL));
        }
    }
    parts.push(limb([203.0, -42.0, 843.0], 5.0, [199.0, -60.0, 812.0], 4.6, SMALL));
    parts.push(limb([198.6, -62.0, 807.0], 4.6, [196.0, -67.0, 785.0], 4.0, SMALL));
    parts.push(limb([195.6, -68.0, 780.0], 3.8, [194.2, -70.0, 766.0], 2.8, SMALL));
    parts
}

fn femur() -> Vec<Part> {
    let mut parts = tube(&FEMUR, shell(6.5));
    parts.extend([
        ball(HIP, 23.5, END),
        limb(HIP, 16.0, [130.0, 4.0, 896.0], 17.0, END),
        oval([144.0, 12.0, 906.0], [13.0, 18.0, 22.0], END),
        ball([118.0, 20.0, 866.0], 11.0, END),
        limb([103.0, -2.0, 560.0], 16.0, [98.0, 2.0, 518.0], 24.0, END.blend(12.0)),
        oval([75.0, 12.0, 503.0], [17.0, 28.0, 20.0], END),
        oval([119.0, 12.0, 504.0], [17.0, 28.0, 20.0], END),
        // Kneecap.
        oval([97.0, -41.0, 512.0], [20.0, 9.0, 22.0], END.blend(0.0)),
    ]);
    parts
}

fn shin() -> Vec<Part> {
    let mut parts = [tube(&TIBIA, shell(4.5)), tube(&FIBULA, shell(2.6))].concat();
    parts.extend([
        oval([97.0, 8.0, 466.0], [39.0, 25.0, 13.0], END),
        ball([97.0, -20.0, 440.0], 10.0, END),
        ball([76.0, 12.0, 99.0], 8.0, END),
    ]);
    parts
}

fn foot() -> Vec<Part> {
    let bone = SMALL.blend(4.0);
    let mut parts = vec![
        oval([97.0, 12.0, 88.0], [20.0, 24.0, 13.0], bone),
        limb([99.0, 46.0, 62.0], 17.0, [106.0, 6.0, 62.0], 13.0, bone),
        oval([86.0, -20.0, 70.0], [14.0, 9.0, 14.0], bone),
        oval([115.0, -14.0, 56.0], [12.0, 13.0, 12.0], bone),
    ];
    for column in 0..3 {
        parts.push(oval([81.0 + 12.0 * column as f32, -36.0, 62.0 - column as f32], [6.5, 9.0, 9.0], SMALL));
    }
    for (toe, [x, y]) in [[83.0, -112.0], [100.0, -110.0], [113.0, -104.0], [124.0, -96.0], [134.0, -86.0]]
        .into_iter()
        .enumerate()
    {
        let toe = toe as f32;
        let radius = if toe == 0.0 { 6.0 } else { 4.0 };
        let (root, knuckle) = ([82.0 + 10.0 * toe, -44.0 + 4.0 * toe, 58.0 - 3.0 * toe], [x, y + 32.0, 31.0]);
        parts.push(limb(root, radius, knuckle, radius, SMALL));
        parts.push(ball(knuckle, radius + 2.0, bone));
        parts.push(limb([x, y + 27.0, 29.0], radius * 0.85, [x, y + 12.0, 25.0], radius * 0.7, SMALL));
        parts.push(limb([x, y + 8.0, 24.0], radius * 0.7, [x, y - 1.0, 21.0], radius * 0.5, SMALL));
    }
    parts
}
