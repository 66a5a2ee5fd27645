use std::ops::Range;

use glam::{UVec3, Vec3};
use glassbrick_volume::{BrickGrid, CELL_EDGE_LOG2, Ray};

use super::rays::RowRay;
use crate::scalar::samples_in_box;

/// The way of a picture's row of rays through the volume, seen along x.
pub struct Track {
    /// Front to back, or in the order in which they are best drawn.
    pub sections: Vec<Section>,
    pub runs: Vec<Run>,
    /// From sample number `first` on.
    pub steps: Vec<Step>,
    pub first: u32,
    /// Of the four rows of voxels around a sample, those that the sample before did not have around it: how far along y
    /// and z from the first.
    pub new_rows: [[u32; 2]; 2],
}

/// The samples in one line of bricks along x.
pub struct Section {
    pub numbers: Range<u32>,
    /// The place in the grid of the line's first brick.
    pub line: usize,
    /// Places in `runs`.
    pub runs: Range<usize>,
}

/// The samples in one row of cells along x.
pub struct Run {
    pub numbers: Range<u32>,
    pub cell_row: usize,
}

/// Where the samples of one number lie in their bricks.
#[derive(Clone, Copy, Default)]
pub struct Step {
    /// The first voxel of the row of voxels before them.
    pub row: u32,
    /// The fractions along y and z.
    pub fraction: [f32; 2],
    /// The row of cells along x.
    cell_row: u32,
}

impl Track {
    /// Follows a row of rays through the lines of bricks in which something is to be drawn, by their first brick.
    #[target_feature(enable = "avx512f,avx512bw,avx512vl")]
    pub fn new(grid: &BrickGrid, ray: RowRay, sample_count: u32, is_drawn: impl Fn(usize) -> bool) -> Self {
        let seen_along_x = Ray {
            start: Vec3::new(0.0, ray.start[0], ray.start[1]),
            step: Vec3::new(0.0, ray.step[0], ray.step[1]),
            step_length_mm: 0.0,
        };
        let numbers_in = |[low, high]: [Vec3; 2]| {
            samples_in_box(&seen_along_x, [low.with_x(-1.0), high.with_x(1.0)], sample_count)
        };
        let whole = [grid.owned_box(UVec3::ZERO)[0], grid.owned_box(grid.counts - 1)[1]];
        let numbers = numbers_in(whole);
        let mut track = Self {
            sections: Vec::new(),
            runs: Vec::new(),
            steps: vec![Step::default(); numbers.len()],
            first: numbers.start,
            new_rows: if ray.step[0].abs() >= ray.step[1].abs() {
                let y = u32::from(ray.step[0] > 0.0);
                [[y, 0], [y, 1]]
            } else {
                let z = u32::from(ray.step[1] > 0.0);
                [[0, z], [1, z]]
            },
        };
        let mut next = numbers.start;
        while next < numbers.end {
            let first = seen_along_x.sample(next).with_x(0.0);
            let brick = grid.owner(first).expect("the sample lies in the volume");
            let end = numbers_in(grid.owned_box(brick)).end.max(next + 1);
            let line = grid.index(brick);
            if is_drawn(line) {
                let start = track.runs.len();
                track.follow(grid, brick, &seen_along_x, next..end);
                track.sections.push(Section { numbers: next..end, line, runs: start..track.runs.len() });
            }
            next = end;
        }
        track
    }

    /// The samples of one number as a run of their own, and their section; nothing where no section has them.
    pub fn alone(&self, number: u32) -> Option<(&Section, Run)> {
        let section = self.sections.iter().find(|section| section.numbers.contains(&number))?;
        let cell_row = self.steps[(number - self.first) as usize].cell_row as usize;
        Some((section, Run { numbers: number..number + 1, cell_row }))
    }

    #[target_feature(enable = "avx512f,avx512bw,avx512vl")]
    fn follow(&mut self, grid: &BrickGrid, brick: UVec3, ray: &Ray, numbers: Range<u32>) {
        let halo_start = grid.halo_start(brick);
        let edge = grid.layout.edge;
        let cells = edge.div_ceil(1 << CELL_EDGE_LOG2);
        let places = [numbers.start, numbers.end].map(|number| (number - self.first) as usize);
        let steps = &mut self.steps[places[0]..places[1]];
        // One loop for the positions, which compilers make vectors of, and one for the runs.
        for (number, step) in (numbers.start..).zip(&mut *steps) {
            let at = ray.sample(number);
            let [floor_y, floor_z] = [at.y.floor(), at.z.floor()];
            let y = (floor_y as i32 - halo_start.y) as u32;
            let z = (floor_z as i32 - halo_start.z) as u32;
            *step = Step {
                row: (z * edge + y) * edge,
                fraction: [at.y - floor_y, at.z - floor_z],
                cell_row: (z >> CELL_EDGE_LOG2) * cells + (y >> CELL_EDGE_LOG2),
            };
        }
        let mut start = numbers.start;
        for run in steps.chunk_by(|a, b| a.cell_row == b.cell_row) {
            let end = start + run.len() as u32;
            self.runs.push(Run { numbers: start..end, cell_row: run[0].cell_row as usize });
            start = end;
        }
    }
}
