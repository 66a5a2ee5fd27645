use glassbrick_volume::Occupancy;

use super::brick::{LaneBrick, LaneSample};
use super::lanes::{Lanes, RowLanes};
use super::packet::{Column, LaneSteps, PACKET, Packet};
use super::projection::{Evaluated, Projection, Slopes};
use super::voxel::LaneVoxel;
use crate::kernel::{BrickView, NO_SAMPLE};
use crate::scalar::LookUp;

/// The arithmetic mean of the stored values.
pub struct LaneMean<'a> {
    pub look_up: LookUp<'a>,
}

#[derive(Clone, Copy)]
pub struct MeanState {
    sum: Column,
    /// What the sum lost to rounding (Kahan 1965).
    lost: Column,
    samples: Column,
}

#[derive(Clone, Copy)]
pub struct LaneMeanState<L: Lanes> {
    sum: L::F,
    lost: L::F,
    samples: L::F,
}

impl Projection for LaneMean<'_> {
    type State = MeanState;
    type RowCells<'b> = ();
    type Gathered<L: Lanes> = LaneMeanState<L>;
    type Cells = ();

    const LOOKS_AHEAD: bool = false;

    fn start(&self) -> MeanState {
        MeanState { sum: [0.0; PACKET], lost: [0.0; PACKET], samples: [0.0; PACKET] }
    }

    fn unchanged_by(&self, _packet: &Packet<MeanState>, _reach: [f32; 2]) -> u32 {
        0
    }

    fn cells(&self, _brick: &BrickView) -> Option<()> {
        Some(())
    }

    fn occupancy(_cells: &()) -> Option<&Occupancy> {
        None
    }

    #[inline(always)]
    fn load<L: Lanes>(&self, state: &MeanState, first: usize) -> LaneMeanState<L> {
        LaneMeanState {
            sum: L::load(&state.sum[first..]),
            lost: L::load(&state.lost[first..]),
            samples: L::load(&state.samples[first..]),
        }
    }

    #[inline(always)]
    fn store<L: Lanes>(&self, gathered: &LaneMeanState<L>, state: &mut MeanState, first: usize) {
        L::store(gathered.sum, &mut state.sum[first..]);
        L::store(gathered.lost, &mut state.lost[first..]);
        L::store(gathered.samples, &mut state.samples[first..]);
    }

    #[inline(always)]
    fn add<L: Lanes>(
        &self,
        gathered: &mut LaneMeanState<L>,
        _steps: &LaneSteps<L>,
        evaluated: &Evaluated<L>,
        _slopes: &impl Slopes<L>,
    ) -> L::M {
        let value = L::sub(evaluated.stored, gathered.lost);
        let larger = L::add(gathered.sum, value);
        let lost = L::sub(L::sub(larger, gathered.sum), value);
        gathered.lost = L::select(evaluated.rays, lost, gathered.lost);
        gathered.sum = L::select(evaluated.rays, larger, gathered.sum);
        let one = L::select(evaluated.rays, L::splat(1.0), L::splat(0.0));
        gathered.samples = L::add(gathered.samples, one);
        L::mask(0)
    }

    #[inline(always)]
    fn may_change<L: Lanes>(&self, _gathered: &LaneMeanState<L>, _number: L::F, _reach: [f32; 2]) -> L::M {
        L::mask(u32::MAX)
    }

    fn row_cells<'b>(&self, _brick: &BrickView<'b>) -> Option<()> {
        Some(())
    }

    #[inline(always)]
    fn row_may_change<L: Lanes>(
        &self,
        _cells: &(),
        _cell_row: usize,
        _gathered: &LaneMeanState<L>,
        _number: L::F,
        _rays: L::M,
    ) -> bool {
        true
    }

    #[inline(always)]
    fn cells_may_change<L: RowLanes>(
        &self,
        _cells: &(),
        _cell_row: usize,
        _cell_x: L::I,
        _gathered: &LaneMeanState<L>,
        _number: L::F,
    ) -> L::M {
        L::mask(u32::MAX)
    }

    #[inline(always)]
    fn vacant<L: Lanes, V: LaneVoxel>(
        &self,
        _cells: &(),
        _brick: &LaneBrick<V>,
        _sample: &LaneSample<L>,
        _gathered: &LaneMeanState<L>,
        _number: L::F,
    ) -> (L::M, L::F) {
        (L::mask(0), L::splat(0.0))
    }

    fn finish(&self, state: &MeanState, lane: usize) -> ([f32; 4], u32) {
        let MeanState { sum, lost, samples } = state;
        if samples[lane] == 0.0 {
            return ([0.0; 4], NO_SAMPLE);
        }
        let exact = f64::from(sum[lane]) - f64::from(lost[lane]);
        (self.look_up.projected((exact / f64::from(samples[lane])) as f32), NO_SAMPLE)
    }
}
