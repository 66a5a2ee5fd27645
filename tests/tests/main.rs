//! The tests of glassbrick as a whole, in one binary.

mod agreement;
mod analytic_truth;
mod bench;
mod binary;
mod command_line;
mod comparing;
mod fair_scenes;
mod fractions;
mod gpu;
mod properties;
mod real_data;
mod robustness;
mod store;
