//! Series written by another implementation of DICOM, read as volumes.

mod damaged;
mod frames;
mod multi_frame;
mod series;
mod time_steps;
mod written;
