use glassbrick_volume::Occupancy;

use super::brick::{LaneBrick, LaneSample};
use super::lanes::{Lanes, RowLanes};
use super::packet::{LaneSteps, Packet};
use super::voxel::LaneVoxel;
use crate::kernel::BrickView;

/// One way to form pixels from packets of rays.
pub trait Projection: Sync {
    /// What the rays of a packet have gathered.
    type State: Copy + Send;
    /// What is found out of a brick's cells before its rays are marched.
    type Cells: Send + Sync;
    /// What is found out of a brick's cells where rays go along its rows.
    type RowCells<'b>: Send + Sync;
    /// What vectors of rays have gathered.
    type Gathered<L: Lanes>: Copy;

    /// Whether, where rays go along rows, it pays to look at a run's cells before its samples: where that takes a bit each.
    const LOOKS_AHEAD: bool;

    fn start(&self) -> Self::State;

    /// The rays that samples with stored values in [min, max] cannot change, by bit.
    fn unchanged_by(&self, packet: &Packet<Self::State>, reach: [f32; 2]) -> u32;

    /// Which bricks are best drawn first, or nothing where they must come front to back.
    fn rank(&self, _reach: [f32; 2]) -> Option<f32> {
        None
    }

    /// Whether it pays to begin with the sample that decided a neighbour's pixel: where samples may come in any order, and one
    /// tells what need not be looked at.
    fn guesses(&self) -> bool {
        false
    }

    /// Looks at a brick's cells; nothing where the brick holds nothing to draw.
    fn cells(&self, brick: &BrickView) -> Option<Self::Cells>;

    /// Which cells rays need to search at all.
    fn occupancy(cells: &Self::Cells) -> Option<&Occupancy>;

    /// What rays have gathered, from lane `first` on.
    fn load<L: Lanes>(&self, state: &Self::State, first: usize) -> Self::Gathered<L>;

    /// Puts back what `load` took.
    fn store<L: Lanes>(&self, gathered: &Self::Gathered<L>, state: &mut Self::State, first: usize);

    /// Adds a sample to each of some rays; returns the rays that take no more.
    fn add<L: Lanes>(
        &self,
        gathered: &mut Self::Gathered<L>,
        steps: &LaneSteps<L>,
        evaluated: &Evaluated<L>,
        slopes: &impl Slopes<L>,
    ) -> L::M;

    /// The rays that samples from `number` on with stored values in [min, max] may change.
    fn may_change<L: Lanes>(&self, gathered: &Self::Gathered<L>, number: L::F, reach: [f32; 2]) -> L::M;

    /// Looks at a brick's cells where rays go along its rows; nothing where the brick holds nothing to draw.
    fn row_cells<'b>(&self, brick: &BrickView<'b>) -> Option<Self::RowCells<'b>>;

    /// Whether samples from `number` on in a row of cells may change any of the rays.
    fn row_may_change<L: Lanes>(
        &self,
        cells: &Self::RowCells<'_>,
        cell_row: usize,
        gathered: &Self::Gathered<L>,
        number: L::F,
        rays: L::M,
    ) -> bool;

    /// The rays that samples in these cells of a row may change.
    fn cells_may_change<L: RowLanes>(
        &self,
        cells: &Self::RowCells<'_>,
        cell_row: usize,
        cell_x: L::I,
        gathered: &Self::Gathered<L>,
        number: L::F,
    ) -> L::M;

    /// The rays whose samples lie in cells of a brick that cannot change them, and how far each may leap: beyond the cells
    /// that are nearer than this to its own.
    fn vacant<L: Lanes, V: LaneVoxel>(
        &self,
        cells: &Self::Cells,
        brick: &LaneBrick<V>,
        sample: &LaneSample<L>,
        gathered: &Self::Gathered<L>,
        number: L::F,
    ) -> (L::M, L::F);

    /// Premultiplied linear light of a ray, and the sample number that its depth is taken from.
    fn finish(&self, state: &Self::State, lane: usize) -> ([f32; 4], u32);
}

/// One sample of each of some rays.
pub struct Evaluated<L: Lanes> {
    pub rays: L::M,
    pub number: L::F,
    pub stored: L::F,
}

/// What can be asked of the voxels around samples.
pub trait Slopes<L: Lanes> {
    /// Twice the change of the stored value per voxel along each axis, by central differences of one voxel: only the
    /// direction counts.
    fn gradient(&self) -> [L::F; 3];
}
