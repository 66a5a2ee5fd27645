use super::{Rect, Row};

/// An outline of a loft at one height.
#[derive(Clone, Copy, Debug)]
pub struct Section {
    pub z: f32,
    /// Where the outline is widest.
    pub center: [f32; 2],
    pub half_width: f32,
    /// From the centre to the outline towards −y and towards +y.
    pub front: f32,
    pub back: f32,
    /// 0 is an ellipse, 1 a rectangle.
    pub square: f32,
}

impl Section {
    /// A section centred on the body's midplane.
    pub const fn mid(z: f32, y: f32, half_width: f32, front: f32, back: f32) -> Self {
        Self { z, center: [0.0, y], half_width, front, back, square: 0.0 }
    }

    /// A section beside the midplane.
    pub const fn at(z: f32, center: [f32; 2], half_width: f32, front: f32, back: f32) -> Self {
        Self { z, center, half_width, front, back, square: 0.0 }
    }

    fn values(&self) -> [f32; 6] {
        [self.center[0], self.center[1], self.half_width, self.front, self.back, self.square]
    }
}

/// A smooth surface through outlines at several heights: torso, legs, rib cage.
#[derive(Clone, Debug)]
pub struct Loft {
    /// At least two, ascending.
    pub sections: Vec<Section>,
}

impl Loft {
    /// The same outlines, each made more rectangular.
    pub fn squared(mut self, square: f32) -> Self {
        self.sections.iter_mut().for_each(|section| section.square = square);
        self
    }

    pub(super) fn mirrored(&self) -> Self {
        let mirror =
            |section: &Section| Section { center: [-section.center[0], section.center[1]], ..*section };
        Self { sections: self.sections.iter().map(mirror).collect() }
    }

    /// The outline at a height from the lowest section to the highest: Catmull–Rom between them.
    pub(super) fn cut(&self, z_mm: f32) -> Option<LoftCut> {
        let above = self.sections.iter().position(|section| section.z >= z_mm)?;
        if above == 0 && self.sections[0].z > z_mm {
            return None;
        }
        let above = above.max(1);
        let pick = |index: usize| &self.sections[index.min(self.sections.len() - 1)];
        let (before, low, high, after) =
            (pick(above.saturating_sub(2)), pick(above - 1), pick(above), pick(above + 1));
        let height = high.z - low.z;
        let t = (z_mm - low.z) / height;
        let mut values = [0.0; 6];
        let mut slopes = [0.0; 6];
        for j in 0..6 {
            let value = |section: &Section| section.values()[j];
            let tangent = |p: &Section, q: &Section| (value(q) - value(p)) / (q.z - p.z).max(1e-3) * height;
            let (p0, p1) = (value(low), value(high));
            let (m0, m1) = (tangent(before, high), tangent(low, after));
            let (a, b) = (2.0 * (p0 - p1) + m0 + m1, 3.0 * (p1 - p0) - 2.0 * m0 - m1);
            values[j] = ((a * t + b) * t + m0) * t + p0;
            slopes[j] = ((3.0 * a * t + 2.0 * b) * t + m0) / height;
        }
        let section = |z: f32, v: [f32; 6]| Section {
            z,
            center: [v[0], v[1]],
            half_width: v[2],
            front: v[3],
            back: v[4],
            square: v[5],
        };
        Some(LoftCut { section: section(z_mm, values), slope: section(0.0, slopes) })
    }
}

/// A loft's outline at a slice, and how it changes with z.
#[derive(Clone, Debug)]
pub struct LoftCut {
    section: Section,
    slope: Section,
}

impl LoftCut {
    pub(super) fn rect(&self, margin_mm: f32) -> Rect {
        let Section { center: [x, y], half_width, front, back, .. } = self.section;
        let Section { center: [x_slope, y_slope], half_width: wider, front: fronter, back: backer, .. } =
            self.slope;
        // Where the surface leans, what is near it reaches farther within the slice.
        let lean = (wider.abs() + x_slope.abs()).max(fronter.abs().max(backer.abs()) + y_slope.abs());
        let margin_mm = margin_mm * (1.0 + lean * lean).sqrt();
        Rect {
            x: [x - half_width - margin_mm, x + half_width + margin_mm],
            y: [y - front - margin_mm, y + back + margin_mm],
        }
    }

    /// The outline is u² + v² − square·u²v² = 1; its distance is that equation over the length of its gradient.
    pub(super) fn distances(&self, row: &Row, out: &mut [f32]) {
        let (section, slope) = (&self.section, &self.slope);
        let y = row.first_mm[1] - section.center[1];
        let (depth, depth_slope) =
            if y < 0.0 { (section.front, slope.front) } else { (section.back, slope.back) };
        let (inverse_width, inverse_depth) = (section.half_width.recip(), depth.recip());
        let v = y * inverse_depth;
        let v_squared = v * v;
        let shortest = section.half_width.min(depth);
        for (i, distance) in out.iter_mut().enumerate() {
            let u = (row.x(i) - section.center[0]) * inverse_width;
            let u_squared = u * u;
            let corner = (u_squared * v_squared).min(1.0);
            let radial = (u_squared + v_squared - section.square * corner).max(0.0).sqrt();
            let by_u = 2.0 * u * (1.0 - section.square * v_squared.min(1.0));
            let by_v = 2.0 * v * (1.0 - section.square * u_squared.min(1.0));
            let gx = by_u * inverse_width;
            let gy = by_v * inverse_depth;
            // The lean of the surface towards which the voxel lies.
            let onto_surface = 1.0 / radial.max(0.2);
            let u_slope = (slope.center[0] + u * onto_surface * slope.half_width) * inverse_width;
            let v_slope = (slope.center[1] + v * onto_surface * depth_slope) * inverse_depth;
            let gz = by_u * u_slope + by_v * v_slope;
            let gradient = (gx * gx + gy * gy + gz * gz).sqrt();
            *distance = (radial - 1.0) * (2.0 * radial + 1e-4) / (gradient + 1e-4 / shortest);
        }
    }
}
