//! glassbrick renders volumes too large to fit.
//!
//! It cuts a volume into bricks, knows what a transfer function can see of each, draws what is visible, and reports
//! with every picture what was drawn and what was skipped. This crate is what programs depend on:
//! [`Volume::open`] → [`Volume::render`] → [`Rendered`], and [`write_picture`] to keep it.
//!
//! ```
//! use glam::UVec3;
//! use glassbrick::{Camera, NamedView, OpenSettings, RenderRequest, StoredType, Volume, VolumeDesc, preset};
//!
//! let desc = VolumeDesc::new(UVec3::splat(32), StoredType::U8);
//! let ramp: Vec<u8> = (0..32 * 32 * 32).map(|voxel| (voxel / 1024 * 8) as u8).collect();
//! let volume = Volume::from_array(desc, ramp, &OpenSettings::default())?;
//!
//! let grey = preset("grey", volume.value_range()).expect("grey is a preset");
//! let camera = Camera::framing(volume.desc(), NamedView::Front);
//! let picture = volume.render(RenderRequest { size: [64, 64], ..RenderRequest::new(grey) }, &camera)?;
//! assert!(picture.report.complete && picture.report.bricks.rendered == 1);
//! # Ok::<(), glassbrick::Error>(())
//! ```

mod auto_transfer_function;
mod backend;
mod camera_file;
mod encode;
mod error;
mod executor;
mod histogram;
mod platform;
mod presets;
mod process_memory;
mod render_request;
mod renderer;
mod report_json;
mod settings_file;
mod store;
mod transfer_function_choice;
mod transfer_function_file;
mod visible_levels;
mod volume;

pub use auto_transfer_function::{auto_transfer_function, has_hounsfield_units};
pub use backend::{Backend, Gpu};
pub use camera_file::read_camera;
pub use encode::{
    AnimationDesc, AnimationFormat, AnimationWriter, Background, OutputFormat, PictureFormat, check_output,
    check_text_file, write_picture, write_text_file,
};
pub use error::Error;
pub use glassbrick_brick_store::{Codec, Ingested, StoreDesc, Verified};
pub use glassbrick_cpu::InstructionSet;
pub use glassbrick_formats::{OpenOptions, RawLayout};
pub use glassbrick_gpu::GpuPass;
pub use glassbrick_volume::{
    Band, BrickCounts, BrickLayout, BrickSource, Camera, ControlPoint, Endian, Frame, FrameReport, Mode,
    NamedView, NearlyEmpty, Phong, Projection, RenderSettings, Rescale, ResidencyCounts, Skip, StageTimes,
    StoredType, TransferFunction, VolumeDesc, filtered_visible, without_nearly_empty,
};
pub use histogram::Histogram;
pub use presets::{PRESETS, Preset, preset};
pub use process_memory::{
    MemoryPeaks, available_bytes as available_memory_bytes, peaks as memory_peaks,
    total_bytes as total_memory_bytes,
};
pub use render_request::{DEFAULT_GPU_MEMORY_BYTES, LevelChoice, RenderRequest};
pub use renderer::{Rendered, Renderer};
pub use report_json::report_json;
pub use store::{IngestSettings, ingest, stored_bytes, verify};
pub use transfer_function_choice::TransferFunctionChoice;
pub use transfer_function_file::read_transfer_function;
pub use volume::{OpenSettings, Volume};
