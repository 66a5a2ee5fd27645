//! Which bricks are resident, and how they come to be.
//!
//! A device has room for so many bricks, its slots, and a frame may need more. The [`WorkingSet`] says which brick is
//! in which slot and which one has to go for another; [`next_round`] cuts a frame's plan into rounds that fit; the
//! [`PageTable`] tells a shader where a brick lies; and the [`Loader`]'s threads read bricks while a frame is drawn.
//! The first three are pure decisions: they depend on what they are told and never on time, so that a picture takes
//! the same rounds whenever it is drawn.
//!
//! On the device, [`AtlasTextures`] are the slots, and bricks go there through a [`StagingRing`].
//!
//! This crate knows bricks only by [`BrickSource`](glassbrick_volume::BrickSource), and nothing of files, cameras or
//! transfer functions.
//!
//! ```
//! use glassbrick_residency::{WorkingSet, next_round};
//! use glassbrick_volume::BrickId;
//!
//! let plan: Vec<BrickId> = (0..5).map(|x| BrickId { level: 0, x, y: 0, z: 0 }).collect();
//! let mut set = WorkingSet::new(2);
//! let (mut wanted, mut rounds) = (&plan[..], 0);
//! set.begin_frame();
//! while !wanted.is_empty() {
//!     let round = next_round(&mut set, wanted, usize::MAX);
//!     let (drawn, later) = wanted.split_at(round.taken);
//!     // Here the round's loads are read and uploaded, and its bricks are drawn.
//!     drawn.iter().for_each(|&brick| set.set_drawn(brick));
//!     (wanted, rounds) = (later, rounds + 1);
//! }
//! assert_eq!(rounds, 3);
//! ```

mod atlas;
mod error;
mod eviction_order;
mod load_queue;
mod loader;
mod page_table;
mod pins;
mod residents;
mod rounds;
mod slots;
mod working_set;

pub use atlas::{AtlasShape, AtlasTextures, SlotPlace, StagingRing, TexelFormat, VoxelEncoding};
pub use error::ResidencyError;
pub use load_queue::{Loaded, Priority};
pub use loader::Loader;
pub use page_table::{MISSING, NOT_PLANNED, PageTable};
pub use rounds::{Load, Round, next_round};
pub use slots::{MOST_SLOTS, SlotId};
pub use working_set::{Admitted, WorkingSet, WorkingSetCounts};
