//! The spine from the atlas to the tailbone, with discs, canal and cord.

use super::parts::{SOLID, limb, oval, part, plate, shell, tube};
use super::tissues::{CORD, CORTEX, DISC, SPONGY_BONE, WATER};
use crate::shape::{Layer, Part, Shape};
use crate::solid::{Drum, Solid};
use crate::vector::{Vec3, add, lerp, mirror, scale, sub};

/// A vertebra of the neck, chest or loin.
#[derive(Clone, Copy, Debug)]
pub struct Vertebra {
    /// The middle of its body.
    pub center: Vec3,
    /// Upwards along the spine.
    pub up: Vec3,
    pub half_height: f32,
    /// Radii of the body, anteroposterior and lateral.
    pub radii: [f32; 2],
    /// 0 for the neck, 1 for the chest, 2 for the loin.
    pub region: usize,
}

impl Vertebra {
    /// Behind the body by `back_mm`, to the left by `left_mm`, up the spine by `up_mm`.
    fn place(&self, left_mm: f32, back_mm: f32, up_mm: f32) -> Vec3 {
        let back = [0.0, self.up[2], -self.up[1]];
        add(add(self.center, [left_mm, 0.0, 0.0]), add(scale(back, back_mm), scale(self.up, up_mm)))
    }

    /// The middle of the canal behind the body.
    fn canal(&self) -> Vec3 {
        self.place(0.0, self.radii[0] + 8.0, 0.0)
    }
}

/// Heights and depths of the spine's middle line.
const LINE: [[f32; 2]; 13] = [
    [1000.0, 50.0],
    [1029.0, 37.0],
    [1065.0, 29.0],
    [1101.0, 29.0],
    [1137.0, 34.0],
    [1205.0, 45.0],
    [1285.0, 54.0],
    [1365.0, 55.0],
    [1440.0, 47.0],
    [1497.0, 36.0],
    [1530.0, 26.0],
    [1575.0, 17.0],
    [1630.0, 16.0],
];

/// How far back the spine's middle line lies at a height.
pub fn line_y(z: f32) -> f32 {
    let above = LINE.iter().position(|point| point[0] >= z).unwrap_or(LINE.len() - 1).max(1);
    let ([z0, y0], [z1, y1]) = (LINE[above - 1], LINE[above]);
    y0 + (y1 - y0) * ((z - z0) / (z1 - z0)).clamp(0.0, 1.0)
}

/// The vertebrae from the first of the neck to the last of the loin.
pub fn vertebrae() -> Vec<Vertebra> {
    let heights = (0..24).map(|index| match index {
        0..7 => (1622.0 - 17.2 * index as f32, 0),
        7..19 => (1497.0 - 26.5 * (index - 7) as f32, 1),
        _ => (1172.0 - 35.5 * (index - 19) as f32, 2),
    });
    let vertebra = |(index, (z, region)): (usize, (f32, usize))| {
        let up = sub([0.0, line_y(z + 14.0), z + 14.0], [0.0, line_y(z - 14.0), z - 14.0]);
        let growth = index as f32 / 23.0;
        Vertebra {
            center: [0.0, line_y(z), z],
            up: crate::vector::normalize(up),
            half_height: [6.6, 10.8, 14.2][region],
            radii: [8.5 + 8.5 * growth, 11.0 + 14.0 * growth],
            region,
        }
    };
    heights.enumerate().map(vertebra).collect()
}

pub fn shapes() -> Vec<Shape> {
    let vertebrae = vertebrae();
    let disc = |pair: &[Vertebra]| {
        let center = lerp(pair[0].center, pair[1].center, 0.5);
        let radii = [pair[1].radii[0] * 0.96, pair[1].radii[1] * 0.96];
        let gap = pair[0].center[2] - pair[1].center[2] - pair[0].half_height - pair[1].half_height;
        part(Solid::Drum(Drum::new(center, pair[1].up, gap * 0.5 + 1.0, radii, 0.0)), SOLID)
    };
    let mut discs: Vec<Part> = vertebrae.windows(2).map(disc).collect();
    discs.push(part(
        Solid::Drum(Drum::new([0.0, 44.0, 1011.0], [0.0, -0.45, 1.0], 5.0, [16.0, 24.0], 0.0)),
        SOLID,
    ));
    let bones: Vec<Part> = vertebrae.iter().flat_map(vertebra).chain(sacrum()).collect();
    let mut canal: Vec<(Vec3, f32)> = vec![([0.0, 24.0, 1640.0], 8.0)];
    canal.extend(vertebrae.iter().map(|vertebra| (vertebra.canal(), 7.0)));
    canal.extend([([0.0, 68.0, 1000.0], 6.0), ([0.0, 84.0, 960.0], 3.0)]);
    let cord: Vec<(Vec3, f32)> = canal[..21].iter().map(|&(at, radius)| (at, radius * 0.6)).collect();
    vec![
        Shape::new(discs, vec![Layer::outer(0.0, DISC)]),
        Shape::new(bones, vec![Layer::outer(0.0, CORTEX), Layer::inner(0.0, SPONGY_BONE)]),
        Shape::new(tube(&canal, SOLID), vec![Layer::outer(0.0, WATER)]),
        Shape::new(tube(&cord, SOLID), vec![Layer::outer(0.0, CORD)]),
    ]
}

fn vertebra(vertebra: &Vertebra) -> Vec<Part> {
    let Vertebra { center, up, half_height, radii, region } = *vertebra;
    let bone = shell(1.4);
    let body = Drum::new(center, up, half_height, radii, [0.05, 0.12, 0.14][region]);
    let mut parts = vec![part(Solid::Drum(body), shell(1.6))];
    let back = radii[0];
    let size = [0.7, 0.85, 1.15][region];
    // Where the arch begins, where it is widest, and where its halves meet.
    let root = vertebra.place(radii[1] * 0.62, back * 0.8, half_height * 0.35);
    let side = vertebra.place(12.0 + 3.0 * size, back + 9.0, 0.0);
    let meeting = vertebra.place(0.0, back + 19.0, -2.0);
    let reach = [13.0, 18.0, 24.0][region];
    let wing = vertebra.place(15.0 + reach, back + [4.0, 20.0, 12.0][region], [-2.0, 3.0, 1.0][region]);
    for flip in [|p: Vec3| p, mirror] {
        parts.push(limb(flip(root), 4.0 * size, flip(side), 4.4 * size, bone));
        parts.push(limb(flip(side), 4.0 * size, meeting, 3.4 * size, bone));
        parts.push(limb(flip(side), 4.2 * size, flip(wing), 3.6 * size, bone));
        let facet = |up_mm: f32| flip(vertebra.place(13.0 + 2.0 * size, back + 11.0, up_mm));
        parts.push(limb(facet(half_height), 3.8 * size, facet(-half_height * 1.1), 3.8 * size, bone));
    }
    let (length, drop) = [(14.0, 6.0), (20.0, 22.0), (27.0, 5.0)][region];
    let tip = vertebra.place(0.0, back + 19.0 + length, -drop);
    let tall = vertebra.place(0.0, back + 19.0 + length, -drop - 6.0 * size);
    parts.push(limb(meeting, 3.2 * size, tip, 3.6 * size, bone));
    parts.push(plate([meeting, tip, tall], 2.2 * size, bone));
    parts
}

fn sacrum() -> Vec<Part> {
    let mut parts = Vec::new();
    for (index, [y, z, half_width]) in [
        [54.0, 994.0, 50.0],
        [68.0, 970.0, 44.0],
        [79.0, 946.0, 34.0],
        [86.0, 922.0, 25.0],
        [87.0, 900.0, 18.0],
    ]
    .into_iter()
    .enumerate()
    {
        let depth = 15.0 - 1.8 * index as f32;
        parts.push(oval([0.0, y, z], [half_width, depth, 15.0], shell(1.6).blend(14.0)));
    }
    parts.push(limb([0.0, 86.0, 884.0], 8.0, [0.0, 76.0, 858.0], 4.0, shell(1.2).blend(5.0)));
    parts.push(limb([0.0, 80.0, 990.0], 4.0, [0.0, 98.0, 940.0], 4.0, shell(1.2).blend(6.0)));
    parts
}
