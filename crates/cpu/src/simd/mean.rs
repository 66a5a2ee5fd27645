use super::brick::{LaneBrick, LaneRays};
use super::lanes::Lanes;
use super::occupancy::Occupancy;
use super::packet::{Column, PACKET, Packet};
use super::projection::Projection;
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

impl Projection for LaneMean<'_> {
    type State = MeanState;
    type Cells = ();

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
    fn march<L: Lanes, V: LaneVoxel>(
        &self,
        packet: &mut Packet<MeanState>,
        first: usize,
        brick: &LaneBrick<V>,
        _cells: &(),
        last_sample: f32,
    ) -> u64 {
        let rays = LaneRays::<L>::load(packet, first);
        let mut open = L::mask(packet.open() >> first);
        let (mut number, last) = brick.interval::<L>(&rays);
        let last = L::min(last, L::splat(last_sample));
        let state = &mut packet.state;
        let mut sum = L::load(&state.sum[first..]);
        let mut lost = L::load(&state.lost[first..]);
        let mut counted = L::load(&state.samples[first..]);
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let mut samples = 0;
        loop {
            open = L::both(open, L::ge(last, number));
            if !L::any(open) {
                break;
            }
            let sample = brick.sample::<L>(&rays, number, open);
            let place = brick.place::<L>(&sample);
            samples += u64::from(L::mask_bits(sample.owned).count_ones());
            let value = L::sub(brick.value::<L>(&place), lost);
            let larger = L::add(sum, value);
            lost = L::select(sample.owned, L::sub(L::sub(larger, sum), value), lost);
            sum = L::select(sample.owned, larger, sum);
            counted = L::add(counted, L::select(sample.owned, one, zero));
            number = L::add(number, one);
        }
        L::store(sum, &mut state.sum[first..]);
        L::store(lost, &mut state.lost[first..]);
        L::store(counted, &mut state.samples[first..]);
        samples
    }

    fn finish(&self, packet: &Packet<MeanState>, lane: usize) -> ([f32; 4], u32) {
        let MeanState { sum, lost, samples } = &packet.state;
        if samples[lane] == 0.0 {
            return ([0.0; 4], NO_SAMPLE);
        }
        let exact = f64::from(sum[lane]) - f64::from(lost[lane]);
        (self.look_up.projected((exact / f64::from(samples[lane])) as f32), NO_SAMPLE)
    }
}
