//! The rib cage: ribs, their cartilage, breastbone, collar bones and shoulder blades.

use std::f32::consts::PI;

use super::parts::{SOLID, ball, both_sides, limb, oval, oval_tube, plate, shell, tube};
use super::spine;
use super::tissues::{CARTILAGE, CORTEX, SPONGY_BONE};
use crate::shape::{Layer, Part, Shape};
use crate::solid::Section;
use crate::vector::{Vec3, add};

/// The surface in which the ribs lie.
pub const CAGE: [Section; 9] = [
    Section::mid(1060.0, 4.0, 118.0, 84.0, 64.0),
    Section::mid(1110.0, 3.0, 128.0, 90.0, 70.0),
    Section::mid(1160.0, 2.0, 134.0, 92.0, 76.0),
    Section::mid(1230.0, 0.0, 137.0, 93.0, 83.0),
    Section::mid(1300.0, 0.0, 132.0, 90.0, 85.0),
    Section::mid(1370.0, 4.0, 117.0, 80.0, 78.0),
    Section::mid(1420.0, 12.0, 94.0, 68.0, 62.0),
    Section::mid(1460.0, 18.0, 66.0, 52.0, 46.0),
    Section::mid(1500.0, 24.0, 36.0, 30.0, 26.0),
];

/// A rib of the left side.
struct Rib {
    /// Its middle line from the spine forwards.
    bone: Vec<Vec3>,
    cartilage: Vec<Vec3>,
    thickness: f32,
}

pub fn shapes() -> Vec<Shape> {
    let (mut bones, mut cartilage) = (Vec::new(), Vec::new());
    for rib in ribs() {
        let with = |radius: f32| move |&point: &Vec3| (point, radius);
        let bone: Vec<_> = rib.bone.iter().map(with(rib.thickness)).collect();
        bones.extend(oval_tube(&bone, 1.75, shell(1.5)));
        let gristle: Vec<_> = rib.cartilage.iter().map(with(rib.thickness + 0.6)).collect();
        cartilage.extend(oval_tube(&gristle, 1.4, SOLID));
    }
    bones.extend(shoulder());
    let sternum = sternum();
    let bone_layers = || vec![Layer::outer(0.0, CORTEX), Layer::inner(0.0, SPONGY_BONE)];
    vec![
        Shape::new(both_sides(cartilage), vec![Layer::outer(0.0, CARTILAGE)]),
        Shape::new(both_sides(bones), bone_layers()),
        Shape::new(sternum, bone_layers()),
    ]
}

/// The point of the cage at an angle from straight back (0) over left (π/2) to straight ahead (π).
fn on_cage(z: f32, angle: f32) -> Vec3 {
    let height = z.clamp(CAGE[0].z, CAGE[CAGE.len() - 1].z);
    let above = CAGE.iter().position(|section| section.z >= height).unwrap_or(1).max(1);
    let (low, high) = (&CAGE[above - 1], &CAGE[above]);
    let t = (height - low.z) / (high.z - low.z);
    let mix = |value: fn(&Section) -> f32| value(low) + (value(high) - value(low)) * t;
    let depth = if angle < PI / 2.0 { mix(|s| s.back) } else { mix(|s| s.front) };
    [mix(|s| s.half_width) * angle.sin(), mix(|s| s.center[1]) + depth * angle.cos(), z]
}

fn ribs() -> Vec<Rib> {
    const STEPS: usize = 11;
    /// How far each rib falls from the spine to the end of its bone, and the angle of that end.
    const FALL_MM: [f32; 12] = [34.0, 52.0, 66.0, 78.0, 88.0, 96.0, 102.0, 104.0, 100.0, 88.0, 62.0, 38.0];
    const END: [f32; 12] = [0.80, 0.80, 0.80, 0.80, 0.79, 0.78, 0.75, 0.71, 0.67, 0.62, 0.50, 0.34];
    /// Where the cartilage of the upper ten ends: on the breastbone, then on the cartilage above.
    const SEAT_MM: [f32; 10] =
        [1438.0, 1418.0, 1394.0, 1371.0, 1349.0, 1332.0, 1318.0, 1290.0, 1258.0, 1222.0];
    let vertebrae = spine::vertebrae();
    let rib = |index: usize| {
        let vertebra = &vertebrae[7 + index];
        let start = add(vertebra.center, [vertebra.radii[1] - 1.0, vertebra.radii[0] * 0.5, 5.0]);
        let first_angle = 0.28;
        let last_angle = END[index] * PI;
        let point = |step: usize| {
            let t = step as f32 / STEPS as f32;
            let angle = first_angle + (last_angle - first_angle) * t;
            // It leaves the spine level, falls fastest at the side, and flattens towards its end.
            let fall = FALL_MM[index] * (0.75 * t + 0.25 * t * t * (3.0 - 2.0 * t));
            on_cage(start[2] - 4.0 - fall, angle)
        };
        let mut bone = vec![start];
        bone.extend((0..=STEPS).map(point));
        let end = bone[bone.len() - 1];
        let cartilage = match SEAT_MM.get(index) {
            None => Vec::new(),
            Some(&seat) => {
                let angle = if index < 7 { 0.955 } else { 0.94 - 0.055 * (index - 6) as f32 } * PI;
                let middle = on_cage(end[2] * 0.62 + seat * 0.38 - 5.0, 0.45 * last_angle + 0.55 * angle);
                vec![end, middle, on_cage(seat, angle)]
            }
        };
        Rib { bone, cartilage, thickness: if index == 0 { 4.4 } else { 3.7 } }
    };
    (0..12).map(rib).collect()
}

/// The front of the cage in the midplane.
fn front(z: f32) -> Vec3 {
    add(on_cage(z, PI), [0.0, -1.0, 0.0])
}

fn sternum() -> Vec<Part> {
    let bone = shell(1.3).blend(6.0);
    let mut parts = Vec::new();
    for (from, to, half_width) in [(1450.0, 1415.0, 22.0), (1406.0, 1360.0, 13.0), (1360.0, 1316.0, 15.0)] {
        let corner = |z: f32, x: f32| add(front(z), [x, 0.0, 0.0]);
        let narrow = half_width * if from > 1440.0 { 0.62 } else { 1.05 };
        let corners =
            [corner(from, half_width), corner(from, -half_width), corner(to, narrow), corner(to, -narrow)];
        parts.push(plate([corners[0], corners[1], corners[2]], 5.0, bone));
        parts.push(plate([corners[1], corners[3], corners[2]], 5.0, bone));
    }
    parts.push(limb(front(1314.0), 5.0, add(front(1288.0), [0.0, 3.0, 0.0]), 3.5, bone));
    parts
}

/// The left collar bone and shoulder blade.
fn shoulder() -> Vec<Part> {
    let clavicle = [
        ([17.0, -48.0, 1453.0], 9.0),
        ([48.0, -52.0, 1461.0], 6.0),
        ([92.0, -28.0, 1466.0], 5.5),
        ([132.0, 0.0, 1467.0], 5.8),
        ([160.0, 6.0, 1467.0], 6.0),
    ];
    let mut parts = tube(&clavicle, shell(2.2));
    let blade = shell(1.0);
    let (top, root, bottom) = ([66.0, 60.0, 1462.0], [64.0, 80.0, 1428.0], [84.0, 84.0, 1312.0]);
    let (neck, side) = ([140.0, 28.0, 1432.0], [122.0, 52.0, 1375.0]);
    for corners in [[top, root, neck], [root, bottom, side], [root, side, neck]] {
        parts.push(plate(corners, 1.9, blade));
    }
    parts.push(limb(bottom, 4.5, neck, 6.5, shell(1.5)));
    parts.push(limb(root, 2.8, bottom, 4.0, shell(1.5)));
    // Socket, spine and tip, coracoid.
    parts.push(oval([147.0, 18.0, 1430.0], [8.0, 13.0, 18.0], shell(1.5)));
    let (crest_start, crest_end) = ([68.0, 82.0, 1430.0], [160.0, 30.0, 1462.0]);
    parts.push(plate([root, neck, crest_end], 1.8, blade));
    parts.extend(tube(
        &[(crest_start, 3.5), ([112.0, 60.0, 1446.0], 4.5), (crest_end, 7.0), ([168.0, 10.0, 1466.0], 6.0)],
        shell(1.5),
    ));
    parts.extend(tube(
        &[([138.0, 12.0, 1450.0], 6.0), ([136.0, -8.0, 1460.0], 6.0), ([146.0, -22.0, 1450.0], 4.5)],
        shell(1.5),
    ));
    parts.push(ball(crest_end, 7.5, shell(1.5)));
    parts
}
