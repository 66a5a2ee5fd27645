use glam::{DMat3, DVec3};

use super::header::Header;
use crate::geometry::Grid;
use crate::header_text::quoted;

/// Where the header places the voxels. MetaImage's world is LPS.
pub(crate) fn read(header: &Header, dimensions: usize, notes: &mut Vec<String>) -> Result<Grid, String> {
    let spacing: Vec<f64> =
        header.numbers(&["ElementSpacing", "ElementSize"], dimensions)?.unwrap_or(vec![1.0; dimensions]);
    let origin: Vec<f64> =
        header.numbers(&["Offset", "Position", "Origin"], dimensions)?.unwrap_or(vec![0.0; dimensions]);
    let matrix = header.numbers(&["TransformMatrix", "Rotation", "Orientation"], dimensions * dimensions)?;

    // Each row of the matrix is the direction of a voxel axis.
    let mut direction = DMat3::IDENTITY;
    if let Some(matrix) = matrix {
        let entry = |axis: usize, part: usize| match axis.max(part) < dimensions {
            true => matrix[axis * dimensions + part],
            false if axis == part => 1.0,
            false => 0.0,
        };
        for axis in 0..3 {
            *direction.col_mut(axis) = DVec3::from_array(std::array::from_fn(|part| entry(axis, part)));
        }
    }
    let mut spacing = in_space(&spacing, 1.0);
    if dimensions == 2 {
        notes.push("this is a single image; its thickness is taken as 1 mm".to_owned());
    }
    let millimetres = millimetres(header)?;
    if millimetres != 1.0 {
        notes
            .push(format!("lengths are in {} by DistanceUnits", header.field("DistanceUnits").unwrap_or("")));
    }
    spacing *= millimetres;
    let origin = in_space(&origin, 0.0) * millimetres;
    Grid::from_columns(direction * DMat3::from_diagonal(spacing), origin)
}

/// The first three numbers, or as many as there are.
fn in_space(numbers: &[f64], otherwise: f64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|axis| numbers.get(axis).copied().unwrap_or(otherwise)))
}

/// The length of the header's unit.
fn millimetres(header: &Header) -> Result<f64, String> {
    match header.field("DistanceUnits") {
        None | Some("mm" | "?" | "") => Ok(1.0),
        Some("um") => Ok(1e-3),
        Some("cm") => Ok(10.0),
        Some(unit) => Err(format!("the field DistanceUnits is {}; um, mm and cm are known", quoted(unit))),
    }
}
