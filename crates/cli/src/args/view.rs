use std::path::PathBuf;

use clap::Args;

use super::ViewChoice;
use crate::parse;

const HEADING: &str = "View";

/// Where the eye is; the ways to say it exclude each other.
#[derive(Args, Clone, Debug, Default)]
pub struct ViewArgs {
    /// The side of the patient that faces the viewer; front by default
    #[arg(
        long, value_enum, help_heading = HEADING,
        conflicts_with_all = ["azimuth", "elevation", "camera", "eye", "target", "up", "fov"]
    )]
    pub view: Option<ViewChoice>,
    /// Turns the eye from the front to the patient's left, in degrees
    #[arg(
        long, value_name = "DEG", allow_hyphen_values = true, value_parser = parse::number, help_heading = HEADING,
        conflicts_with_all = ["camera", "eye", "target", "up", "fov"]
    )]
    pub azimuth: Option<f64>,
    /// Lifts the eye, in degrees; at 90 it looks down on the head
    #[arg(
        long, value_name = "DEG", allow_hyphen_values = true, value_parser = parse::number, help_heading = HEADING,
        conflicts_with_all = ["camera", "eye", "target", "up", "fov"]
    )]
    pub elevation: Option<f64>,
    /// A camera as a JSON file
    #[arg(long, value_name = "FILE", help_heading = HEADING, conflicts_with_all = ["eye", "target", "up", "fov"])]
    pub camera: Option<PathBuf>,
    /// The eye, in world mm (+x left, +y posterior, +z superior)
    #[arg(
        long, value_name = "X,Y,Z", requires = "target", allow_hyphen_values = true, help_heading = HEADING,
        value_parser = parse::numbers::<3>
    )]
    pub eye: Option<[f64; 3]>,
    /// What the eye looks at, in world mm
    #[arg(
        long, value_name = "X,Y,Z", requires = "eye", allow_hyphen_values = true, help_heading = HEADING,
        value_parser = parse::numbers::<3>
    )]
    pub target: Option<[f64; 3]>,
    /// What is up in the picture; 0,0,1 by default
    #[arg(
        long, value_name = "X,Y,Z", requires = "eye", allow_hyphen_values = true, help_heading = HEADING,
        value_parser = parse::numbers::<3>
    )]
    pub up: Option<[f64; 3]>,
    /// Angle that the picture's height spans, in degrees; 30 by default
    #[arg(long, value_name = "DEG", requires = "eye", value_parser = parse::positive, help_heading = HEADING)]
    pub fov: Option<f64>,
    /// Makes everything that many times larger
    #[arg(long, value_name = "FACTOR", value_parser = parse::positive, help_heading = HEADING)]
    pub zoom: Option<f64>,
}
