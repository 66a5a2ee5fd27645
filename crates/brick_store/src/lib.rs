//! Where bricks come from: the brick store on disk and how it is made, flat volumes read in place, arrays in memory, and
//! a cache of bricks with a byte budget.
//!
//! This crate knows file formats only as [`VolumeReader`](glassbrick_volume::VolumeReader) and renderers only as users
//! of [`BrickSource`](glassbrick_volume::BrickSource).
//!
//! ```
//! use glam::UVec3;
//! use glassbrick_brick_store::FlatSource;
//! use glassbrick_volume::{BrickLayout, BrickSource, StoredType, VolumeDesc};
//!
//! let desc = VolumeDesc::new(UVec3::new(3, 2, 1), StoredType::U8);
//! let source = FlatSource::from_array(desc, vec![1, 2, 3, 4, 5, 6], BrickLayout::default())?;
//! assert_eq!(source.ranges(0)[0].core, [1.0, 6.0]);
//! # Ok::<(), glassbrick_brick_store::SourceError>(())
//! ```

mod brick_cut;
mod brick_stats;
mod cached_source;
mod decode;
mod element;
mod error;
mod flat_source;
mod flat_voxels;
mod ingest;
mod platform;
mod range_scan;
mod store;
mod table_scan;

pub use cached_source::{CacheCounts, CachedSource};
pub use error::SourceError;
pub use flat_source::FlatSource;
pub use flat_voxels::FlatVoxels;
pub use ingest::{IngestSettings, Ingested, ingest};
pub use store::{Codec, StoreDesc, StoreError, StoreSource, Verified, is_zarr, verify};
