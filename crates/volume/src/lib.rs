//! The vocabulary of glassbrick.
//!
//! Everything that a renderer, a reader of files and a user must agree on stands here as plain data and pure
//! functions: what a volume is and where it lies in the world, how it is cut into bricks, what a transfer
//! function can see of them, which ray a camera sends through a pixel, in which order a frame's bricks are
//! drawn, and what is said about it afterwards.
//!
//! This crate knows nothing about files, threads, clocks or GPUs; its only dependency is `glam`.
//!
//! ```
//! use glassbrick_volume::{BrickLayout, StoredType, VolumeDesc};
//! use glam::UVec3;
//!
//! let head = VolumeDesc::new(UVec3::new(512, 512, 245), StoredType::I16);
//! let bricks = BrickLayout::default().grid(head.extent);
//! assert_eq!(bricks.counts, UVec3::new(9, 9, 5));
//! ```

mod brick_layout;
mod frame;
mod stored_type;
mod transfer_function;
mod volume_desc;
mod volume_reader;

pub use brick_layout::{BrickGrid, BrickId, BrickLayout};
pub use frame::Frame;
pub use stored_type::StoredType;
pub use transfer_function::{ControlPoint, TransferFunction};
pub use volume_desc::{Rescale, VOLUME_MARGIN_VOXELS, VolumeDesc};
pub use volume_reader::{Endian, FlatPiece, FlatPlacement, ReadError, VolumeReader};
