use super::brick::{LaneBrick, LaneRays, Surroundings};
use super::lanes::Lanes;
use super::packet::Packet;
use super::projection::{Evaluated, Projection};
use super::voxel::LaneVoxel;

/// Adds a brick's samples, up to number `last_sample`, to the rays of a packet from lane `first` on; returns how
/// many were evaluated.
#[inline(always)]
pub fn march<P: Projection, L: Lanes, V: LaneVoxel>(
    projection: &P,
    packet: &mut Packet<P::State>,
    first: usize,
    brick: &LaneBrick<V>,
    cells: &P::Cells,
    last_sample: f32,
) -> u64 {
    let rays = LaneRays::<L>::load(packet, first);
    let mut open = L::mask(packet.open() >> first);
    let (mut number, last) = brick.interval::<L>(&rays);
    let last = L::min(last, L::splat(last_sample));
    let mut gathered = projection.load::<L>(&packet.state, first);
    let (zero, one) = (L::splat(0.0), L::splat(1.0));
    let mut samples = 0;
    let mut done = L::mask(0);
    loop {
        open = L::both(open, L::ge(last, number));
        if !L::any(open) {
            break;
        }
        let mut sample = brick.sample::<L>(&rays, number, open);
        // All rays leap to where they may be changed before any is evaluated, so that many are at once.
        loop {
            let (vacant, distance) = projection.vacant(cells, brick, &sample, &gathered, number);
            if !L::any(vacant) {
                break;
            }
            let leap = brick.leap::<L>(&rays, &sample, distance);
            number = L::add(number, L::select(vacant, leap, zero));
            open = L::both(open, L::ge(last, number));
            sample = brick.sample::<L>(&rays, number, open);
        }
        if L::any(sample.owned) {
            samples += u64::from(L::mask_bits(sample.owned).count_ones());
            let place = brick.place::<L>(&sample);
            let evaluated = Evaluated { rays: sample.owned, number, stored: brick.value::<L>(&place) };
            let surroundings = Surroundings { brick, place };
            let closed = projection.add::<L>(&mut gathered, &rays.steps, &evaluated, &surroundings);
            open = L::but_not(open, closed);
            done = L::either(done, closed);
        }
        number = L::add(number, one);
    }
    projection.store::<L>(&gathered, &mut packet.state, first);
    packet.done |= L::mask_bits(done) << first;
    samples
}
