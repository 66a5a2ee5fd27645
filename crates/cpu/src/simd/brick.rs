use glam::{IVec3, Vec3};
use glassbrick_volume::{BrickCells, CELL_EDGE_LOG2, Occupancy};

use super::lanes::Lanes;
use super::packet::{Column, LaneSteps, Packet};
use super::projection::Slopes;
use super::voxel::LaneVoxel;
use crate::kernel::BrickView;

/// Samples are looked for this much beyond a brick's faces, in voxels per voxel of its farthest coordinate, since
/// their positions are rounded; each is then tested exactly.
const ROUNDING: f32 = 4.0 * f32::EPSILON;

/// A brick as vectors of rays see it.
pub struct LaneBrick<'a, V> {
    voxels: &'a [V],
    edge: usize,
    halo_start: Vec3,
    owned: [Vec3; 2],
    /// Where samples are looked for: a box around those of `owned` that can matter.
    searched: [Vec3; 2],
    /// Cells along each axis.
    cells_edge: usize,
}

impl<'a, V: LaneVoxel> LaneBrick<'a, V> {
    /// Looks for samples in the whole brick, or in the cells that may show something.
    pub fn new(view: &BrickView<'a>, voxels: &'a [V], occupancy: Option<&Occupancy>) -> Self {
        let edge = view.brick.edge as usize;
        assert!(voxels.len() >= edge.pow(3) + 4, "a brick is edge³ voxels and some padding");
        let IVec3 { x, y, z } = view.halo_start;
        let halo_start = Vec3::new(x as f32, y as f32, z as f32);
        let [mut low, mut high] = view.owned;
        if let Some(occupancy) = occupancy {
            low = low.max(occupancy.occupied[0] + halo_start);
            high = high.min(occupancy.occupied[1] + halo_start);
        }
        let rounding = Vec3::splat(high.abs().max_element() * ROUNDING + 1e-5);
        let searched = [low - rounding, high + rounding];
        Self {
            voxels,
            edge,
            halo_start,
            owned: view.owned,
            searched,
            cells_edge: BrickCells::edge(view.brick.edge),
        }
    }
}

/// Lanes of rays.
pub struct LaneRays<L: Lanes> {
    pub start: [L::F; 3],
    pub steps: LaneSteps<L>,
    pub per_step: [L::F; 3],
}

impl<L: Lanes> LaneRays<L> {
    /// The rays of a packet from lane `first` on.
    #[inline(always)]
    pub fn load<S>(packet: &Packet<S>, first: usize) -> Self {
        Self {
            start: load3::<L>(&packet.start, first),
            steps: LaneSteps {
                voxels: load3::<L>(&packet.step, first),
                length_mm: L::load(&packet.step_length_mm[first..]),
            },
            per_step: load3::<L>(&packet.per_step, first),
        }
    }
}

#[inline(always)]
fn load3<L: Lanes>(columns: &[Column; 3], first: usize) -> [L::F; 3] {
    [L::load(&columns[0][first..]), L::load(&columns[1][first..]), L::load(&columns[2][first..])]
}

/// One sample of each ray.
pub struct LaneSample<L: Lanes> {
    /// The rays whose sample the brick owns.
    pub owned: L::M,
    /// Position from the brick's first voxel, and its whole part.
    local: [L::F; 3],
    cell: [L::F; 3],
}

/// Where a sample lies between voxels.
pub struct LanePlace<L: Lanes> {
    index: L::I,
    fraction: [L::F; 3],
}

impl<V: LaneVoxel> LaneBrick<'_, V> {
    /// The first and last sample number of each ray that can lie where samples are looked for.
    #[inline(always)]
    pub fn interval<L: Lanes>(&self, rays: &LaneRays<L>) -> (L::F, L::F) {
        let mut enter = L::splat(0.0);
        let mut leave = L::splat(f32::MAX);
        for axis in 0..3 {
            let low = L::mul(L::sub(L::splat(self.searched[0][axis]), rays.start[axis]), rays.per_step[axis]);
            let high =
                L::mul(L::sub(L::splat(self.searched[1][axis]), rays.start[axis]), rays.per_step[axis]);
            enter = L::max(enter, L::min(low, high));
            leave = L::min(leave, L::max(low, high));
        }
        // ⌈enter⌉, but a little less, since the division is rounded too.
        let first = L::add(L::floor(L::sub(enter, L::splat(1e-3))), L::splat(1.0));
        (L::max(first, L::splat(0.0)), L::add(leave, L::splat(1e-3)))
    }

    /// The samples with these numbers; of the rays in `asked`, those are owned that the brick owns.
    #[inline(always)]
    pub fn sample<L: Lanes>(&self, rays: &LaneRays<L>, number: L::F, asked: L::M) -> LaneSample<L> {
        let mut owned = asked;
        let mut local = [number; 3];
        let mut cell = [number; 3];
        for axis in 0..3 {
            // Multiplied, then added, as the definition of the picture has it.
            let position = L::add(rays.start[axis], L::mul(number, rays.steps.voxels[axis]));
            owned = L::both(owned, L::ge(position, L::splat(self.owned[0][axis])));
            owned = L::both(owned, L::lt(position, L::splat(self.owned[1][axis])));
            let halo_start = L::splat(self.halo_start[axis]);
            let floor = L::floor(position);
            cell[axis] = L::sub(floor, halo_start);
            // The fraction is that of the position, so it is formed before anything is subtracted.
            local[axis] = L::sub(position, floor);
        }
        LaneSample { owned, local, cell }
    }

    /// The place of samples between voxels; of rays whose sample is not owned, a place in the brick that means nothing.
    #[inline(always)]
    pub fn place<L: Lanes>(&self, sample: &LaneSample<L>) -> LanePlace<L> {
        let edge = L::splat(self.edge as f32);
        let [x, y, z] = sample.cell;
        let index = L::to_i(L::mul_add(L::mul_add(z, edge, y), edge, x));
        let harmless = (self.edge * self.edge + self.edge + 1) as i32;
        LanePlace { index: L::select_i(sample.owned, index, L::splat_i(harmless)), fraction: sample.local }
    }

    /// The cell that each owned sample lies in, as an index; 0 for rays whose sample is not owned.
    #[inline(always)]
    pub fn cell_index<L: Lanes>(&self, sample: &LaneSample<L>) -> L::I {
        let edge = L::splat(self.cells_edge as f32);
        let [x, y, z] = cell_of::<L>(sample);
        let index = L::to_i(L::mul_add(L::mul_add(z, edge, y), edge, x));
        L::select_i(sample.owned, index, L::splat_i(0))
    }

    /// How many samples it takes each ray to leave the cells that are nearer than `distance` to its sample's cell.
    #[inline(always)]
    pub fn leap<L: Lanes>(&self, rays: &LaneRays<L>, sample: &LaneSample<L>, distance: L::F) -> L::F {
        let cell_edge = L::splat((1 << CELL_EDGE_LOG2) as f32);
        let zero = L::splat(0.0);
        let cells = cell_of::<L>(sample);
        let mut leave = L::splat(f32::MAX);
        for axis in 0..3 {
            let forward = L::gt(rays.per_step[axis], zero);
            let ahead = L::select(forward, distance, L::sub(L::splat(1.0), distance));
            let face = L::mul(L::add(cells[axis], ahead), cell_edge);
            let here = L::add(sample.cell[axis], sample.local[axis]);
            leave = L::min(leave, L::mul(L::sub(face, here), rays.per_step[axis]));
        }
        // ⌈leave⌉, but a little less: a sample on a face may already be the next cell's.
        let samples = L::add(L::floor(L::sub(leave, L::splat(2e-3))), L::splat(1.0));
        L::max(samples, L::splat(1.0))
    }

    /// The stored value at each place, by trilinear interpolation.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, place: &LanePlace<L>) -> L::F {
        let [row, slab] = self.strides();
        let [_, fy, fz] = place.fraction;
        let lower = lerp::<L>(self.row(place, 0), self.row(place, row), fy);
        let upper = lerp::<L>(self.row(place, slab), self.row(place, slab + row), fy);
        lerp::<L>(lower, upper, fz)
    }

    /// Twice the change of the stored value per voxel along each axis.
    #[inline(always)]
    fn gradient<L: Lanes>(&self, place: &LanePlace<L>) -> [L::F; 3] {
        let [row, slab] = self.strides();
        let [_, fy, fz] = place.fraction;
        // Rows along x are named by their place along y and z, where 0 and 1 are the cell's own.
        let x0 = lerp::<L>(self.change_along_x(place, 0), self.change_along_x(place, row), fy);
        let x1 = lerp::<L>(self.change_along_x(place, slab), self.change_along_x(place, row + slab), fy);
        let (r00, r10) = (self.row(place, 0), self.row(place, row));
        let (r01, r11) = (self.row(place, slab), self.row(place, row + slab));
        let y0 = L::sub(r10, self.row(place, -row));
        let y0 = lerp::<L>(y0, L::sub(self.row(place, 2 * row), r00), fy);
        let y1 = L::sub(r11, self.row(place, slab - row));
        let y1 = lerp::<L>(y1, L::sub(self.row(place, slab + 2 * row), r01), fy);
        let z0 = L::sub(r01, self.row(place, -slab));
        let z0 = lerp::<L>(z0, L::sub(self.row(place, 2 * slab), r00), fz);
        let z1 = L::sub(r11, self.row(place, row - slab));
        let z1 = lerp::<L>(z1, L::sub(self.row(place, row + 2 * slab), r10), fz);
        [lerp::<L>(x0, x1, fz), lerp::<L>(y0, y1, fz), lerp::<L>(z0, z1, fy)]
    }

    /// The value in a row along x, `aside` voxels from the cell's first.
    #[inline(always)]
    fn row<L: Lanes>(&self, place: &LanePlace<L>, aside: i32) -> L::F {
        let (a, b) = self.pair::<L>(L::add_i(place.index, L::splat_i(aside)));
        lerp::<L>(a, b, place.fraction[0])
    }

    /// Twice the change along x in a row along x.
    #[inline(always)]
    fn change_along_x<L: Lanes>(&self, place: &LanePlace<L>, aside: i32) -> L::F {
        let (before, at) = self.pair::<L>(L::add_i(place.index, L::splat_i(aside - 1)));
        let (next, beyond) = self.pair::<L>(L::add_i(place.index, L::splat_i(aside + 1)));
        lerp::<L>(L::sub(next, before), L::sub(beyond, at), place.fraction[0])
    }

    #[inline(always)]
    fn pair<L: Lanes>(&self, index: L::I) -> (L::F, L::F) {
        // SAFETY: an owned sample's cell lies between the brick's second and last but two voxels on each axis, so that
        // the cell, and one voxel around it, lie in the brick; padding of four voxels and more follows. Places of
        // samples that are not owned are the brick's voxel (1, 1, 1).
        unsafe { V::pair::<L>(self.voxels.as_ptr(), index) }
    }

    fn strides(&self) -> [i32; 2] {
        [self.edge as i32, (self.edge * self.edge) as i32]
    }
}

/// The voxels around places in a brick.
pub struct Surroundings<'a, L: Lanes, V> {
    pub brick: &'a LaneBrick<'a, V>,
    pub place: LanePlace<L>,
}

impl<L: Lanes, V: LaneVoxel> Slopes<L> for Surroundings<'_, L, V> {
    #[inline(always)]
    fn gradient(&self) -> [L::F; 3] {
        self.brick.gradient::<L>(&self.place)
    }
}

/// a + t·(b − a), which is a where both are equal.
#[inline(always)]
pub fn lerp<L: Lanes>(a: L::F, b: L::F, t: L::F) -> L::F {
    L::mul_add(t, L::sub(b, a), a)
}

/// The cell of a sample along each axis.
#[inline(always)]
fn cell_of<L: Lanes>(sample: &LaneSample<L>) -> [L::F; 3] {
    let per_voxel = L::splat(1.0 / (1 << CELL_EDGE_LOG2) as f32);
    let [x, y, z] = sample.cell;
    [L::floor(L::mul(x, per_voxel)), L::floor(L::mul(y, per_voxel)), L::floor(L::mul(z, per_voxel))]
}
