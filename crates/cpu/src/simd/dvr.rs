use glam::Mat3;
use glassbrick_volume::{Band, Phong, Rescale};

use super::brick::{LaneBrick, LaneRays};
use super::functions::{opacity, power};
use super::lanes::Lanes;
use super::look_up::LaneLookUp;
use super::occupancy::Occupancy;
use super::packet::{Column, PACKET, Packet};
use super::projection::Projection;
use super::voxel::LaneVoxel;
use crate::kernel::{BrickView, NO_SAMPLE};

/// Direct volume rendering: emission and absorption, with or without light.
pub struct LaneDvr<'a> {
    pub look_up: LaneLookUp<'a>,
    pub opacity_cutoff: f32,
    pub light: Option<LaneHeadlight>,
    pub bands: Vec<Band>,
    pub rescale: Rescale,
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

impl Projection for LaneDvr<'_> {
    type State = DvrState;
    type Cells = Option<Occupancy>;

    fn start(&self) -> DvrState {
        DvrState { color: [[0.0; PACKET]; 3], opacity: [0.0; PACKET], depth: [NO_SAMPLE as i32; PACKET] }
    }

    fn unchanged_by(&self, packet: &Packet<DvrState>, _reach: [f32; 2]) -> u32 {
        packet.done
    }

    fn cells(&self, brick: &BrickView) -> Option<Option<Occupancy>> {
        if !self.leaps {
            return Some(None);
        }
        let shows = |min: f32, max: f32| {
            let [a, b] = [min, max].map(|stored| self.rescale.value(f64::from(stored)));
            self.bands.iter().any(|band| band.meets(a.min(b), a.max(b)))
        };
        Occupancy::new(brick.brick.cells(), shows).map(Some)
    }

    fn occupancy(cells: &Option<Occupancy>) -> Option<&Occupancy> {
        cells.as_ref()
    }

    #[inline(always)]
    fn march<L: Lanes, V: LaneVoxel>(
        &self,
        packet: &mut Packet<DvrState>,
        first: usize,
        brick: &LaneBrick<V>,
        cells: &Option<Occupancy>,
        last_sample: f32,
    ) -> u64 {
        let rays = LaneRays::<L>::load(packet, first);
        let mut open = L::mask(packet.open() >> first);
        let (mut number, last) = brick.interval::<L>(&rays);
        let last = L::min(last, L::splat(last_sample));
        let state = &mut packet.state;
        let mut color = [0, 1, 2].map(|component| L::load(&state.color[component][first..]));
        let mut gathered = L::load(&state.opacity[first..]);
        let mut depth = L::load_i(&state.depth[first..]);
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let cutoff = L::splat(self.opacity_cutoff);
        let mut samples = 0;
        loop {
            open = L::both(open, L::ge(last, number));
            if !L::any(open) {
                break;
            }
            let mut sample = brick.sample::<L>(&rays, number, open);
            if let Some(occupancy) = cells {
                // All rays leap to where something may be seen before any is evaluated, so that many are at once.
                loop {
                    let index = brick.cell_index::<L>(&sample);
                    // SAFETY: the index is a cell's, and three bytes and more follow the last.
                    let bytes = unsafe { L::gather_bytes(occupancy.distance.as_ptr(), index) };
                    let distance = L::and_i(bytes, L::splat_i(0xFF));
                    let vacant = L::both(sample.owned, L::gt_i(distance, L::splat_i(0)));
                    if !L::any(vacant) {
                        break;
                    }
                    let leap = brick.leap::<L>(&rays, &sample, L::to_f(distance));
                    number = L::add(number, L::select(vacant, leap, zero));
                    open = L::both(open, L::ge(last, number));
                    sample = brick.sample::<L>(&rays, number, open);
                }
            }
            let evaluated = sample.owned;
            if L::any(evaluated) {
                samples += u64::from(L::mask_bits(evaluated).count_ones());
                let place = brick.place::<L>(&sample);
                let entry = self.look_up.entry::<L>(brick.value::<L>(&place));
                let mut seen = L::both(evaluated, self.look_up.may_show::<L>(&entry));
                if L::any(seen) {
                    let extinction = self.look_up.extinction::<L>(&entry);
                    seen = L::both(seen, L::gt(extinction, zero));
                    let alpha = opacity::<L>(L::mul(extinction, rays.step_length_mm));
                    let weight = L::select(seen, L::mul(L::sub(one, gathered), alpha), zero);
                    let mut emitted = self.look_up.color::<L>(&entry);
                    if let Some(light) = &self.light {
                        light.shade::<L>(&mut emitted, brick.gradient::<L>(&place), &rays);
                    }
                    for component in 0..3 {
                        color[component] = L::mul_add(weight, emitted[component], color[component]);
                    }
                    let half = L::splat(0.5);
                    let was_under = L::lt(gathered, half);
                    gathered = L::add(gathered, weight);
                    let crossed = L::both(L::both(seen, was_under), L::ge(gathered, half));
                    depth = L::select_i(crossed, L::to_i(number), depth);
                    open = L::but_not(open, L::both(seen, L::ge(gathered, cutoff)));
                }
            }
            number = L::add(number, one);
        }
        for component in 0..3 {
            L::store(color[component], &mut state.color[component][first..]);
        }
        L::store(gathered, &mut state.opacity[first..]);
        L::store_i(depth, &mut state.depth[first..]);
        packet.done |= L::mask_bits(L::ge(gathered, cutoff)) << first;
        samples
    }

    fn finish(&self, packet: &Packet<DvrState>, lane: usize) -> ([f32; 4], u32) {
        let DvrState { color: [r, g, b], opacity, depth } = &packet.state;
        ([r[lane], g[lane], b[lane], opacity[lane]], depth[lane] as u32)
    }
}

impl LaneHeadlight {
    /// Shades colours by the gradients, in stored values per voxel up to a factor.
    #[inline(always)]
    fn shade<L: Lanes>(&self, color: &mut [L::F; 3], gradient: [L::F; 3], rays: &LaneRays<L>) {
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
        let mut along = L::mul(gradient[0], rays.step[0]);
        along = L::mul_add(gradient[1], rays.step[1], along);
        along = L::mul_add(gradient[2], rays.step[2], along);
        let one = L::splat(1.0);
        let scale = L::mul(L::sqrt(squared_length), rays.step_length_mm);
        let n_dot_l = L::min(L::div(L::abs(along), L::select(has_slope, scale, one)), one);
        let Phong { ambient, diffuse, specular, shininess } = self.phong;
        let factor = L::mul_add(L::splat(diffuse), n_dot_l, L::splat(ambient));
        let term = L::mul(L::splat(specular), power::<L>(n_dot_l, shininess));
        for component in color {
            *component = L::select(has_slope, L::mul_add(*component, factor, term), *component);
        }
    }
}
