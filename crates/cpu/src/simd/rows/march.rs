use glassbrick_volume::{CELL_EDGE_LOG2, PlannedBrick, RowAxis};

use super::super::avx512::Avx512;
use super::super::lanes::Lanes;
use super::super::packet::LaneSteps;
use super::super::projection::{Evaluated, Projection, Slopes};
use super::interpolation::{gradient, value};
use super::registers::Registers;
use super::track::{Run, Step, Track};
use super::voxels::{Place, RowBrick, RowVoxel, SideBySide, Single, corners, surroundings};

type F = <Avx512 as Lanes>::F;
type I = <Avx512 as Lanes>::I;
type M = <Avx512 as Lanes>::M;

/// Bricks that the rays of a packet meet at once, at most.
pub const MOST_ABREAST: usize = 4;

/// So many samples ahead, voxels are asked for from memory.
const AHEAD: usize = 8;

/// Along an edge of a cell.
const CELL_VOXELS: f32 = (1 << CELL_EDGE_LOG2) as f32;

/// A brick of a line and what the projection made of its cells.
pub struct Lined<'a, V, C> {
    pub planned: &'a PlannedBrick,
    pub brick: RowBrick<'a, V>,
    pub cells: C,
}

/// Sixteen rays side by side.
pub struct RowPacket<G> {
    pub start_x: F,
    pub step_x: F,
    pub steps: LaneSteps<Avx512>,
    pub open: M,
    pub gathered: G,
}

impl<G> RowPacket<G> {
    /// Where the samples of a number lie along x: multiplied, then added, as the definition of the picture has it.
    #[inline(always)]
    pub fn x(&self, number: F) -> F {
        Avx512::add(self.start_x, Avx512::mul(number, self.step_x))
    }
}

/// What marching through a section did.
pub struct Marched<const N: usize> {
    /// Samples evaluated.
    pub samples: u64,
    /// Whether any was in each brick.
    pub is_met: [bool; N],
}

/// Adds the samples of some runs in bricks side by side to a packet, but for those of number `but`.
#[inline(always)]
pub fn march<P: Projection, V: RowVoxel, const N: usize>(
    projection: &P,
    packet: &mut RowPacket<P::Gathered<Avx512>>,
    bricks: [&Lined<V, P::RowCells<'_>>; N],
    track: &Track,
    runs: &[Run],
    but: u32,
) -> Marched<N> {
    let mut samples = 0;
    let mut met = [0; N];
    for run in runs {
        if !matters(projection, packet, &bricks, run) {
            continue;
        }
        if P::LOOKS_AHEAD && !comes_to_what_matters(projection, packet, &bricks, run) {
            continue;
        }
        for number in run.numbers.clone() {
            if number == but {
                continue;
            }
            let place = (number - track.first) as usize;
            if let Some(ahead) = track.steps.get(place + AHEAD) {
                for lined in bricks {
                    lined.brick.prefetch(ahead, track.new_rows);
                }
            }
            let step = &track.steps[place];
            let number = Avx512::splat(number as f32);
            let x = packet.x(number);
            let floor = Avx512::floor(x);
            let (voxel_x, fraction_x) = (Avx512::to_i(floor), Avx512::sub(x, floor));
            let mut rays = [0; N];
            let mut all = 0;
            for brick in 0..N {
                let Lined { brick: RowBrick { owned_x: [low, high], .. }, cells, .. } = &bricks[brick];
                let owned =
                    packet.open & Avx512::ge(x, Avx512::splat(*low)) & Avx512::lt(x, Avx512::splat(*high));
                let cell_x = Avx512::shift_right::<CELL_EDGE_LOG2>(bricks[brick].brick.local(voxel_x));
                let gathered = &packet.gathered;
                rays[brick] = owned
                    & projection.cells_may_change::<Avx512>(cells, run.cell_row, cell_x, gathered, number);
                all |= rays[brick];
                met[brick] |= rays[brick];
            }
            if all == 0 {
                continue;
            }
            samples += u64::from(all.count_ones());
            let around = Around { bricks, rays, all, step, voxel_x, fraction_x };
            let evaluated = Evaluated { rays: all, number, stored: around.value() };
            packet.open &=
                !projection.add::<Avx512>(&mut packet.gathered, &packet.steps, &evaluated, &around);
            if packet.open == 0 {
                return Marched { samples, is_met: met.map(|rays| rays != 0) };
            }
        }
    }
    Marched { samples, is_met: met.map(|rays| rays != 0) }
}

/// Whether a run may change any of a packet's rays.
#[inline(always)]
fn matters<P: Projection, V: RowVoxel, const N: usize>(
    projection: &P,
    packet: &RowPacket<P::Gathered<Avx512>>,
    bricks: &[&Lined<V, P::RowCells<'_>>; N],
    run: &Run,
) -> bool {
    let first = Avx512::splat(run.numbers.start as f32);
    let mut matters = false;
    for lined in bricks {
        let (cells, gathered) = (&lined.cells, &packet.gathered);
        matters |= projection.row_may_change::<Avx512>(cells, run.cell_row, gathered, first, packet.open);
    }
    matters
}

/// Whether any of a packet's rays comes to a cell in a run that may change it. Along x, a ray goes from its first sample's
/// cell to its last one's, which is the same or the next; where rays go further, all are taken to matter.
#[inline(always)]
fn comes_to_what_matters<P: Projection, V: RowVoxel, const N: usize>(
    projection: &P,
    packet: &RowPacket<P::Gathered<Avx512>>,
    bricks: &[&Lined<V, P::RowCells<'_>>; N],
    run: &Run,
) -> bool {
    // No closures here: they would not be compiled for these instructions.
    let first = Avx512::splat(run.numbers.start as f32);
    let last = Avx512::splat((run.numbers.end - 1) as f32);
    let (enters, leaves) = (packet.x(first), packet.x(last));
    if Avx512::any(Avx512::gt(Avx512::abs(Avx512::sub(leaves, enters)), Avx512::splat(CELL_VOXELS))) {
        return true;
    }
    let (low_x, high_x) = (Avx512::min(enters, leaves), Avx512::max(enters, leaves));
    let (first_x, last_x) = (Avx512::to_i(Avx512::floor(enters)), Avx512::to_i(Avx512::floor(leaves)));
    let mut rays = 0;
    for Lined { brick, cells, .. } in bricks {
        let [low, high] = brick.owned_x;
        let passes =
            packet.open & Avx512::ge(high_x, Avx512::splat(low)) & Avx512::lt(low_x, Avx512::splat(high));
        let first_cell = Avx512::shift_right::<CELL_EDGE_LOG2>(brick.local(first_x));
        let last_cell = Avx512::shift_right::<CELL_EDGE_LOG2>(brick.local(last_x));
        let gathered = &packet.gathered;
        let cell_row = run.cell_row;
        rays |= passes
            & (projection.cells_may_change::<Avx512>(cells, cell_row, first_cell, gathered, first)
                | projection.cells_may_change::<Avx512>(cells, cell_row, last_cell, gathered, first));
    }
    rays != 0
}

/// The voxels around the samples of one number.
struct Around<'a, V, C, const N: usize> {
    bricks: [&'a Lined<'a, V, C>; N],
    /// The rays whose samples are evaluated, by brick and together.
    rays: [M; N],
    all: M,
    step: &'a Step,
    voxel_x: I,
    fraction_x: F,
}

impl<V: RowVoxel, C, const N: usize> Around<'_, V, C, N> {
    #[inline(always)]
    fn place(&self) -> Place {
        let [y, z] = self.step.fraction;
        Place { row: self.step.row, fraction: [self.fraction_x, Avx512::splat(y), Avx512::splat(z)] }
    }

    /// The one brick that all samples lie in, if there is one.
    #[inline(always)]
    fn single(&self) -> Option<Single<'_, V>> {
        for (lined, rays) in self.bricks.iter().zip(self.rays) {
            if rays == self.all {
                let at = lined.brick.local(self.voxel_x);
                return Some(Single { brick: &lined.brick, at });
            }
        }
        None
    }

    #[inline(always)]
    fn side_by_side(&self) -> SideBySide<'_, V, N> {
        let mut at = [self.voxel_x; N];
        let mut bricks = [&self.bricks[0].brick; N];
        for brick in 0..N {
            bricks[brick] = &self.bricks[brick].brick;
            at[brick] = bricks[brick].local(self.voxel_x);
        }
        SideBySide { bricks, rays: self.rays, at }
    }

    #[inline(always)]
    fn value(&self) -> F {
        let place = self.place();
        let corners = match self.single() {
            Some(single) => corners::<V>(&single, &place),
            None => corners::<V>(&self.side_by_side(), &place),
        };
        V::Registers::to_scale(value(&corners, place.fraction, self.row_axis()))
    }

    #[inline(always)]
    fn row_axis(&self) -> RowAxis {
        self.bricks[0].brick.row_axis
    }
}

impl<V: RowVoxel, C, const N: usize> Slopes<Avx512> for Around<'_, V, C, N> {
    #[inline(always)]
    fn gradient(&self) -> [F; 3] {
        let place = self.place();
        let surroundings = match self.single() {
            Some(single) => surroundings::<V>(&single, &place),
            None => surroundings::<V>(&self.side_by_side(), &place),
        };
        let [x, y, z] = gradient(&surroundings, place.fraction, self.row_axis());
        [V::Registers::to_scale(x), V::Registers::to_scale(y), V::Registers::to_scale(z)]
    }
}
