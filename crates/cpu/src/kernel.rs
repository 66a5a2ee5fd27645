use glam::{IVec3, Vec3};
use glassbrick_volume::{Brick, BrickGrid, BrickRange, FrameRays, PixelRect, PlannedBrick};

/// How tiles of the picture are drawn: the code for one way to form pixels with one set of instructions.
pub trait Kernel: Sync {
    /// The rays of a tile and what they have gathered so far.
    type Tile: Send;

    /// What is found out of a brick before its tiles are drawn.
    type Prepared<'a>: Send + Sync;

    /// A tile that has met no sample.
    fn start(&self, rays: &FrameRays, rect: PixelRect) -> Self::Tile;

    /// Whether samples with stored values in `reach` cannot change any of the pixels of a tile that lie in `rect`.
    fn is_unchanged_by(&self, tile: &Self::Tile, rect: &PixelRect, reach: [f32; 2]) -> bool;

    /// Looks at a brick; nothing where it holds nothing to draw.
    fn prepare<'a>(&self, brick: BrickView<'a>) -> Option<Self::Prepared<'a>>;

    /// Adds a brick's samples to the pixels of a tile; returns how many were evaluated.
    fn add_brick(&self, tile: &mut Self::Tile, brick: &Self::Prepared<'_>) -> u64;

    /// Which bricks are best drawn first where the order does not matter to the pixels: those of the largest rank.
    /// Nothing where bricks must come front to back.
    fn rank(&self, reach: [f32; 2]) -> Option<f32>;

    /// Hands out each pixel of a tile, row by row: premultiplied linear light, and the sample number that its depth
    /// is taken from, or [`NO_SAMPLE`].
    fn finish(&self, tile: &Self::Tile, pixel: impl FnMut([f32; 4], u32));
}

/// The sample number of a pixel that has no depth.
pub const NO_SAMPLE: u32 = u32::MAX;

/// A brick and its place in the frame.
#[derive(Clone, Copy)]
pub struct BrickView<'a> {
    pub brick: &'a Brick,
    /// Its place in the grid.
    pub index: u32,
    /// The pixels that can meet it.
    pub footprint: PixelRect,
    /// The volume's voxel that is the brick's first, along the brick's axes.
    pub halo_start: IVec3,
    /// The half-open box of sample positions that belong to it, along the brick's axes.
    pub owned: [Vec3; 2],
    /// Smallest and largest stored value that a sample in it can have.
    pub reach: [f32; 2],
}

impl<'a> BrickView<'a> {
    pub fn new(brick: &'a Brick, planned: &PlannedBrick, grid: &BrickGrid, range: &BrickRange) -> Self {
        let at = grid.brick_along(planned.index as usize, brick.row_axis);
        let grid = grid.along(brick.row_axis);
        Self {
            brick,
            index: planned.index,
            footprint: planned.footprint,
            halo_start: grid.halo_start(at),
            owned: grid.owned_box(at),
            reach: range.reach,
        }
    }
}

/// The pixels that two rectangles have in common.
pub fn common(a: &PixelRect, b: &PixelRect) -> Option<PixelRect> {
    a.overlaps(b).then(|| PixelRect {
        min: [0, 1].map(|axis| a.min[axis].max(b.min[axis])),
        max: [0, 1].map(|axis| a.max[axis].min(b.max[axis])),
    })
}
