//! Paints the shapes of one slice, row by row, each over the ones before it.

use std::ops::Range;

use crate::noise::{Grain, RowNoise};
use crate::phantom::Grid;
use crate::shape::{Keep, Layer, Shape, ShapeCut, Surface};
use crate::solid::{Rect, Row};

const AIR_HU: f32 = -1000.0;
/// Farther than anything that is ever compared with it.
const FAR_MM: f32 = 1e5;

/// Buffers of one thread, each a row long.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    hu: Vec<f32>,
    outer_mm: Vec<f32>,
    inner_mm: Vec<f32>,
    part_mm: Vec<f32>,
    target_hu: Vec<f32>,
    spans: Vec<Range<usize>>,
}

/// A slice of the phantom, ready for its rows to be painted.
pub struct Slice<'a> {
    grid: &'a Grid,
    seed: u64,
    z: u32,
    shapes: Vec<ShapeCut<'a>>,
}

impl<'a> Slice<'a> {
    pub fn new(grid: &'a Grid, shapes: &'a [Shape], seed: u64, z: u32) -> Self {
        let z_mm = grid.position(2, z) as f32;
        let shapes = shapes.iter().filter_map(|shape| shape.cut(z_mm, grid.ramp_mm)).collect();
        Self { grid, seed, z, shapes }
    }

    /// The voxels of row `y`, in Hounsfield units.
    pub fn paint_row(&self, y: u32, scratch: &mut Scratch, out: &mut [i16]) {
        let width = out.len();
        scratch.resize(width);
        scratch.hu.fill(AIR_HU);
        let y_mm = self.grid.position(1, y) as f32;
        let z_mm = self.grid.position(2, self.z) as f32;
        for shape in &self.shapes {
            scratch.find_spans(shape, self.grid, y_mm);
            for index in 0..scratch.spans.len() {
                let span = scratch.spans[index].clone();
                let first_mm = [self.grid.position(0, span.start as u32) as f32, y_mm, z_mm];
                let row = Row { first_mm, step_mm: self.grid.spacing_mm[0] as f32 };
                scratch.measure(shape, self.grid, &row, span.clone());
                scratch.fill(shape, &row, span, 1.0 / self.grid.ramp_mm, self.seed);
            }
        }
        add_noise(&scratch.hu, RowNoise::new(self.seed, y, self.z), out);
    }
}

impl Scratch {
    fn resize(&mut self, width: usize) {
        for row in
            [&mut self.hu, &mut self.outer_mm, &mut self.inner_mm, &mut self.part_mm, &mut self.target_hu]
        {
            row.resize(width, 0.0);
        }
    }

    /// The voxels of the row that some part of the shape comes near, as separate spans in ascending order.
    fn find_spans(&mut self, shape: &ShapeCut<'_>, grid: &Grid, y_mm: f32) {
        let near = |rect: &Rect| rect.y[0] <= y_mm && y_mm <= rect.y[1];
        let spans = shape.parts.iter().filter(|(cut, _)| near(&cut.rect));
        self.spans.clear();
        self.spans.extend(spans.map(|(cut, _)| grid.voxels(0, cut.rect.x)).filter(|span| !span.is_empty()));
        self.spans.sort_unstable_by_key(|span| span.start);
        self.spans.dedup_by(|next, span| {
            let joined = next.start <= span.end;
            if joined {
                span.end = span.end.max(next.end);
            }
            joined
        });
    }

    /// Distances of the span's voxels from the shape's outer surface and, where it has one, its inner surface.
    fn measure(&mut self, shape: &ShapeCut<'_>, grid: &Grid, row: &Row, span: Range<usize>) {
        self.outer_mm[span.clone()].fill(FAR_MM);
        if shape.has_inner {
            self.inner_mm[span.clone()].fill(FAR_MM);
        }
        let y_mm = row.first_mm[1];
        let shifted = |from: usize| Row {
            first_mm: [row.first_mm[0] + (from - span.start) as f32 * row.step_mm, y_mm, row.first_mm[2]],
            ..*row
        };
        for (cut, part) in &shape.parts {
            let voxels = grid.voxels(0, cut.rect.x);
            if y_mm < cut.rect.y[0]
                || cut.rect.y[1] < y_mm
                || voxels.is_empty()
                || voxels.start < span.start
                || span.end < voxels.end
            {
                continue;
            }
            let distances = &mut self.part_mm[voxels.clone()];
            cut.distances(&shifted(voxels.start), distances);
            let change = if part.carve { carve } else { join };
            change(&mut self.outer_mm[voxels.clone()], distances, 0.0, part.blend_mm);
            if shape.has_inner {
                change(&mut self.inner_mm[voxels], distances, part.shell_mm, part.blend_mm);
            }
        }
        for (cut, clip) in &shape.clips {
            let sign = if clip.keep == Keep::Inside { 1.0 } else { -1.0 };
            let distances = &mut self.part_mm[span.clone()];
            cut.distances(row, distances);
            bound(&mut self.outer_mm[span.clone()], distances, sign, clip.gap_mm);
            if shape.has_inner {
                bound(&mut self.inner_mm[span.clone()], distances, sign, clip.gap_mm + clip.shell_mm);
            }
        }
    }

    fn fill(&mut self, shape: &ShapeCut<'_>, row: &Row, span: Range<usize>, per_ramp: f32, seed: u64) {
        for Layer { surface, inset_mm, tissue } in shape.layers {
            let distances = match surface {
                Surface::Outer => &self.outer_mm[span.clone()],
                Surface::Inner => &self.inner_mm[span.clone()],
            };
            let hu = &mut self.hu[span.clone()];
            let covered = |distance: f32| {
                let t = (0.5 - (distance + inset_mm) * per_ramp).clamp(0.0, 1.0);
                t * t * (3.0 - 2.0 * t)
            };
            if tissue.grain_hu == 0.0 {
                for (hu, &distance) in hu.iter_mut().zip(distances) {
                    *hu += (tissue.hu - *hu) * covered(distance);
                }
            } else {
                let target = &mut self.target_hu[span.clone()];
                target.fill(tissue.hu);
                Grain { seed, cell_mm: tissue.grain_mm }.add(row, tissue.grain_hu, target);
                for ((hu, &distance), &target) in hu.iter_mut().zip(distances).zip(&*target) {
                    *hu += (target - *hu) * covered(distance);
                }
            }
        }
    }
}

/// The union of what was joined so far and a part shrunk by `shell_mm`, rounded where they meet within `blend_mm`.
fn join(joined: &mut [f32], part: &[f32], shell_mm: f32, blend_mm: f32) {
    if blend_mm == 0.0 {
        for (joined, &distance) in joined.iter_mut().zip(part) {
            *joined = joined.min(distance + shell_mm);
        }
        return;
    }
    let inverse = 1.0 / blend_mm;
    for (joined, &distance) in joined.iter_mut().zip(part) {
        let distance = distance + shell_mm;
        let near = (blend_mm - (*joined - distance).abs()).max(0.0);
        *joined = joined.min(distance) - near * near * inverse * 0.25;
    }
}

/// What was joined so far without a part grown by `shell_mm`, rounded like [`join`].
fn carve(joined: &mut [f32], part: &[f32], shell_mm: f32, blend_mm: f32) {
    let inverse = 1.0 / blend_mm.max(1e-3);
    for (joined, &distance) in joined.iter_mut().zip(part) {
        let outside = shell_mm - distance;
        let near = (blend_mm - (*joined - outside).abs()).max(0.0);
        *joined = joined.max(outside) + near * near * inverse * 0.25;
    }
}

/// What remains of a shape beside a clip: its inside for sign 1, its outside for −1.
fn bound(shape: &mut [f32], clip: &[f32], sign: f32, gap_mm: f32) {
    for (shape, &distance) in shape.iter_mut().zip(clip) {
        *shape = shape.max(sign * distance + gap_mm);
    }
}

/// Adds the scanner's noise, 4 HU in air and 15 HU in tissue, and rounds to the stored range.
fn add_noise(hu: &[f32], noise: RowNoise, out: &mut [i16]) {
    const AIR_DEVIATION_HU: f32 = 4.0;
    const TISSUE_DEVIATION_HU: f32 = 15.0;
    /// Added to a float of this size, its lowest bits are the rounded integer.
    const ROUND: f32 = 12_582_912.0;
    for (x, (stored, &hu)) in (0_u32..).zip(out.iter_mut().zip(hu)) {
        let density = ((hu - AIR_HU) * (1.0 / 700.0)).clamp(0.0, 1.0);
        let deviation = AIR_DEVIATION_HU + (TISSUE_DEVIATION_HU - AIR_DEVIATION_HU) * density;
        let value = (hu + deviation * noise.at(x)).clamp(-1024.0, 3071.0);
        *stored = (value + ROUND).to_bits() as i16;
    }
}
