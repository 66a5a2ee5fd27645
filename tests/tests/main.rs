//! The tests of glassbrick as a whole, in one binary.

mod agreement;
mod analytic_truth;
mod comparing;
mod fair_scenes;
mod properties;
