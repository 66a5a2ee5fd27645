//! The GPU executor: draws a frame plan through wgpu.
//!
//! Bricks lie in the slots of a few atlas textures, brought there as a frame needs them, so that one texture is enough for
//! any volume. Two passes draw them: `raycast` marches one ray per pixel through the page table; `slices` draws
//! view-aligned slices of bricks back to front, in layers front to back, with occlusion queries and a stencil of opaque
//! pixels. Both give the picture that the CPU gives.
//!
//! This crate takes bricks from any [`BrickSource`](glassbrick_volume::BrickSource) and knows nothing about files. What
//! a device can do is looked at in one place, its tier.

mod adapter;
mod atlas_bindings;
mod bindings;
mod device;
mod error;
mod filter_probe;
mod frame_uniform;
mod grown_buffer;
mod pixels;
mod ray_fan;
mod raycast;
mod read_back;
mod renderer;
mod residents;
mod scene;
mod shared_buffers;
mod slices;
mod slot_cells;
mod tier;
mod tiles;
mod waiting;

pub use adapter::AdapterChoice;
pub use device::GpuDevice;
pub use error::GpuError;
pub use glassbrick_residency::TexelFormat;
pub use renderer::GpuRenderer;
pub use residents::UploadCounts;
pub use scene::{GpuFrame, GpuPass, GpuScene};
pub use tier::{TexelChoice, Tier};
