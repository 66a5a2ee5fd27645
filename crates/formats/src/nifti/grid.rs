use glam::{DMat3, DQuat, DVec3};

use super::header::Header;
use crate::geometry::Grid;

/// Where the header places the voxels: by its sform, else its qform, else by spacing alone.
pub(crate) fn read(header: &Header, sizes: &[u64; 7], notes: &mut Vec<String>) -> Result<Grid, String> {
    let lps_from_ras = DMat3::from_diagonal(DVec3::new(-1.0, -1.0, 1.0) * millimetres(header, notes));
    let place =
        |(columns, origin): (DMat3, DVec3)| Grid::from_columns(lps_from_ras * columns, lps_from_ras * origin);
    let sform = (header.sform_code > 0).then(|| place(sform(header)));
    if let Some(Ok(grid)) = sform {
        return Ok(grid);
    }
    let spacing = spacing(header, sizes, notes)?;
    match (sform, header.qform_code > 0) {
        (Some(Err(what)), true) => {
            notes.push(format!("the sform is of no use ({what}); the qform is taken"));
            place(qform(header, spacing)?)
        }
        (Some(Err(what)), false) => Err(format!("the sform is of no use, and there is no qform: {what}")),
        (_, true) => place(qform(header, spacing)?),
        (_, false) => {
            notes.push(
                "there is neither sform nor qform; x, y, z are taken as right, anterior, superior".to_owned(),
            );
            place((DMat3::from_diagonal(spacing), DVec3::ZERO))
        }
    }
}

/// The length of the header's unit; one that is not said is a millimetre.
fn millimetres(header: &Header, notes: &mut Vec<String>) -> f64 {
    match header.xyzt_units & 7 {
        1 => 1000.0,
        3 => 1e-3,
        0 | 2 => 1.0,
        unit => {
            notes.push(format!("the unit of length {unit} is not known; lengths are taken as mm"));
            1.0
        }
    }
}

/// Spacing as the NIfTI library reads it: an axis without one has 1, and a sign means nothing.
fn spacing(header: &Header, sizes: &[u64; 7], notes: &mut Vec<String>) -> Result<DVec3, String> {
    let mut spacing = DVec3::ONE;
    for axis in 0..3 {
        let pixdim = header.pixdim[axis + 1];
        if !pixdim.is_finite() {
            return Err(format!("the field pixdim[{}] is {pixdim}; it must be a length", axis + 1));
        }
        if pixdim < 0.0 {
            notes.push(format!("pixdim[{}] is {pixdim}; its sign is ignored", axis + 1));
        }
        if pixdim != 0.0 {
            spacing[axis] = pixdim.abs();
        } else if sizes[axis] > 1 {
            notes.push(format!("pixdim[{}] is 0; the spacing is taken as 1", axis + 1));
        }
    }
    Ok(spacing)
}

fn sform(header: &Header) -> (DMat3, DVec3) {
    let column = |part: usize| DVec3::from_array(header.srow.map(|row| row[part]));
    (DMat3::from_cols(column(0), column(1), column(2)), column(3))
}

fn qform(header: &Header, spacing: DVec3) -> Result<(DMat3, DVec3), String> {
    let [b, c, d] = header.quaternion;
    if !(b.is_finite() && c.is_finite() && d.is_finite()) {
        return Err("the qform's quaternion is not finite (NaN or inf)".to_owned());
    }
    // The real part is left out of the file; rounding may leave the others a little longer than 1.
    let real_squared = 1.0 - (b * b + c * c + d * d);
    let rotation = DQuat::from_xyzw(b, c, d, if real_squared < 1e-7 { 0.0 } else { real_squared.sqrt() });
    let handed = if header.pixdim[0] < 0.0 { -1.0 } else { 1.0 };
    let spacing = spacing * DVec3::new(1.0, 1.0, handed);
    let rotation = DMat3::from_quat(rotation.normalize());
    Ok((rotation * DMat3::from_diagonal(spacing), DVec3::from_array(header.qoffset)))
}
