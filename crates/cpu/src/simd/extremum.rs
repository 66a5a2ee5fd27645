use glassbrick_volume::Occupancy;

use super::brick::{LaneBrick, LaneSample};
use super::lanes::{Lanes, RowLanes};
use super::packet::{Column, LaneSteps, PACKET, Packet};
use super::projection::{Evaluated, Projection, Slopes};
use super::voxel::LaneVoxel;
use crate::kernel::{BrickView, NO_SAMPLE};
use crate::scalar::LookUp;

/// Maximum and minimum intensity projection, of stored values.
pub struct LaneExtremum<'a> {
    pub look_up: LookUp<'a>,
    /// 1 to look for the largest stored value, −1 for the smallest.
    pub sign: f32,
    /// Whether cells that cannot change a ray's pixel are leapt over.
    pub leaps: bool,
}

#[derive(Clone, Copy)]
pub struct ExtremumState {
    /// The stored value times the sign; −∞ before the first sample.
    signed: Column,
    /// Of the first sample that has it; +∞ before the first sample.
    number: Column,
}

#[derive(Clone, Copy)]
pub struct LaneExtremumState<L: Lanes> {
    most: L::F,
    number: L::F,
}

impl<L: Lanes> LaneExtremumState<L> {
    /// The rays that a signed value at a sample changes; bricks come in any order, so an equal value may be nearer.
    #[inline(always)]
    fn gains_by(&self, signed: L::F, number: L::F) -> L::M {
        let nearer = L::both(L::ge(signed, self.most), L::lt(number, self.number));
        L::either(L::gt(signed, self.most), nearer)
    }
}

/// The extremal stored values of a brick's cells.
pub struct MostOfRows<'b> {
    /// Of each cell, x fastest.
    stored: &'b [f32],
    edge: usize,
    /// Signed, of each row of cells.
    most: Vec<f32>,
}

impl Projection for LaneExtremum<'_> {
    type State = ExtremumState;
    type RowCells<'b> = MostOfRows<'b>;
    type Gathered<L: Lanes> = LaneExtremumState<L>;
    /// The largest signed stored value of each cell.
    type Cells = Option<Vec<f32>>;

    const LOOKS_AHEAD: bool = false;

    fn start(&self) -> ExtremumState {
        ExtremumState { signed: [f32::NEG_INFINITY; PACKET], number: [f32::INFINITY; PACKET] }
    }

    fn unchanged_by(&self, packet: &Packet<ExtremumState>, [min, max]: [f32; 2]) -> u32 {
        // Bricks come in any order: an equal value may be nearer.
        let most = self.signed([min, max]);
        let signed = packet.state.signed.iter().enumerate();
        signed.fold(0, |rays, (lane, &signed)| rays | u32::from(signed > most) << lane)
    }

    fn rank(&self, reach: [f32; 2]) -> Option<f32> {
        Some(self.signed(reach))
    }

    fn guesses(&self) -> bool {
        self.leaps
    }

    fn cells(&self, brick: &BrickView) -> Option<Option<Vec<f32>>> {
        let cells = || {
            let cells = brick.brick.cells();
            if self.sign > 0.0 { cells.max.clone() } else { cells.min.iter().map(|&min| -min).collect() }
        };
        Some(self.leaps.then(cells))
    }

    fn occupancy(_cells: &Option<Vec<f32>>) -> Option<&Occupancy> {
        None
    }

    #[inline(always)]
    fn load<L: Lanes>(&self, state: &ExtremumState, first: usize) -> LaneExtremumState<L> {
        LaneExtremumState { most: L::load(&state.signed[first..]), number: L::load(&state.number[first..]) }
    }

    #[inline(always)]
    fn store<L: Lanes>(&self, gathered: &LaneExtremumState<L>, state: &mut ExtremumState, first: usize) {
        L::store(gathered.most, &mut state.signed[first..]);
        L::store(gathered.number, &mut state.number[first..]);
    }

    #[inline(always)]
    fn add<L: Lanes>(
        &self,
        gathered: &mut LaneExtremumState<L>,
        _steps: &LaneSteps<L>,
        evaluated: &Evaluated<L>,
        _slopes: &impl Slopes<L>,
    ) -> L::M {
        let signed = L::mul(L::splat(self.sign), evaluated.stored);
        let more = L::both(evaluated.rays, gathered.gains_by(signed, evaluated.number));
        gathered.most = L::select(more, signed, gathered.most);
        gathered.number = L::select(more, evaluated.number, gathered.number);
        L::mask(0)
    }

    #[inline(always)]
    fn may_change<L: Lanes>(&self, gathered: &LaneExtremumState<L>, number: L::F, reach: [f32; 2]) -> L::M {
        self.if_leaping::<L>(gathered.gains_by(L::splat(self.signed(reach)), number))
    }

    fn row_cells<'b>(&self, brick: &BrickView<'b>) -> Option<MostOfRows<'b>> {
        let cells = brick.brick.cells();
        let stored = if self.sign > 0.0 { &cells.max } else { &cells.min };
        let most = |row: &[f32]| row.iter().map(|&cell| self.sign * cell).fold(f32::NEG_INFINITY, f32::max);
        Some(MostOfRows {
            stored,
            edge: cells.edge,
            most: stored.chunks_exact(cells.edge).map(most).collect(),
        })
    }

    #[inline(always)]
    fn row_may_change<L: Lanes>(
        &self,
        cells: &MostOfRows,
        cell_row: usize,
        gathered: &LaneExtremumState<L>,
        number: L::F,
        rays: L::M,
    ) -> bool {
        let gains = gathered.gains_by(L::splat(cells.most[cell_row]), number);
        L::any(L::both(rays, self.if_leaping::<L>(gains)))
    }

    #[inline(always)]
    fn cells_may_change<L: RowLanes>(
        &self,
        cells: &MostOfRows,
        cell_row: usize,
        cell_x: L::I,
        gathered: &LaneExtremumState<L>,
        number: L::F,
    ) -> L::M {
        let stored = L::pick(&cells.stored[cell_row * cells.edge..][..cells.edge], cell_x);
        self.if_leaping::<L>(gathered.gains_by(L::mul(L::splat(self.sign), stored), number))
    }

    #[inline(always)]
    fn vacant<L: Lanes, V: LaneVoxel>(
        &self,
        cells: &Option<Vec<f32>>,
        brick: &LaneBrick<V>,
        sample: &LaneSample<L>,
        gathered: &LaneExtremumState<L>,
        number: L::F,
    ) -> (L::M, L::F) {
        let Some(cells) = cells else { return (L::mask(0), L::splat(0.0)) };
        // SAFETY: the index is a cell's.
        let most_in_cell = unsafe { L::gather(cells.as_ptr(), brick.cell_index::<L>(sample)) };
        (L::but_not(sample.owned, gathered.gains_by(most_in_cell, number)), L::splat(1.0))
    }

    fn finish(&self, state: &ExtremumState, lane: usize) -> ([f32; 4], u32) {
        let number = state.number[lane];
        if number == f32::INFINITY {
            return ([0.0; 4], NO_SAMPLE);
        }
        (self.look_up.projected(self.sign * state.signed[lane]), number as u32)
    }
}

impl LaneExtremum<'_> {
    /// These rays, or all where nothing is leapt over.
    #[inline(always)]
    fn if_leaping<L: Lanes>(&self, rays: L::M) -> L::M {
        if self.leaps { rays } else { L::mask(u32::MAX) }
    }

    /// The largest signed value of a range of stored values.
    fn signed(&self, [min, max]: [f32; 2]) -> f32 {
        if self.sign > 0.0 { max } else { -min }
    }
}
