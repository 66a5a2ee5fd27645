//! What the tests of glassbrick as a whole are held against.
//!
//! [`reference`] evaluates the definition of the picture plainly in `f64`, [`scenes`] are the pictures that every
//! executor draws, and [`tolerance`] says how far an executor may be from the reference. The reference and the
//! scenes are plain data and know nothing of glassbrick's crates, so that a mistake there cannot hide here; [`drawing`]
//! hands scenes to glassbrick, on the CPU or on the [`gpu`].

pub mod drawing;
pub mod gpu;
pub mod reference;
pub mod scenes;
pub mod skipped;
pub mod srgb;
pub mod tolerance;
