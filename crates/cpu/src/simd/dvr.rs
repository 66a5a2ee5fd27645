use glam::Mat3;
use glassbrick_volume::{Occupancy, Phong, ShownValues};

use super::brick::{LaneBrick, LaneSample};
use super::functions::{opacity, power};
use super::lanes::{Lanes, RowLanes};
use super::look_up::LaneLookUp;
use super::occupied_rows::OccupiedRows;
use super::packet::{Column, LaneSteps, PACKET, Packet};
use super::projection::{Evaluated, Projection, Slopes};
use super::shown_cells::ShownCells;
use super::voxel::LaneVoxel;
use crate::kernel::{BrickView, NO_SAMPLE};

/// Direct volume rendering: emission and absorption, with or without light.
pub struct LaneDvr<'a> {
    pub look_up: LaneLookUp,
    pub opacity_cutoff: f32,
    pub light: Option<LaneHeadlight>,
    pub shown: ShownValues,
    pub shown_cells: &'a ShownCells,
    /// Whether cells in which nothing can be seen are leapt over.
    pub leaps: bool,
}

/// Light from the eye on the surfaces of the volume.
pub struct LaneHeadlight {
    pub phong: Phong,
    /// Takes gradients per voxel to world space, up to a common factor.
    pub normal_from_gradient: Mat3,
}

#[derive(Clone, Copy)]
pub struct DvrState {
    color: [Column; 3],
    opacity: Column,
    depth: [i32; PACKET],
}

#[derive(Clone, Copy)]
pub struct LaneDvrState<L: Lanes> {
    color: [L::F; 3],
    opacity: L::F,
    depth: L::I,
}

impl<'a> Projection for LaneDvr<'a> {
    type State = DvrState;
    type Cells = Option<&'a Occupancy>;
    type RowCells<'b> = &'a OccupiedRows;
    type Gathered<L: Lanes> = LaneDvrState<L>;

    const LOOKS_AHEAD: bool = true;

    fn start(&self) -> DvrState {
        DvrState { color: [[0.0; PACKET]; 3], opacity: [0.0; PACKET], depth: [NO_SAMPLE as i32; PACKET] }
    }

    fn unchanged_by(&self, packet: &Packet<DvrState>, _reach: [f32; 2]) -> u32 {
        packet.done
    }

    fn cells(&self, brick: &BrickView) -> Option<Option<&'a Occupancy>> {
        if !self.leaps {
            return Some(None);
        }
        let find = || Occupancy::new(brick.brick.cells(), |min, max| self.shown.meets(min, max));
        self.shown_cells.occupancy(brick.index, find).map(Some)
    }

    fn occupancy<'b>(cells: &'b Option<&'a Occupancy>) -> Option<&'b Occupancy> {
        *cells
    }

    #[inline(always)]
    fn load<L: Lanes>(&self, state: &DvrState, first: usize) -> LaneDvrState<L> {
        LaneDvrState {
            color: [0, 1, 2].map(|component| L::load(&state.color[component][first..])),
            opacity: L::load(&state.opacity[first..]),
            depth: L::load_i(&state.depth[first..]),
        }
    }

    #[inline(always)]
    fn store<L: Lanes>(&self, gathered: &LaneDvrState<L>, state: &mut DvrState, first: usize) {
        for component in 0..3 {
            L::store(gathered.color[component], &mut state.color[component][first..]);
        }
        L::store(gathered.opacity, &mut state.opacity[first..]);
        L::store_i(gathered.depth, &mut state.depth[first..]);
    }

    #[inline(always)]
    fn add<L: Lanes>(
        &self,
        gathered: &mut LaneDvrState<L>,
        steps: &LaneSteps<L>,
        evaluated: &Evaluated<L>,
        slopes: &impl Slopes<L>,
    ) -> L::M {
        let (zero, half, one) = (L::splat(0.0), L::splat(0.5), L::splat(1.0));
        let entry = self.look_up.entry::<L>(evaluated.stored);
        let seen = L::both(evaluated.rays, self.look_up.may_show::<L>(&entry));
        if !L::any(seen) {
            return seen;
        }
        let [r, g, b, extinction] = self.look_up.light_and_extinction::<L>(&entry, seen);
        let seen = L::both(seen, L::gt(extinction, zero));
        let alpha = opacity::<L>(L::mul(extinction, steps.length_mm));
        let before = gathered.opacity;
        let weight = L::select(seen, L::mul(L::sub(one, before), alpha), zero);
        let mut emitted = [r, g, b];
        if let Some(light) = &self.light {
            light.shade::<L>(&mut emitted, slopes.gradient(), steps);
        }
        for component in 0..3 {
            gathered.color[component] = L::mul_add(weight, emitted[component], gathered.color[component]);
        }
        let after = L::add(before, weight);
        gathered.opacity = after;
        let crossed = L::both(L::both(seen, L::lt(before, half)), L::ge(after, half));
        gathered.depth = L::select_i(crossed, L::to_i(evaluated.number), gathered.depth);
        L::both(seen, L::ge(after, L::splat(self.opacity_cutoff)))
    }

    #[inline(always)]
    fn may_change<L: Lanes>(&self, _gathered: &LaneDvrState<L>, _number: L::F, _reach: [f32; 2]) -> L::M {
        L::mask(u32::MAX)
    }

    fn row_cells<'b>(&self, brick: &BrickView<'b>) -> Option<&'a OccupiedRows> {
        if !self.leaps {
            return Some(&self.shown_cells.all_rows);
        }
        let find = || OccupiedRows::new(brick.brick.cells(), |min, max| self.shown.meets(min, max));
        self.shown_cells.rows(brick.index, brick.brick.row_axis, find)
    }

    #[inline(always)]
    fn row_may_change<L: Lanes>(
        &self,
        cells: &&'a OccupiedRows,
        cell_row: usize,
        _gathered: &LaneDvrState<L>,
        _number: L::F,
        _rays: L::M,
    ) -> bool {
        cells.rows[cell_row] != 0
    }

    #[inline(always)]
    fn cells_may_change<L: RowLanes>(
        &self,
        cells: &&'a OccupiedRows,
        cell_row: usize,
        cell_x: L::I,
        _gathered: &LaneDvrState<L>,
        _number: L::F,
    ) -> L::M {
        L::bits_at(cells.rows[cell_row], cell_x)
    }

    #[inline(always)]
    fn vacant<L: Lanes, V: LaneVoxel>(
        &self,
        cells: &Option<&'a Occupancy>,
        brick: &LaneBrick<V>,
        sample: &LaneSample<L>,
        _gathered: &LaneDvrState<L>,
        _number: L::F,
    ) -> (L::M, L::F) {
        let Some(occupancy) = cells else { return (L::mask(0), L::splat(0.0)) };
        let index = brick.cell_index::<L>(sample);
        // SAFETY: the index is a cell's, and three bytes and more follow the last.
        let bytes = unsafe { L::gather_bytes(occupancy.distance.as_ptr(), index) };
        let distance = L::and_i(bytes, L::splat_i(0xFF));
        (L::both(sample.owned, L::gt_i(distance, L::splat_i(0))), L::to_f(distance))
    }

    fn finish(&self, state: &DvrState, lane: usize) -> ([f32; 4], u32) {
        let DvrState { color: [r, g, b], opacity, depth } = state;
        ([r[lane], g[lane], b[lane], opacity[lane]], depth[lane] as u32)
    }
}

impl LaneHeadlight {
    /// Shades colours by the gradients, in stored values per voxel up to a factor.
    #[inline(always)]
    fn shade<L: Lanes>(&self, color: &mut [L::F; 3], gradient: [L::F; 3], steps: &LaneSteps<L>) {
        let normal_from_gradient = self.normal_from_gradient.to_cols_array_2d();
        let mut squared_length = L::splat(0.0);
        for row in 0..3 {
            let mut normal = L::mul(L::splat(normal_from_gradient[0][row]), gradient[0]);
            normal = L::mul_add(L::splat(normal_from_gradient[1][row]), gradient[1], normal);
            normal = L::mul_add(L::splat(normal_from_gradient[2][row]), gradient[2], normal);
            squared_length = L::mul_add(normal, normal, squared_length);
        }
        let has_slope = L::gt(squared_length, L::splat(0.0));
        // n·l without leaving voxel space: the gradient along the ray is the same in every space.
        let mut along = L::mul(gradient[0], steps.voxels[0]);
        along = L::mul_add(gradient[1], steps.voxels[1], along);
        along = L::mul_add(gradient[2], steps.voxels[2], along);
        let one = L::splat(1.0);
        let scale = L::mul(L::sqrt(squared_length), steps.length_mm);
        let n_dot_l = L::min(L::div(L::abs(along), L::select(has_slope, scale, one)), one);
        let Phong { ambient, diffuse, specular, shininess } = self.phong;
        let factor = L::mul_add(L::splat(diffuse), n_dot_l, L::splat(ambient));
        let term = L::mul(L::splat(specular), power::<L>(n_dot_l, shininess));
        for component in color {
            *component = L::select(has_slope, L::mul_add(*component, factor, term), *component);
        }
    }
}
