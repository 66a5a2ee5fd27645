//! The structs that passes read, as they lie in memory. A test compares each with what naga finds in the WGSL.

use bytemuck::{Pod, Zeroable};

/// What every pass of a frame knows; `shared/frame.wgsl` says what each field is.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Frame {
    pub tile_origin: [u32; 2],
    pub tile_size: [u32; 2],
    pub sample_count: u32,
    pub cores_per_voxel: f32,
    pub core: u32,
    pub halo: u32,
    pub grid_counts: [u32; 3],
    /// [`Frame::PASSES_MISSING`] and [`Frame::SKIPS_UNCHANGED`].
    pub flags: u32,
    pub volume_low: [f32; 3],
    pub opacity_cutoff: f32,
    pub volume_high: [f32; 3],
    pub sign: f32,
    pub atlas_from_texel: [f32; 3],
    pub first_stored: f32,
    pub stored_from_texel: [f32; 2],
    pub stored_bias: f32,
    pub entries_per_stored: f32,
    pub phong: [f32; 4],
    /// Columns of three, each padded to four.
    pub normal_from_gradient: [[f32; 4]; 3],
    pub step_mm: f32,
    pub cell_bytes: u32,
    pub box_depth: [f32; 2],
    pub rank_from_stored: [f32; 2],
    pub cell_edge: u32,
    pub cell_words: u32,
    pub rays: RayFan,
}

impl Frame {
    /// A brick that is not resident is passed by; else its ray waits for it.
    pub const PASSES_MISSING: u32 = 1;
    /// Bricks that cannot change a pixel are left out.
    pub const SKIPS_UNCHANGED: u32 = 2;
}

/// How rays fan out over the pixels of a picture; see `shared/frame.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RayFan {
    pub start_high: [[f32; 4]; 3],
    pub start_low: [[f32; 4]; 3],
    pub step_high: [[f32; 4]; 3],
    pub step_low: [[f32; 4]; 3],
}

/// What a ray of the raycast pass has gathered, and where it goes on; zeros at the start. See `shared/gathered.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub struct RayState {
    pub gathered: [f32; 4],
    pub next: u32,
    pub surface: u32,
    pub samples: u32,
    pub padding: u32,
}

/// A brick as slices and boxes are drawn of it; see `shared/sliced_brick.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct SlicedBrick {
    pub corners: [[f32; 4]; 8],
    pub owned_low: [f32; 3],
    pub last_slice: f32,
    pub owned_high: [f32; 3],
    pub best: f32,
    pub texel_from_voxel: [f32; 3],
    pub first_slice: f32,
}

/// Slices that are drawn together; see `passes/slices.wgsl`.
pub const SLAB_SLICES: u32 = 16;

/// Which queries are a layer's; see `passes/visible.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct QueryRange {
    pub first: u32,
    pub count: u32,
}

/// An indirect draw.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct DrawArgs {
    pub vertex_count: u32,
    pub instance_count: u32,
    pub first_vertex: u32,
    pub first_instance: u32,
}
