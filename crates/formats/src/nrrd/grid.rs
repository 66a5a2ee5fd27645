use glam::{DMat3, DVec3};

use super::axes::Axes;
use super::header::{Header, vector};
use crate::geometry::Grid;
use crate::header_text::quoted;

/// Whether a world's name says that time is one of its axes.
pub(crate) fn has_time(space: &str) -> bool {
    let space = space.trim().to_ascii_lowercase();
    space.ends_with("-time") || matches!(space.as_str(), "rast" | "last" | "lpst")
}

/// Where the header places the voxels.
pub(crate) fn read(header: &Header, axes: &Axes, notes: &mut Vec<String>) -> Result<Grid, String> {
    if header.field("space").is_some_and(|space| space.to_ascii_lowercase().starts_with("3d-left-handed")) {
        notes.push(
            "the header's space is 3D-left-handed; it is taken as LPS, which is right-handed, so the picture may be \
             mirrored"
                .to_owned(),
        );
    }
    let (columns, origin) = match header.words("spacedirections", axes.sizes.len())? {
        Some(directions) => {
            if header.field("space").is_none() {
                notes.push("the header does not name its space; it is taken as LPS".to_owned());
            }
            let lps_from_world = lps_from_world(header, notes)?;
            let columns = from_directions(header, axes, &directions, notes)?;
            let origin = match header.field("spaceorigin") {
                Some(origin) => vector(origin)?.unwrap_or_default(),
                None => Vec::new(),
            };
            let origin =
                DVec3::from_array(std::array::from_fn(|axis| origin.get(axis).copied().unwrap_or(0.0)));
            (lps_from_world * columns, lps_from_world * origin)
        }
        None => from_spacings(header, axes, notes)?,
    };
    Grid::from_columns(columns, origin)
}

/// Takes the world that the header names to LPS millimetres.
fn lps_from_world(header: &Header, notes: &mut Vec<String>) -> Result<DMat3, String> {
    let space = header.field("space").unwrap_or("").to_ascii_lowercase();
    let signs = match space.trim_end_matches("-time") {
        "right-anterior-superior" | "ras" | "rast" => DVec3::new(-1.0, -1.0, 1.0),
        "left-anterior-superior" | "las" | "last" => DVec3::new(1.0, -1.0, 1.0),
        "left-posterior-superior" | "lps" | "lpst" => DVec3::ONE,
        "" | "scanner-xyz" | "3d-right-handed" | "3d-left-handed" => DVec3::ONE,
        _ => return Err(format!("the field \"space\" is {}, which is no world of NRRD", quoted(&space))),
    };
    let mut millimetres = DVec3::ONE;
    if let Some(units) = header.field("spaceunits") {
        let count = super::header::split_words(units).len();
        for (axis, unit) in header.words("spaceunits", count)?.unwrap_or_default().iter().take(3).enumerate()
        {
            millimetres[axis] = millimetres_of(unit, notes);
        }
    }
    Ok(DMat3::from_diagonal(signs * millimetres))
}

/// The length of a unit; one that is not known is taken as millimetres.
fn millimetres_of(unit: &str, notes: &mut Vec<String>) -> f64 {
    match unit.trim().to_lowercase().as_str() {
        "mm" | "millimeter" | "millimeters" | "millimetre" | "millimetres" => 1.0,
        "um" | "µm" | "μm" | "micron" | "microns" | "micrometer" | "micrometers" | "micrometre"
        | "micrometres" => 1e-3,
        "nm" | "nanometer" | "nanometers" | "nanometre" | "nanometres" => 1e-6,
        "cm" | "centimeter" | "centimeters" | "centimetre" | "centimetres" => 10.0,
        "m" | "meter" | "meters" | "metre" | "metres" => 1000.0,
        _ => {
            let note = format!("the unit {} is not known; lengths are taken as mm", quoted(unit));
            if !notes.contains(&note) {
                notes.push(note);
            }
            1.0
        }
    }
}

fn from_directions(
    header: &Header,
    axes: &Axes,
    directions: &[String],
    notes: &mut Vec<String>,
) -> Result<DMat3, String> {
    let column = |axis: usize| match vector(&directions[axis])? {
        Some(direction) => in_space(&direction),
        None => Err(format!("axis {axis} has no direction, but axes of space must")),
    };
    let (x, y) = (column(axes.spatial[0])?, column(axes.spatial[1])?);
    let z = match axes.spatial.get(2) {
        Some(&axis) => column(axis)?,
        None => x.cross(y).normalize_or_zero() * slice_thickness(header, axes, notes),
    };
    Ok(DMat3::from_cols(x, y, z))
}

/// A vector of the world as one of three-dimensional space; time must not have a part in it.
fn in_space(vector: &[f64]) -> Result<DVec3, String> {
    match *vector {
        [x, y] => Ok(DVec3::new(x, y, 0.0)),
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        [x, y, z, t] if t == 0.0 || t.is_nan() => Ok(DVec3::new(x, y, z)),
        _ => Err(format!("a vector of {} numbers has no place in space", vector.len())),
    }
}

/// Spacing and origin where there are no directions: axis by axis.
fn from_spacings(header: &Header, axes: &Axes, notes: &mut Vec<String>) -> Result<(DMat3, DVec3), String> {
    let count = axes.sizes.len();
    let spacings: Option<Vec<f64>> = header.numbers("spacings", count)?;
    let mins: Option<Vec<f64>> = header.numbers("axismins", count)?;
    let maxs: Option<Vec<f64>> = header.numbers("axismaxs", count)?;
    let centerings = header.words("centerings", count)?;
    let units = header.words("units", count)?;
    if header.field("space").is_some_and(|space| !space.to_ascii_lowercase().starts_with("3d-")) {
        notes.push("the header names a space but no directions; the axes are taken along LPS".to_owned());
    }

    let known = |numbers: &Option<Vec<f64>>, axis: usize| {
        numbers.as_ref().map(|numbers| numbers[axis]).filter(|number| !number.is_nan())
    };
    let (mut spacing_mm, mut origin_mm) = (DVec3::ONE, DVec3::ZERO);
    for (place, &axis) in axes.spatial.iter().enumerate() {
        let at_nodes = centerings.as_ref().is_some_and(|words| words[axis].eq_ignore_ascii_case("node"));
        let intervals = if at_nodes { axes.sizes[axis].saturating_sub(1).max(1) } else { axes.sizes[axis] };
        let (min, max) = (known(&mins, axis), known(&maxs, axis));
        let from_ends = min.zip(max).map(|(min, max)| (max - min) / intervals as f64);
        let spacing = known(&spacings, axis).or(from_ends).unwrap_or(1.0);
        let origin = min.map_or(0.0, |min| if at_nodes { min } else { min + spacing / 2.0 });
        let millimetres = units.as_ref().map_or(1.0, |units| match units[axis].as_str() {
            "" | "???" | "none" => 1.0,
            unit => millimetres_of(unit, notes),
        });
        spacing_mm[place] = spacing * millimetres;
        origin_mm[place] = origin * millimetres;
    }
    if axes.spatial.len() == 2 {
        spacing_mm.z = slice_thickness(header, axes, notes);
    }
    Ok((DMat3::from_diagonal(spacing_mm), origin_mm))
}

/// How thick a single image is: what the header says for any axis, else 1 mm.
fn slice_thickness(header: &Header, axes: &Axes, notes: &mut Vec<String>) -> f64 {
    let said = header.numbers::<f64>("thicknesses", axes.sizes.len()).ok().flatten().unwrap_or_default();
    said.into_iter().find(|thickness| thickness.is_finite() && *thickness > 0.0).unwrap_or_else(|| {
        notes.push("this is a single image; its thickness is taken as 1 mm".to_owned());
        1.0
    })
}
