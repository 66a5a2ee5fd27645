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

mod brick_cells;
mod brick_layout;
mod brick_source;
mod camera;
mod footprint;
mod frame;
mod frame_plan;
mod frame_report;
mod occupancy;
mod rays;
mod render_settings;
mod row_axis;
mod shown_values;
mod stored_type;
mod transfer_function;
mod visible_bricks;
mod volume_desc;
mod volume_level;
mod volume_reader;
mod voxel_count_table;

pub use brick_cells::{BrickCells, CELL_EDGE_LOG2};
pub use brick_layout::{BrickGrid, BrickId, BrickLayout};
pub use brick_source::{Brick, BrickSource, Voxels};
pub use camera::{Camera, CameraBasis, DEFAULT_FOV_Y_DEG, NamedView, Projection};
pub use footprint::{Footprints, PixelRect};
pub use frame::Frame;
pub use frame_plan::{FramePlan, Layer, PlannedBrick, eye_brick};
pub use frame_report::{BrickCounts, FrameReport, ResidencyCounts, StageTimes};
pub use occupancy::Occupancy;
pub use rays::{FrameRays, Ray, RayFan};
pub use render_settings::{Mode, Phong, RenderSettings, Skip};
pub use row_axis::RowAxis;
pub use shown_values::ShownValues;
pub use stored_type::StoredType;
pub use transfer_function::{
    BAKED_ENTRIES, BakedTransferFunction, Band, ControlPoint, TransferFunction, srgb_decode, srgb_encode,
};
pub use visible_bricks::{
    NearlyEmpty, VisibleBricks, all_bricks, boundary_bricks, filtered_visible, is_empty_for,
    without_nearly_empty,
};
pub use volume_desc::{Rescale, VOLUME_MARGIN_VOXELS, VolumeDesc};
pub use volume_level::VolumeLevel;
pub use volume_reader::{Endian, FlatPiece, FlatPlacement, ReadError, VolumeReader, io_advice};
pub use voxel_count_table::{BandFractions, Bins, BrickRange, VCT_BINS, VoxelCountTable};
