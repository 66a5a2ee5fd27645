//! Single values of the command line, read from words. Each error says what is wanted, to be read after the value.

mod bytes;
mod numbers;
mod words;

pub use bytes::bytes;
pub use numbers::{
    extent, fraction, number, numbers, opacity_cutoff, picture_size, positive, rescale, share, spacing,
};
pub use words::{background, dtype, level};
