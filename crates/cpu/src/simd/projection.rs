use super::brick::LaneBrick;
use super::lanes::Lanes;
use super::occupancy::Occupancy;
use super::packet::Packet;
use super::voxel::LaneVoxel;
use crate::kernel::BrickView;

/// One way to form pixels from packets of rays.
pub trait Projection: Sync {
    /// What the rays of a packet have gathered.
    type State: Copy + Send;
    /// What is found out of a brick's cells before its rays are marched.
    type Cells: Send + Sync;

    fn start(&self) -> Self::State;

    /// The rays that samples with stored values in [min, max] cannot change, by bit.
    fn unchanged_by(&self, packet: &Packet<Self::State>, reach: [f32; 2]) -> u32;

    /// Which bricks are best drawn first, or nothing where they must come front to back.
    fn rank(&self, _reach: [f32; 2]) -> Option<f32> {
        None
    }

    /// Looks at a brick's cells; nothing where the brick holds nothing to draw.
    fn cells(&self, brick: &BrickView) -> Option<Self::Cells>;

    /// Which cells rays need to search at all.
    fn occupancy(cells: &Self::Cells) -> Option<&Occupancy>;

    /// Adds a brick's samples, up to number `last_sample`, to the rays of a packet from lane `first` on; returns how
    /// many were evaluated.
    fn march<L: Lanes, V: LaneVoxel>(
        &self,
        packet: &mut Packet<Self::State>,
        first: usize,
        brick: &LaneBrick<V>,
        cells: &Self::Cells,
        last_sample: f32,
    ) -> u64;

    /// Premultiplied linear light of a ray, and the sample number that its depth is taken from.
    fn finish(&self, packet: &Packet<Self::State>, lane: usize) -> ([f32; 4], u32);
}
