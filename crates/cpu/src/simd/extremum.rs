use super::brick::{LaneBrick, LaneRays};
use super::lanes::Lanes;
use super::occupancy::Occupancy;
use super::packet::{Column, PACKET, Packet};
use super::projection::Projection;
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

impl Projection for LaneExtremum<'_> {
    type State = ExtremumState;
    /// The largest signed stored value of each cell.
    type Cells = Option<Vec<f32>>;

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
    fn march<L: Lanes, V: LaneVoxel>(
        &self,
        packet: &mut Packet<ExtremumState>,
        first: usize,
        brick: &LaneBrick<V>,
        cells: &Option<Vec<f32>>,
        last_sample: f32,
    ) -> u64 {
        let rays = LaneRays::<L>::load(packet, first);
        let mut open = L::mask(packet.open() >> first);
        let (mut number, last) = brick.interval::<L>(&rays);
        let last = L::min(last, L::splat(last_sample));
        let state = &mut packet.state;
        let mut most = L::load(&state.signed[first..]);
        let mut found = L::load(&state.number[first..]);
        let (zero, one, sign) = (L::splat(0.0), L::splat(1.0), L::splat(self.sign));
        let mut samples = 0;
        loop {
            open = L::both(open, L::ge(last, number));
            if !L::any(open) {
                break;
            }
            let mut sample = brick.sample::<L>(&rays, number, open);
            if let Some(cells) = cells {
                // All rays leap to where they may find more before any is evaluated, so that many are at once.
                loop {
                    // SAFETY: the index is a cell's.
                    let most_in_cell = unsafe { L::gather(cells.as_ptr(), brick.cell_index::<L>(&sample)) };
                    let nearer = L::both(L::ge(most_in_cell, most), L::lt(number, found));
                    let useful = L::either(L::gt(most_in_cell, most), nearer);
                    let vacant = L::but_not(sample.owned, useful);
                    if !L::any(vacant) {
                        break;
                    }
                    let leap = brick.leap::<L>(&rays, &sample, one);
                    number = L::add(number, L::select(vacant, leap, zero));
                    open = L::both(open, L::ge(last, number));
                    sample = brick.sample::<L>(&rays, number, open);
                }
            }
            let evaluated = sample.owned;
            if L::any(evaluated) {
                samples += u64::from(L::mask_bits(evaluated).count_ones());
                let place = brick.place::<L>(&sample);
                let signed = L::mul(sign, brick.value::<L>(&place));
                let nearer = L::both(L::ge(signed, most), L::lt(number, found));
                let more = L::both(evaluated, L::either(L::gt(signed, most), nearer));
                most = L::select(more, signed, most);
                found = L::select(more, number, found);
            }
            number = L::add(number, one);
        }
        L::store(most, &mut state.signed[first..]);
        L::store(found, &mut state.number[first..]);
        samples
    }

    fn finish(&self, packet: &Packet<ExtremumState>, lane: usize) -> ([f32; 4], u32) {
        let number = packet.state.number[lane];
        if number == f32::INFINITY {
            return ([0.0; 4], NO_SAMPLE);
        }
        (self.look_up.projected(self.sign * packet.state.signed[lane]), number as u32)
    }
}

impl LaneExtremum<'_> {
    /// The largest signed value of a range of stored values.
    fn signed(&self, [min, max]: [f32; 2]) -> f32 {
        if self.sign > 0.0 { max } else { -min }
    }
}
