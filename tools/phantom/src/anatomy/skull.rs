//! The skull with brain, face, sinuses, teeth and jaw.

use super::parts::{Join, SOLID, ball, both_sides, limb, oval, oval_along, oval_tube, plate, shell, tube};
use super::tissues::{AIR, BRAIN, CORTEX, FACE_BONE, FAT, FILLING, MUSCLE, SPONGY_BONE, TOOTH, WATER};
use crate::shape::{Clip, Keep, Layer, Part, Shape};
use crate::solid::{HalfSpace, Solid};
use crate::vector::Vec3;

/// The middle of the brain case and its outer radii.
pub const CRANIUM: (Vec3, Vec3) = ([0.0, 4.0, 1695.0], [70.5, 90.0, 85.0]);

pub fn shapes() -> Vec<Shape> {
    let mut shapes = vec![face(), cranium()];
    shapes.extend(brain());
    shapes.push(floor());
    shapes.push(stem());
    shapes.push(jaw());
    shapes.extend(cavities());
    shapes.extend(teeth());
    shapes
}

/// The skull's base, from the roof of the eye sockets down to the back of the head.
fn base(gap_mm: f32) -> Vec<Clip> {
    let plane = |point, normal| Clip {
        solid: Solid::HalfSpace(HalfSpace::new(point, normal)),
        keep: Keep::Inside,
        gap_mm,
        shell_mm: 5.0,
    };
    vec![plane([0.0, -70.0, 1690.0], [0.0, -0.6, -1.0]), plane([0.0, 30.0, 1626.0], [0.0, 0.12, -1.0])]
}

fn cranium() -> Shape {
    let (center, radii) = CRANIUM;
    let layers = vec![
        Layer::outer(0.0, CORTEX),
        Layer::outer(2.0, SPONGY_BONE),
        Layer::inner(-2.0, CORTEX),
        Layer::inner(0.0, WATER),
    ];
    let mut shape = Shape::new(vec![oval(center, radii, shell(6.5))], layers);
    shape.clips = base(0.0);
    shape
}

fn brain() -> Vec<Shape> {
    let (center, radii) = CRANIUM;
    let inset = radii.map(|radius| radius - 9.5);
    let mut brain = Shape::new(vec![oval(center, inset, SOLID)], vec![Layer::outer(0.0, BRAIN)]);
    brain.clips = base(8.0);
    let half_falx =
        Shape::new(vec![oval([0.0, 4.0, 1725.0], [1.5, 74.0, 46.0], SOLID)], vec![Layer::outer(0.0, WATER)]);
    let ventricle = [
        ([10.0, -30.0, 1712.0], 5.0),
        ([12.0, 0.0, 1722.0], 6.0),
        ([18.0, 32.0, 1715.0], 7.0),
        ([26.0, 22.0, 1695.0], 4.0),
    ];
    let ventricles = Shape::new(both_sides(tube(&ventricle, SOLID)), vec![Layer::outer(0.0, WATER)]);
    vec![brain, half_falx, ventricles]
}

fn stem() -> Shape {
    let line = [([0.0, 2.0, 1682.0], 14.0), ([0.0, 12.0, 1650.0], 11.0), ([0.0, 22.0, 1622.0], 7.0)];
    Shape::new(tube(&line, SOLID), vec![Layer::outer(-3.0, WATER), Layer::outer(0.0, BRAIN)])
}

fn face() -> Shape {
    const BONE: Join = shell(2.2).blend(7.0);
    let mut parts = vec![
        // The block that eyes, nose and sinuses are hollowed from.
        oval([0.0, -48.0, 1664.0], [51.0, 38.0, 27.0], BONE),
        oval([0.0, -54.0, 1630.0], [36.0, 29.0, 22.0], BONE),
        oval([0.0, -84.0, 1689.0], [20.0, 8.0, 9.0], BONE),
    ];
    let mut left = vec![
        // Brow and the rim of the eye socket.
        limb([8.0, -86.0, 1689.0], 6.0, [44.0, -75.0, 1690.0], 6.0, BONE),
        limb([49.0, -69.0, 1688.0], 5.5, [53.0, -60.0, 1654.0], 5.5, BONE),
        limb([53.0, -62.0, 1650.0], 6.0, [20.0, -80.0, 1648.0], 5.0, BONE),
        // Nose and upper jaw.
        limb([3.5, -88.0, 1686.0], 4.0, [4.0, -98.0, 1661.0], 3.2, BONE.blend(4.0)),
        limb([13.0, -84.0, 1684.0], 5.0, [17.0, -82.0, 1632.0], 5.5, BONE),
        oval([46.0, -62.0, 1642.0], [13.0, 12.0, 11.0], BONE),
        limb([42.0, -58.0, 1638.0], 9.0, [26.0, -70.0, 1618.0], 9.0, BONE),
        limb([20.0, -40.0, 1640.0], 5.0, [20.0, -34.0, 1612.0], 3.5, BONE),
    ];
    let cheek_arch = [
        ([54.0, -56.0, 1642.0], 5.0),
        ([60.0, -38.0, 1644.0], 3.3),
        ([62.0, -16.0, 1645.0], 3.3),
        ([60.0, 2.0, 1647.0], 3.6),
    ];
    left.extend(oval_tube(&cheek_arch, 1.4, BONE.blend(3.0)));
    left.extend(arch(1614.0, 7.0).into_iter().map(|(p, r)| ball(p, r, BONE)));
    parts.extend(both_sides(left));
    // Palate.
    parts.push(oval([0.0, -52.0, 1620.0], [26.0, 28.0, 4.0], BONE));
    Shape::new(parts, vec![Layer::outer(0.0, CORTEX), Layer::inner(0.0, FACE_BONE)])
}

/// The bones that rise from the skull's base into the brain, and those that hang from it.
fn floor() -> Shape {
    const BONE: Join = shell(2.5).blend(7.0);
    let mut parts = both_sides(vec![
        // Around the inner ear; behind the outer ear; behind the eye.
        oval_along([45.0, 2.0, 1642.0], [0.8, -0.5, 0.0], [24.0, 11.0, 10.0], BONE),
        oval([55.0, 22.0, 1630.0], [10.0, 13.0, 18.0], BONE),
        oval_along([34.0, -36.0, 1668.0], [0.9, 0.4, 0.1], [20.0, 5.0, 14.0], BONE),
    ]);
    parts.push(oval([0.0, -18.0, 1656.0], [24.0, 20.0, 13.0], BONE));
    parts.push(limb([0.0, -6.0, 1650.0], 9.0, [0.0, 4.0, 1632.0], 7.0, BONE));
    Shape::new(parts, vec![Layer::outer(0.0, CORTEX), Layer::inner(0.0, FACE_BONE)])
}

/// The left half of a row of teeth, from the middle backwards, at a height.
fn arch(z: f32, radius: f32) -> Vec<(Vec3, f32)> {
    (0..8)
        .map(|tooth| {
            let angle = (tooth as f32 + 0.5) / 8.0 * 1.45;
            ([29.0 * angle.sin(), -42.0 - 43.0 * angle.cos(), z], radius)
        })
        .collect()
}

fn jaw() -> Shape {
    let body = [
        ([0.0, -80.0, 1575.0], 6.0),
        ([18.0, -73.0, 1576.0], 6.0),
        ([33.0, -50.0, 1579.0], 5.5),
        ([45.0, -14.0, 1590.0], 5.0),
    ];
    let branch = [([45.0, -16.0, 1588.0], 4.5), ([50.0, -9.0, 1615.0], 4.2), ([53.0, -3.0, 1640.0], 4.2)];
    let coronoid = limb([49.0, -16.0, 1612.0], 4.5, [52.0, -28.0, 1640.0], 3.0, shell(1.5));
    let mut parts = oval_tube(&body, 1.9, shell(2.2));
    parts.extend(oval_tube(&branch, 1.0, shell(1.8)));
    let (front, back) =
        (([46.0, -22.0, 1584.0], [51.0, -24.0, 1628.0]), ([46.0, -5.0, 1590.0], [52.0, -3.0, 1636.0]));
    parts.push(plate([front.0, front.1, back.1], 3.6, shell(1.6)));
    parts.push(plate([front.0, back.1, back.0], 3.6, shell(1.6)));
    parts.extend(arch(1584.0, 5.0).into_iter().map(|(p, r)| ball(p, r, shell(1.8))));
    parts.push(coronoid);
    parts.push(limb([48.0, -2.0, 1644.0], 4.5, [59.0, -3.0, 1644.0], 4.5, shell(1.5)));
    parts.push(limb([0.0, -82.0, 1571.0], 5.0, [13.0, -78.0, 1571.0], 5.0, shell(2.0)));
    Shape::new(both_sides(parts), vec![Layer::outer(0.0, CORTEX), Layer::inner(0.0, SPONGY_BONE)])
}

fn cavities() -> Vec<Shape> {
    let orbit = both_sides(vec![
        oval_along([30.0, -61.0, 1667.5], [0.35, 1.0, 0.0], [25.0, 16.5, 15.5], SOLID),
        limb([28.0, -56.0, 1667.0], 9.0, [18.0, -34.0, 1666.0], 4.0, SOLID),
    ]);
    let eye = both_sides(vec![ball([31.0, -74.0, 1668.0], 12.2, SOLID)]);
    let lens = both_sides(vec![oval([31.0, -82.0, 1668.0], [4.5, 2.2, 4.5], SOLID)]);
    let sinuses = [
        both_sides(vec![
            oval([31.0, -54.0, 1632.0], [10.0, 13.0, 13.0], SOLID),
            oval([11.0, -81.0, 1693.0], [9.0, 2.8, 8.0], SOLID),
            oval([8.0, -58.0, 1668.0], [5.0, 18.0, 10.0], SOLID),
            oval([54.0, 20.0, 1636.0], [4.0, 7.0, 8.0], SOLID),
        ]),
        vec![oval([4.0, -18.0, 1662.0], [13.0, 11.0, 8.0], SOLID)],
    ]
    .concat();
    let nose = both_sides(vec![
        oval([6.5, -68.0, 1641.0], [5.5, 20.0, 17.0], SOLID),
        limb([5.0, -84.0, 1636.0], 3.5, [6.0, -101.0, 1628.0], 2.8, SOLID),
        limb([5.0, -60.0, 1634.0], 6.0, [4.0, -22.0, 1628.0], 8.0, SOLID),
    ]);
    let opening =
        both_sides(vec![oval_along([6.0, -82.0, 1641.0], [0.2, 0.0, 1.0], [17.0, 12.0, 7.0], SOLID)]);
    let tongue = vec![oval([0.0, -46.0, 1595.0], [23.0, 34.0, 18.0], SOLID)];
    let throat = tube(
        &[
            ([0.0, -22.0, 1630.0], 9.0),
            ([0.0, -14.0, 1605.0], 8.0),
            ([0.0, -13.0, 1575.0], 8.0),
            ([0.0, -16.0, 1545.0], 6.5),
            ([0.0, -18.0, 1520.0], 8.0),
        ],
        SOLID,
    );
    let one = |parts, tissue| Shape::new(parts, vec![Layer::outer(0.0, tissue)]);
    vec![
        one(orbit, FAT),
        one(eye, WATER),
        one(lens, MUSCLE),
        one(opening, MUSCLE),
        one(tongue, MUSCLE),
        one(sinuses, AIR),
        one(nose, AIR),
        one(throat, AIR),
    ]
}

fn teeth() -> Vec<Shape> {
    let tooth = |low: Vec3, high: Vec3, width: f32| limb(low, width, high, width * 0.9, SOLID);
    let row = |z: f32, length: f32| -> Vec<Part> {
        let teeth = arch(z, 0.0).into_iter().enumerate();
        both_sides(
            teeth
                .map(|(index, (at, _))| {
                    tooth(at, [at[0], at[1], at[2] + length], if index < 3 { 3.3 } else { 4.3 })
                })
                .collect(),
        )
    };
    // Fillings on the patient's left only.
    let fillings = vec![
        ball([27.0, -60.0, 1600.0], 2.6, SOLID),
        ball([28.5, -51.0, 1600.0], 2.4, SOLID),
        ball([28.0, -55.0, 1595.0], 2.2, SOLID),
    ];
    vec![
        Shape::new([row(1600.0, 11.0), row(1586.0, 10.5)].concat(), vec![Layer::outer(0.0, TOOTH)]),
        Shape::new(fillings, vec![Layer::outer(0.0, FILLING)]),
    ]
}
