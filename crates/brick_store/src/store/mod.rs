//! The brick store on disk: a Zarr v3 group of bricks, their ranges and their voxel-count tables, level by level.
//!
//! `docs/STORE_FORMAT.md` describes it. Here is what both its writer and its readers know.

mod blosc;
mod brick_files;
mod codec;
mod error;
mod metadata;
mod read_metadata;
mod shard;
mod store_desc;
mod store_source;
mod table_chunks;
mod verify;

pub use brick_files::BrickFiles;
pub use codec::Codec;
pub use error::StoreError;
pub use metadata::documents;
pub use shard::{SHARD_EDGE, ShardIndex, shard_path};
pub use store_desc::StoreDesc;
pub use store_source::{StoreSource, is_store, is_zarr};
pub use table_chunks::{Table, TableChunks, chunk_path};
pub use verify::{Verified, verify};
