use glam::UVec3;
use glassbrick_volume::{Brick, BrickGrid, BrickId, BrickRange, BrickSource, ReadError, Voxels};
use rayon::prelude::*;

/// Bricks that are read, at most.
const MOST_BRICKS: usize = 96;

/// Pairs of voxels that are looked at, about.
const MOST_PAIRS: f64 = 2e6;

/// Of the volume's faces, every other voxel on each axis is looked at.
const FACE_STEP: u32 = 2;

/// An axis with fewer voxels than this fraction of the middle one has no faces to speak of: of a few slices, the first
/// and the last show the object as well as any other.
const THIN: f32 = 0.2;

/// Stored values from one brick, or from one that holds a single value.
pub struct Part {
    /// Voxels with their next neighbours along x.
    pub pairs: Vec<[f32; 2]>,
    /// Voxels of the volume that a pair stands for.
    pub voxels_per_pair: f64,
    /// Voxels on the volume's faces.
    pub faces: Vec<f32>,
    /// Voxels on the volume's faces that one of them stands for.
    pub voxels_per_face: f64,
}

/// Samples a volume. Bricks of one value need not be read; of the others, those with a wide range are read the more
/// often, so that what is rare is met too.
pub fn sample(source: &dyn BrickSource) -> Result<Vec<Part>, ReadError> {
    let (grid, ranges) = (source.grid(0), source.ranges(0));
    let (constant, varied): (Vec<usize>, Vec<usize>) =
        (0..grid.len()).partition(|&brick| ranges[brick].core[0] == ranges[brick].core[1]);
    let voxels = |index: usize| core(&grid, grid.brick(index)).as_dvec3().element_product();
    let all: f64 = varied.iter().map(|&index| voxels(index)).sum();
    let chosen = choose(varied, ranges);
    let stand_for = all / chosen.iter().map(|&(index, weight)| weight * voxels(index)).sum::<f64>();
    let step = pair_step(&grid, chosen.len());
    let read = |&(index, weight): &(usize, f64)| {
        let at = grid.brick(index);
        let brick = source.brick(BrickId::new(0, at))?;
        let (pairs, faces) = part_of(&brick, &grid, at, step);
        Ok(Part {
            voxels_per_pair: stand_for * weight * voxels(index) / pairs.len() as f64,
            pairs,
            voxels_per_face: stand_for * weight * f64::from(FACE_STEP * FACE_STEP),
            faces,
        })
    };
    let mut parts = chosen.par_iter().map(read).collect::<Result<Vec<Part>, ReadError>>()?;
    parts.extend(constant.into_iter().map(|index| {
        let (at, value) = (grid.brick(index), ranges[index].core[0]);
        let core = core(&grid, at).as_dvec3();
        Part {
            pairs: vec![[value; 2]],
            voxels_per_pair: core.element_product(),
            faces: vec![value],
            voxels_per_face: faces(&grid, at).map(|(axis, _)| core.element_product() / core[axis]).sum(),
        }
    }));
    Ok(parts)
}

/// The bricks to read, and for how many each stands in proportion. Ordered by the width of their range, a brick at
/// fraction x of all is chosen with a density of 2x.
fn choose(mut bricks: Vec<usize>, ranges: &[BrickRange]) -> Vec<(usize, f64)> {
    if bricks.len() <= MOST_BRICKS {
        return bricks.into_iter().map(|index| (index, 1.0)).collect();
    }
    let width = |index: usize| ranges[index].core[1] - ranges[index].core[0];
    bricks.sort_by(|&a, &b| width(a).total_cmp(&width(b)).then(a.cmp(&b)));
    let choice = |i: usize| {
        let x = ((i as f64 + 0.5) / MOST_BRICKS as f64).sqrt();
        (bricks[(x * bricks.len() as f64) as usize], 0.5 / x)
    };
    (0..MOST_BRICKS).map(choice).collect()
}

/// Voxels of a brick's core along each axis.
fn core(grid: &BrickGrid, brick: UVec3) -> UVec3 {
    grid.core_end(brick) - grid.core_start(brick)
}

/// How far apart pairs lie on each axis, so that as many bricks give no more than wanted.
fn pair_step(grid: &BrickGrid, bricks: usize) -> UVec3 {
    let all = bricks as f64 * core(grid, UVec3::ZERO).as_dvec3().element_product();
    let mut step = UVec3::ONE;
    for axis in [0, 1, 2].into_iter().cycle() {
        if all / step.as_dvec3().element_product() <= MOST_PAIRS {
            break;
        }
        step[axis] += 1;
    }
    step
}

/// The faces of the volume that a brick holds a part of: the axis across, and the core's coordinate on it.
fn faces(grid: &BrickGrid, brick: UVec3) -> impl Iterator<Item = (usize, u32)> {
    let (start, end, extent) = (grid.core_start(brick), grid.core_end(brick), grid.extent);
    let mut sorted = extent.to_array();
    sorted.sort_unstable();
    let shortest = THIN * sorted[1] as f32;
    (0..3).filter(move |&axis| extent[axis] as f32 >= shortest).flat_map(move |axis| {
        let first = (start[axis] == 0).then_some((axis, 0));
        let last = (end[axis] == extent[axis]).then_some((axis, end[axis] - start[axis] - 1));
        first.into_iter().chain(last)
    })
}

fn part_of(brick: &Brick, grid: &BrickGrid, at: UVec3, step: UVec3) -> (Vec<[f32; 2]>, Vec<f32>) {
    fn both<V: Copy + Into<f32>>(
        voxels: &[V],
        grid: &BrickGrid,
        at: UVec3,
        step: UVec3,
    ) -> (Vec<[f32; 2]>, Vec<f32>) {
        (pairs(voxels, grid, at, step), face_voxels(voxels, grid, at))
    }
    match &brick.voxels {
        Voxels::U8(voxels) => both(voxels, grid, at, step),
        Voxels::I8(voxels) => both(voxels, grid, at, step),
        Voxels::U16(voxels) => both(voxels, grid, at, step),
        Voxels::I16(voxels) => both(voxels, grid, at, step),
        Voxels::F32(voxels) => both(voxels, grid, at, step),
    }
}

/// The place in a brick of a voxel of its core.
fn place(grid: &BrickGrid, core: UVec3) -> usize {
    let edge = grid.layout.edge as usize;
    let [x, y, z] = (core + grid.layout.halo).to_array().map(|coordinate| coordinate as usize);
    (z * edge + y) * edge + x
}

/// Core voxels with their neighbours. Rows are shifted against each other, so that no stripes are missed.
fn pairs<V: Copy + Into<f32>>(voxels: &[V], grid: &BrickGrid, at: UVec3, step: UVec3) -> Vec<[f32; 2]> {
    let core = core(grid, at);
    let mut pairs =
        Vec::with_capacity((core + step).element_product() as usize / step.element_product() as usize);
    for (row_z, z) in (0..core.z).step_by(step.z as usize).enumerate() {
        for (row_y, y) in (0..core.y).step_by(step.y as usize).enumerate() {
            let shift = ((row_y + row_z) as u32 % step.x).min(core.x - 1);
            let row = place(grid, UVec3::new(0, y, z));
            for x in (shift..core.x).step_by(step.x as usize) {
                let voxel = row + x as usize;
                pairs.push([voxels[voxel].into(), voxels[voxel + 1].into()]);
            }
        }
    }
    pairs
}

fn face_voxels<V: Copy + Into<f32>>(voxels: &[V], grid: &BrickGrid, at: UVec3) -> Vec<f32> {
    let core = core(grid, at);
    let mut found = Vec::new();
    for (axis, coordinate) in faces(grid, at) {
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        for a in (0..core[u]).step_by(FACE_STEP as usize) {
            for b in (0..core[v]).step_by(FACE_STEP as usize) {
                let mut voxel = UVec3::ZERO;
                (voxel[axis], voxel[u], voxel[v]) = (coordinate, a, b);
                found.push(voxels[place(grid, voxel)].into());
            }
        }
    }
    found
}
