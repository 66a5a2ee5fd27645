//! A generated CT of a human body, of any size: the data for demonstrations, tests and benchmarks that need a volume
//! larger than one wants to carry around.
//!
//! The body is a list of solids with signed distances ([`Phantom`] says how it is framed), painted row by row, so any
//! slab of a volume is made by itself, on all cores, without the rest. The picture that a renderer makes of it shows a
//! person: skin, bones, lungs, contrast-filled arteries. The heart points to the patient's left, the liver is on the
//! right, and a marker ball sits on the left shoulder, so left and right can be told.
//!
//! This crate knows nothing of the other glassbrick crates; it writes NRRD and raw files by itself.
//!
//! ```
//! use glassbrick_phantom::Phantom;
//!
//! let phantom = Phantom::new([96, 80, 128], 1);
//! let mut lowest = vec![0; phantom.slice_voxels()];
//! phantom.fill_slices(0, &mut lowest);
//! assert!(lowest.iter().any(|&hu| hu > 300), "there is bone in the chest");
//! ```

mod anatomy;
mod framing;
mod noise;
mod paint;
mod phantom;
mod shape;
mod solid;
mod vector;
mod write;

pub use anatomy::MARKER as MARKER_MM;
pub use phantom::Phantom;
