use glam::UVec3;

use crate::{MOST_SLOTS, SlotId};

/// Voxels along each axis of an atlas texture's cube, where bricks are not larger.
const CUBE_EDGE: u32 = 256;

/// Slots of a texture along an axis, at most: places are packed into so many bits.
const MOST_ALONG_AXIS: u32 = (1 << SlotPlace::AXIS_BITS) - 1;

/// How slots lie in atlas textures.
///
/// A texture is made of cubes of 256³ voxels, each of as many slots as fit (4×4×4 bricks of 64³). Most devices are
/// given textures of one cube each; where one large texture serves better, its cubes double in z, then y, then x, so
/// that positions stay small and exact. Slots stand close together whatever the cubes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AtlasShape {
    pub brick_edge: u32,
    /// Voxels along each axis of a cube.
    pub cube_edge: u32,
    /// Cubes of a texture, a power of two.
    pub cubes_per_texture: u32,
}

/// Where a slot is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SlotPlace {
    pub texture: u32,
    /// Its first voxel.
    pub texel: UVec3,
}

impl SlotPlace {
    const AXIS_BITS: u32 = 9;

    /// Its place in 32 bits, as shaders read it: along x, y and z in bricks, from the lowest bits on, and the texture.
    pub fn packed(&self, brick_edge: u32) -> u32 {
        let UVec3 { x, y, z } = self.texel / brick_edge;
        let bits = Self::AXIS_BITS;
        x | y << bits | z << (2 * bits) | self.texture << (3 * bits)
    }
}

impl AtlasShape {
    pub fn new(brick_edge: u32, cubes_per_texture: u32) -> Self {
        let cube_edge = brick_edge.next_power_of_two().max(CUBE_EDGE);
        Self { brick_edge, cube_edge, cubes_per_texture: cubes_per_texture.next_power_of_two() }
    }

    /// Cubes that so many textures of at most `largest` voxels an axis can have.
    pub fn most_cubes(&self, textures: usize, largest: u32) -> u32 {
        let along_axis = (largest / self.cube_edge).min(MOST_ALONG_AXIS / self.slots_per_axis()).max(1);
        let in_texture = (1u32 << along_axis.ilog2()).saturating_pow(3);
        in_texture.saturating_mul(textures as u32).min(MOST_SLOTS / self.slots_per_cube())
    }

    /// Slots along each axis of a cube.
    pub fn slots_per_axis(&self) -> u32 {
        self.cube_edge / self.brick_edge
    }

    pub fn slots_per_cube(&self) -> u32 {
        self.slots_per_axis().pow(3)
    }

    pub fn slots_per_texture(&self) -> u32 {
        self.slots_per_cube() * self.cubes_per_texture
    }

    /// Voxels of a cube.
    pub fn cube_voxels(&self) -> u64 {
        u64::from(self.cube_edge).pow(3)
    }

    /// Voxels of a texture along each axis.
    pub fn texture_extent(&self) -> UVec3 {
        (cube_place(self.cubes_per_texture - 1) + 1) * self.cube_edge
    }

    pub fn place(&self, slot: SlotId) -> SlotPlace {
        let (texture, slot) = (slot.0 / self.slots_per_texture(), slot.0 % self.slots_per_texture());
        let (cube, slot) = (slot / self.slots_per_cube(), slot % self.slots_per_cube());
        let n = self.slots_per_axis();
        let in_cube = UVec3::new(slot % n, slot / n % n, slot / (n * n));
        SlotPlace { texture, texel: (cube_place(cube) * n + in_cube) * self.brick_edge }
    }
}

/// The place of a cube in its texture: the bits of its number go to z, y and x in turn.
fn cube_place(number: u32) -> UVec3 {
    let every_third = |first: u32| {
        (0..11)
            .filter(|bit| 3 * bit + first < 32)
            .fold(0, |sum, bit| sum | ((number >> (3 * bit + first)) & 1) << bit)
    };
    UVec3::new(every_third(2), every_third(1), every_third(0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn every_slot_lies_alone(shape: AtlasShape, textures: u32) {
        let places: Vec<SlotPlace> =
            (0..textures * shape.slots_per_texture()).map(|slot| shape.place(SlotId(slot))).collect();
        let mut seen = std::collections::HashSet::new();
        for place in &places {
            assert!(place.texture < textures);
            assert!((place.texel + shape.brick_edge).cmple(shape.texture_extent()).all(), "{place:?}");
            assert!(seen.insert((place.texture, place.texel.to_array())), "{place:?} twice");
            assert_eq!(place.texel % shape.brick_edge, UVec3::ZERO);
        }
    }

    #[test]
    fn slots_do_not_overlap() {
        for (edge, cubes) in
            [(64, 1), (64, 2), (64, 4), (64, 8), (64, 16), (32, 2), (24, 4), (100, 1), (300, 2)]
        {
            every_slot_lies_alone(AtlasShape::new(edge, cubes), 3);
        }
    }

    #[test]
    fn a_cube_of_256_holds_64_bricks_of_64() {
        let shape = AtlasShape::new(64, 1);
        assert_eq!((shape.cube_edge, shape.slots_per_cube()), (256, 64));
        assert_eq!(shape.place(SlotId(63)), SlotPlace { texture: 0, texel: UVec3::splat(192) });
        assert_eq!(shape.place(SlotId(64)), SlotPlace { texture: 1, texel: UVec3::ZERO });
        assert_eq!(shape.place(SlotId(64 + 1 + 2 * 4 + 3 * 16)).packed(64), 1 | 2 << 9 | 3 << 18 | 1 << 27);
    }

    #[test]
    fn many_cubes_make_a_compact_texture() {
        let extent = |cubes| AtlasShape::new(64, cubes).texture_extent().to_array();
        assert_eq!(extent(1), [256, 256, 256]);
        assert_eq!(extent(2), [256, 256, 512]);
        assert_eq!(extent(8), [512, 512, 512]);
        assert_eq!(extent(16), [512, 512, 1024]);
        assert_eq!(extent(3), extent(4));
    }
}
