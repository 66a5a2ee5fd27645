use glam::{IVec3, UVec3};

/// How a volume is cut: bricks of `edge`³ voxels, of which a halo on every side repeats the neighbours' voxels.
///
/// What is between the halos is the core, and cores tile the volume. Voxels of a brick beyond the volume repeat
/// the volume's edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct BrickLayout {
    /// Voxels along each axis of a brick, halo included.
    pub edge: u32,
    /// Voxels of halo on each side; 2 serves central differences everywhere in the core.
    pub halo: u32,
}

impl Default for BrickLayout {
    fn default() -> Self {
        Self { edge: 64, halo: 2 }
    }
}

impl BrickLayout {
    /// Voxels along each axis of a core.
    pub const fn core(self) -> u32 {
        self.edge - 2 * self.halo
    }

    /// Voxels of a brick, halo included.
    pub const fn voxels(self) -> usize {
        (self.edge as usize).pow(3)
    }

    /// The grid of bricks that covers a volume of `extent` voxels.
    pub fn grid(self, extent: UVec3) -> BrickGrid {
        BrickGrid { layout: self, extent, counts: extent.map(|n| n.div_ceil(self.core())) }
    }
}

/// A brick by its level (0 is full resolution) and its place in that level's grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct BrickId {
    pub level: u32,
    pub x: u32,
    pub y: u32,
    pub z: u32,
}

/// The bricks of one level of a volume.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BrickGrid {
    pub layout: BrickLayout,
    /// Voxels of the level.
    pub extent: UVec3,
    /// Bricks along each axis.
    pub counts: UVec3,
}

impl BrickGrid {
    /// Number of bricks.
    pub fn len(&self) -> usize {
        self.counts.as_usizevec3().element_product()
    }

    /// Whether there is no brick at all.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The place in tables of a brick: x fastest.
    pub fn index(&self, brick: UVec3) -> usize {
        let (brick, counts) = (brick.as_usizevec3(), self.counts.as_usizevec3());
        (brick.z * counts.y + brick.y) * counts.x + brick.x
    }

    /// The brick at a place in tables.
    pub fn brick(&self, index: usize) -> UVec3 {
        let counts = self.counts.as_usizevec3();
        let (rows, x) = (index / counts.x, index % counts.x);
        UVec3::new(x as u32, (rows % counts.y) as u32, (rows / counts.y) as u32)
    }

    /// First voxel of a brick's core.
    pub fn core_start(&self, brick: UVec3) -> UVec3 {
        brick * self.layout.core()
    }

    /// One past the last voxel of a brick's core, within the volume.
    pub fn core_end(&self, brick: UVec3) -> UVec3 {
        ((brick + 1) * self.layout.core()).min(self.extent)
    }

    /// First voxel of a brick with its halo; it may lie before the volume.
    pub fn halo_start(&self, brick: UVec3) -> IVec3 {
        self.core_start(brick).as_ivec3() - self.layout.halo as i32
    }
}
