//! What was meant: the flags of [`args`](crate::args) put together, checked against each other, and the files of
//! settings that they name read. Everything here is found out before the first voxel is.

mod backend;
mod bench;
mod info;
mod ingest;
mod input;
mod output;
mod render;
mod settings;
mod transfer_function;
mod viewpoint;

pub use backend::{auto_backend, open_backend, open_gpu};
pub use bench::BenchJob;
pub use info::InfoJob;
pub use ingest::IngestJob;
pub use input::InputJob;
pub use output::Output;
pub use render::RenderJob;
pub use transfer_function::transfer_function_choice;
pub use viewpoint::{View, turned};
