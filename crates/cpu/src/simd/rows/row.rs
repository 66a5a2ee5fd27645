use std::slice;

use glassbrick_volume::{PlannedBrick, ReadError};

use super::super::avx512::Avx512;
use super::super::lanes::Lanes;
use super::super::packet::{LaneSteps, PACKET};
use super::super::projection::Projection;
use super::bricks::{Bricks, Prepared};
use super::march::{MOST_ABREAST, RowPacket, march};
use super::rays::{RowRay, RowRays};
use super::track::{Run, Section, Track};
use super::voxels::RowVoxel;
use crate::executor::Picture;
use crate::kernel::NO_SAMPLE;

/// A row of the picture that is being drawn.
pub struct Row<'r, 'a, P: Projection, V> {
    pub projection: &'r P,
    pub picture: &'r Picture<'a>,
    pub bricks: &'r Bricks<'a, P, V>,
    pub rays: &'r RowRays,
    pub track: Track,
    pub ray: RowRay,
}

/// Sixteen or fewer pixels side by side.
#[derive(Clone, Copy)]
pub struct Span {
    pub first: usize,
    pub lanes: usize,
}

impl<'a, P: Projection, V: RowVoxel> Row<'_, 'a, P, V> {
    /// Puts what the rays of a span gather into `state`, unless they meet no brick; how many samples were evaluated. The
    /// samples of number `guess`, if there are any, come before all others.
    ///
    /// # Errors
    /// When a brick cannot be read.
    #[target_feature(enable = "avx512f,avx512bw,avx512vl,popcnt")]
    pub fn draw(
        &self,
        row: u32,
        span: Span,
        guess: u32,
        state: &mut P::State,
    ) -> Result<Option<u64>, ReadError> {
        let mut packet: Option<RowPacket<P::Gathered<Avx512>>> = None;
        let mut samples = 0;
        let guessed = self.track.alone(guess);
        let first = guessed.iter().map(|(section, run)| (*section, slice::from_ref(run), NO_SAMPLE));
        let others = self
            .track
            .sections
            .iter()
            .map(|section| (section, &self.track.runs[section.runs.clone()], guess));
        for (place, (section, runs, but)) in first.chain(others).enumerate() {
            let mut bricks = [None; MOST_ABREAST];
            let mut count = 0;
            for planned in self.planned(section, span) {
                if let Some(packet) = &packet {
                    let reach = self.picture.ranges[planned.index as usize].reach;
                    let number = Avx512::splat(section.numbers.start as f32);
                    let may_change = self.projection.may_change::<Avx512>(&packet.gathered, number, reach);
                    if may_change & packet.open == 0 {
                        continue;
                    }
                }
                if !self.bricks.is_held(planned) {
                    // Those that are held cost no more to try than to look at.
                    if packet.as_ref().is_some_and(|packet| !self.comes_to(packet, section, planned)) {
                        continue;
                    }
                    self.hint(place + 1 - usize::from(guessed.is_some()), span);
                }
                if let Some(lined) = self.bricks.get(self.projection, self.picture, planned)? {
                    bricks[count] = Some(lined);
                    count += 1;
                }
            }
            if count == 0 {
                continue;
            }
            let packet = packet.get_or_insert_with(|| self.start(row, span));
            samples += match bricks {
                [Some(a), None, ..] => self.march(packet, runs, but, [a]),
                [Some(a), Some(b), None, _] => self.march(packet, runs, but, [a, b]),
                [Some(a), Some(b), Some(c), None] => self.march(packet, runs, but, [a, b, c]),
                [Some(a), Some(b), Some(c), Some(d)] => self.march(packet, runs, but, [a, b, c, d]),
                [None, ..] => 0,
            };
            if packet.open == 0 {
                break;
            }
        }
        Ok(packet.map(|packet| {
            self.projection.store::<Avx512>(&packet.gathered, state, 0);
            samples
        }))
    }

    /// Whether any ray of a packet that takes more samples may have one of a section's in a brick.
    #[inline(always)]
    fn comes_to(
        &self,
        packet: &RowPacket<P::Gathered<Avx512>>,
        section: &Section,
        planned: &PlannedBrick,
    ) -> bool {
        let at = self.picture.grid.brick_along(planned.index as usize, self.picture.row_axis);
        let [low, high] = self.bricks.grid.owned_box(at).map(|corner| corner.x);
        let enters = packet.x(Avx512::splat(section.numbers.start as f32));
        let leaves = packet.x(Avx512::splat((section.numbers.end - 1) as f32));
        let (first, last) = (Avx512::min(enters, leaves), Avx512::max(enters, leaves));
        packet.open & Avx512::ge(last, Avx512::splat(low)) & Avx512::lt(first, Avx512::splat(high)) != 0
    }

    /// Adds the samples of some runs of a section in its bricks to the rays of a packet; returns how many were evaluated.
    #[inline(always)]
    fn march<const N: usize>(
        &self,
        packet: &mut RowPacket<P::Gathered<Avx512>>,
        runs: &[Run],
        but: u32,
        bricks: [&Prepared<'a, P, V>; N],
    ) -> u64 {
        let marched = march(self.projection, packet, bricks, &self.track, runs, but);
        for (lined, is_met) in bricks.iter().zip(marched.is_met) {
            self.picture.is_rendered_if(lined.planned, is_met);
        }
        marched.samples
    }

    /// Tells where bricks come from which ones the next section may need.
    fn hint(&self, section: usize, span: Span) {
        let section = self.track.sections.get(section);
        let bricks = section.into_iter().flat_map(|section| self.planned(section, span));
        self.picture.will_need(bricks.filter(|planned| !self.bricks.is_held(planned)));
    }

    /// The rays of a span, which have met no sample.
    #[target_feature(enable = "avx512f,avx512bw,avx512vl,popcnt")]
    fn start(&self, row: u32, Span { first, lanes }: Span) -> RowPacket<P::Gathered<Avx512>> {
        let turn = self.rays.turn;
        let mut length_mm = [1.0; PACKET];
        for (column, length_mm) in (first..first + lanes).zip(&mut length_mm) {
            let [column, row] = turn.of_picture([column as u32, row]);
            *length_mm = self.picture.scene.rays.step_length_mm(column, row);
        }
        let [step_y, step_z] = self.ray.step;
        let step_x = Avx512::load(&self.rays.step_x[first..]);
        RowPacket {
            start_x: Avx512::load(&self.rays.start_x[first..]),
            step_x,
            steps: LaneSteps {
                voxels: turn.row_axis.swapped([step_x, Avx512::splat(step_y), Avx512::splat(step_z)]),
                length_mm: Avx512::load(&length_mm),
            },
            open: Avx512::mask((1 << lanes) - 1),
            gathered: self.projection.load::<Avx512>(&self.projection.start(), 0),
        }
    }

    /// The planned bricks of a section that the rays of a span can meet.
    fn planned(&self, section: &Section, span: Span) -> impl Iterator<Item = &'a PlannedBrick> {
        let ends = [section.numbers.start, section.numbers.end - 1].map(|number| number as f32);
        let outermost = [span.first, span.first + span.lanes - 1];
        let (mut low, mut high) = (f32::INFINITY, f32::NEG_INFINITY);
        for column in outermost {
            for number in ends {
                let x = self.rays.start_x[column] + number * self.rays.step_x[column];
                (low, high) = (low.min(x), high.max(x));
            }
        }
        let line = self.bricks.line(section.line);
        let core = self.picture.grid.layout.core() as f32;
        // Positions beyond the volume meet no brick, but looking at one more does no harm.
        let brick_at = |x: f32| (((x + 0.5) / core).max(0.0) as usize).min(line.len() - 1);
        line[brick_at(low)..=brick_at(high)].iter().copied().flatten()
    }
}
