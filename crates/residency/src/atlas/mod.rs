//! The atlas on the device: textures of slots, the texels that voxels become, and the ring by which bricks go there.

mod encoding;
mod shape;
mod staging;
mod textures;

pub use encoding::{TexelFormat, VoxelEncoding};
pub use shape::{AtlasShape, SlotPlace};
pub use staging::StagingRing;
pub use textures::AtlasTextures;
