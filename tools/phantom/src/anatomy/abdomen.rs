//! The abdomen: fat, liver, spleen, kidneys, stomach, bowels with gas, bladder.

use super::lungs::diaphragm;
use super::parts::{SOLID, both_sides, limb, loft, oval, oval_along, part, shell, tube};
use super::tissues::{
    AIR, BOWEL_FLUID, FAT, KIDNEY_CORTEX, KIDNEY_MEDULLA, LIVER, MUSCLE, ORGAN_WALL, SPLEEN, STOOL, VEIN,
    WATER,
};
use super::tree::{Girth, grow, scatter};
use crate::noise::Sequence;
use crate::shape::{Clip, Keep, Layer, Part, Shape, Tissue};
use crate::solid::{HalfSpace, Section, Solid};
use crate::vector::{Vec3, add, length, normalize, scale, sub};

/// The inside of the abdominal wall and of the pelvis.
const CAVITY: [Section; 8] = [
    Section::mid(862.0, 10.0, 34.0, 50.0, 50.0),
    Section::mid(900.0, 8.0, 56.0, 66.0, 66.0),
    Section::mid(950.0, 4.0, 84.0, 80.0, 66.0),
    Section::mid(1010.0, 0.0, 112.0, 90.0, 62.0),
    Section::mid(1075.0, -2.0, 124.0, 92.0, 60.0),
    Section::mid(1150.0, -2.0, 126.0, 90.0, 68.0),
    Section::mid(1230.0, 0.0, 127.0, 84.0, 74.0),
    Section::mid(1310.0, 0.0, 122.0, 82.0, 76.0),
];

fn cavity() -> Solid {
    Solid::Loft(loft(&CAVITY, 0.2))
}

/// A shape held between the abdominal wall and the diaphragm.
fn within(parts: Vec<Part>, layers: Vec<Layer>) -> Shape {
    let clip = |solid, gap_mm| Clip { solid, keep: Keep::Inside, gap_mm, shell_mm: 2.0 };
    Shape { parts, clips: vec![clip(cavity(), 2.0), clip(diaphragm(), 4.0)], layers }
}

pub fn shapes(seed: u64) -> Vec<Shape> {
    let fill = |tissue: Tissue| vec![Layer::outer(0.0, tissue)];
    let psoas = both_sides(tube(
        &[
            ([30.0, 38.0, 1165.0], 9.0),
            ([44.0, 34.0, 1080.0], 18.0),
            ([62.0, 18.0, 1000.0], 19.0),
            ([84.0, -22.0, 930.0], 14.0),
        ],
        SOLID,
    ));
    let mut shapes = vec![within(vec![part(cavity(), SOLID)], fill(FAT)), Shape::new(psoas, fill(MUSCLE))];
    shapes.push(within(
        vec![oval_along([98.0, 34.0, 1222.0], [0.3, -0.4, 0.8], [50.0, 34.0, 24.0], SOLID)],
        fill(SPLEEN),
    ));
    shapes.extend(stomach());
    shapes.extend(kidneys());
    let pancreas = tube(
        &[([-24.0, -14.0, 1138.0], 13.0), ([8.0, -26.0, 1152.0], 10.0), ([78.0, 22.0, 1186.0], 10.0)],
        SOLID,
    );
    shapes.push(Shape::new(pancreas, fill(ORGAN_WALL)));
    shapes.extend(bowels(seed));
    shapes.extend(liver(seed));
    shapes.extend(pelvic_organs());
    shapes
}

fn liver(seed: u64) -> Vec<Shape> {
    let body = vec![
        oval([-70.0, -4.0, 1226.0], [64.0, 84.0, 74.0], SOLID.blend(20.0)),
        oval([-84.0, 8.0, 1176.0], [42.0, 60.0, 46.0], SOLID.blend(20.0)),
        oval_along([6.0, -44.0, 1246.0], [1.0, -0.1, 0.18], [74.0, 38.0, 30.0], SOLID.blend(20.0)),
    ];
    let mut random = Sequence::new(seed, 3);
    let inside = |p: Vec3| {
        let q = sub(p, [-66.0, -6.0, 1220.0]);
        length([q[0] / 54.0, q[1] / 66.0, q[2] / 54.0]) < 1.0
    };
    let targets = scatter([-130.0, -90.0, 1150.0], [20.0, 90.0, 1290.0], 120, &mut random, inside);
    let girth = Girth { twig_mm: 1.1, trunk_mm: 6.5, join: SOLID };
    let portal = grow([-26.0, -8.0, 1188.0], targets, girth, &mut random);
    let gall_bladder = vec![limb([-48.0, -58.0, 1150.0], 15.0, [-40.0, -34.0, 1176.0], 8.0, SOLID)];
    vec![
        within(body, vec![Layer::outer(0.0, LIVER)]),
        within(portal, vec![Layer::outer(0.0, Tissue::plain(150.0))]),
        Shape::new(gall_bladder, vec![Layer::outer(0.0, ORGAN_WALL), Layer::outer(1.5, WATER)]),
    ]
}

fn stomach() -> Vec<Shape> {
    let bag = || {
        let mut parts = tube(
            &[
                ([58.0, 2.0, 1238.0], 38.0),
                ([62.0, -24.0, 1190.0], 34.0),
                ([38.0, -52.0, 1150.0], 24.0),
                ([0.0, -50.0, 1144.0], 15.0),
                ([-22.0, -40.0, 1150.0], 12.0),
            ],
            SOLID.blend(4.0),
        );
        parts.iter_mut().for_each(|part| part.shell_mm = 3.5);
        parts
    };
    let mut gas = within(bag(), vec![Layer::inner(0.0, AIR)]);
    // Gas gathers in front, for the patient lies on the back.
    gas.clips.push(Clip {
        solid: Solid::HalfSpace(HalfSpace::new([0.0, -34.0, 0.0], [0.0, 1.0, 0.0])),
        keep: Keep::Inside,
        gap_mm: 0.0,
        shell_mm: 0.0,
    });
    vec![within(bag(), vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, BOWEL_FLUID)]), gas]
}

fn kidneys() -> Vec<Shape> {
    let axis = [0.22, 0.12, -1.0];
    let kidney = |center: Vec3, radii: Vec3| oval_along(center, axis, radii, SOLID);
    let both = |radii: Vec3| {
        let left = kidney([66.0, 42.0, 1138.0], radii);
        // The right one lies lower, under the liver.
        let right = kidney([66.0, 42.0, 1122.0], radii).mirrored();
        vec![left, right]
    };
    let pelvis = |z: f32| limb([56.0, 34.0, z], 8.0, [46.0, 26.0, z - 14.0], 4.0, SOLID);
    vec![
        Shape::new(both([55.0, 25.0, 28.0]), vec![Layer::outer(0.0, KIDNEY_CORTEX)]),
        Shape::new(both([45.0, 15.0, 18.0]), vec![Layer::outer(0.0, KIDNEY_MEDULLA)]),
        Shape::new(vec![pelvis(1138.0), pelvis(1122.0).mirrored()], vec![Layer::outer(0.0, FAT)]),
    ]
}

fn bowels(seed: u64) -> Vec<Shape> {
    let mut shapes = Vec::new();
    let mut random = Sequence::new(seed, 4);
    // Small bowel: loops that wander about the middle, each painted over the one before.
    for _ in 0..9 {
        let center = [0.0, -34.0, 1046.0];
        let radii = [84.0, 42.0, 62.0];
        let mut at: Vec3 = std::array::from_fn(|axis| center[axis] + radii[axis] * random.between(-0.7, 0.7));
        let mut heading = normalize(std::array::from_fn(|_| random.between(-1.0, 1.0)));
        let mut points = Vec::new();
        for _ in 0..12 {
            points.push((at, random.between(10.0, 13.5)));
            let turn = std::array::from_fn(|_| random.between(-0.9, 0.9));
            let offset: Vec3 = std::array::from_fn(|axis| (center[axis] - at[axis]) / radii[axis]);
            let pull = scale(offset, length(offset).powi(3) * 1.2);
            heading = normalize(add(add(heading, turn), pull));
            at = add(at, scale(heading, 24.0));
        }
        let content = if random.between(0.0, 1.0) < 0.2 { AIR } else { BOWEL_FLUID };
        let layers = vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, content)];
        shapes.push(within(tube(&points, shell(2.4)), layers));
    }
    let mut colon = |path: &[Vec3], radius: f32, content: Tissue| {
        let mut pouches: Vec<(Vec3, f32)> = Vec::new();
        for pair in path.windows(2) {
            let count = (length(sub(pair[1], pair[0])) / 17.0).ceil().max(1.0) as usize;
            for index in 0..count {
                let at = add(pair[0], scale(sub(pair[1], pair[0]), index as f32 / count as f32));
                // Pouches, as the colon has.
                pouches.push((at, radius * random.between(0.95, 1.12)));
                let neck = add(at, scale(sub(pair[1], pair[0]), 0.5 / count as f32));
                pouches.push((neck, radius * 0.78));
            }
        }
        let layers = vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, content)];
        shapes.push(within(tube(&pouches, shell(2.2)), layers));
    };
    colon(&[[-96.0, 6.0, 985.0], [-103.0, 14.0, 1050.0], [-98.0, 10.0, 1112.0]], 25.0, STOOL);
    colon(&[[104.0, 28.0, 1170.0], [106.0, 30.0, 1080.0], [98.0, 12.0, 1010.0]], 18.0, STOOL);
    colon(&[[98.0, 12.0, 1010.0], [66.0, -22.0, 985.0], [36.0, 0.0, 955.0], [4.0, 44.0, 950.0]], 15.0, AIR);
    colon(
        &[
            [-98.0, -6.0, 1112.0],
            [-84.0, -52.0, 1118.0],
            [-40.0, -72.0, 1098.0],
            [10.0, -74.0, 1092.0],
            [60.0, -62.0, 1112.0],
            [92.0, -20.0, 1150.0],
            [104.0, 20.0, 1175.0],
        ],
        20.0,
        AIR,
    );
    shapes
}

fn pelvic_organs() -> Vec<Shape> {
    let rectum = tube(
        &[([4.0, 44.0, 950.0], 14.0), ([0.0, 58.0, 915.0], 17.0), ([0.0, 42.0, 872.0], 11.0)],
        shell(3.5),
    );
    let bladder = vec![oval([2.0, -30.0, 912.0], [42.0, 34.0, 30.0], shell(3.0))];
    let prostate = vec![oval([0.0, -22.0, 876.0], [20.0, 16.0, 16.0], SOLID)];
    let fill = |tissue: Tissue| vec![Layer::outer(0.0, tissue)];
    vec![
        Shape::new(rectum, vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, STOOL)]),
        Shape::new(prostate, fill(ORGAN_WALL)),
        Shape::new(bladder, vec![Layer::outer(0.0, ORGAN_WALL), Layer::inner(0.0, WATER)]),
        Shape::new(both_sides(iliac_veins()), fill(VEIN)),
    ]
}

fn iliac_veins() -> Vec<Part> {
    tube(
        &[
            ([-14.0, 8.0, 1068.0], 8.0),
            ([-40.0, 24.0, 1010.0], 8.0),
            ([-62.0, -20.0, 950.0], 7.0),
            ([-72.0, -48.0, 905.0], 7.0),
            ([-80.0, -30.0, 830.0], 6.0),
        ],
        SOLID,
    )
}
