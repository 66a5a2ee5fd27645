//! What people read of a benchmark: rows, a table, plots and a page, all from the same results.

mod csv;
mod figures;
mod groups;
mod page;
mod plots;
#[cfg(test)]
pub mod sample;
mod table;

pub use csv::csv;
pub(crate) use figures::{NOTHING, megabytes, or_nothing, significant};
pub use figures::{aligned, count};
pub(crate) use groups::{Group, groups};
pub use page::{PagePicture, page};
pub use plots::{Plot, plots};
pub(crate) use table::printable;
pub use table::table;
