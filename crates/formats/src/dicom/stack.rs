//! Where a stack of frames lies in the world, and whether it is as even as a volume is.

use glam::{DMat3, DVec3, UVec3};
use glassbrick_volume::{Rescale, StoredType, VolumeDesc};

use super::candidate::Slice;
use super::frame_info::{FrameInfo, Orientation};
use super::image::Image;

/// Distances that differ by less of the usual one are taken as equal.
const EVEN: f64 = 0.01;
/// A shear below this angle is the rounding of positions.
const STRAIGHT_DEGREES: f64 = 0.05;

/// Describes the volume of these frames, which stand in order along their normal. What is odd about them is
/// told in `notes`.
pub(super) fn describe(images: &[Image], slices: &[Slice], notes: &mut Vec<String>) -> VolumeDesc {
    let image = &images[slices[0].image];
    let infos: Vec<&FrameInfo> = slices.iter().map(|slice| slice.info(images)).collect();
    let orientation = infos[0].orientation.unwrap_or(Orientation::AXIAL);
    let normal = orientation.normal();
    let positions: Option<Vec<DVec3>> = infos.iter().map(|info| info.position_mm).collect();
    if positions.is_some() && infos[0].orientation.is_none() {
        notes.push("ImageOrientationPatient is missing; the patient's own axes are taken".to_owned());
    }
    let step_mm = match &positions {
        Some(positions) => step_of_positions(positions, normal, infos[0].pixel_spacing_mm, notes),
        None => {
            let order = if image.frames.len() > 1 { "as the file counts them" } else { "by InstanceNumber" };
            step_of_locations(&infos, order, notes).map(|spacing| normal * spacing)
        }
    };
    let step_mm = step_mm.unwrap_or_else(|| {
        let claimed = infos[0].claimed_spacing_mm.unwrap_or(1.0);
        let source =
            if infos[0].claimed_spacing_mm.is_some() { "only the header's claim" } else { "nothing" };
        notes.push(format!("{source} says how far apart slices lie; {claimed} mm is taken"));
        normal * claimed
    });
    let rescale = infos[0].rescale;
    let rescale_differs = infos.iter().any(|info| info.rescale != rescale);
    if rescale_differs {
        notes.push(
            "RescaleSlope or RescaleIntercept differs by slice, so voxels are values in f32".to_owned(),
        );
    }
    let [x_mm, y_mm] = infos[0].pixel_spacing_mm;
    VolumeDesc {
        extent: UVec3::new(image.columns, image.rows, slices.len() as u32),
        stored_type: if rescale_differs { StoredType::F32 } else { image.format.stored_type },
        spacing_mm: DVec3::new(x_mm, y_mm, step_mm.length()),
        origin_mm: positions.map_or(DVec3::ZERO, |positions| positions[0]),
        direction: DMat3::from_cols(orientation.x, orientation.y, step_mm.normalize()),
        rescale: if rescale_differs { Rescale::IDENTITY } else { rescale },
    }
}

/// From one slice to the next, on average; nothing where there is no next.
fn step_of_positions(
    positions: &[DVec3],
    normal: DVec3,
    pixel_spacing_mm: [f64; 2],
    notes: &mut Vec<String>,
) -> Option<DVec3> {
    let (first, last) = (positions[0], *positions.last()?);
    let distances: Vec<f64> = positions.iter().map(|position| (*position - first).dot(normal)).collect();
    let whole_mm = *distances.last()?;
    if positions.len() < 2 || whole_mm <= 0.0 {
        return None;
    }
    tell_gaps(&distances, notes);
    let tilt_degrees = (last - first).angle_between(normal).to_degrees();
    if tilt_degrees > STRAIGHT_DEGREES {
        notes.push(format!(
            "the slices are shifted sideways by {tilt_degrees:.2}° (gantry tilt), so the volume's axes are not \
             perpendicular"
        ));
    }
    let stray = |(position, distance): (&DVec3, &f64)| {
        let expected = first + (last - first) * (distance / whole_mm);
        position.distance(expected)
    };
    let stray_mm = positions.iter().zip(&distances).map(stray).fold(0.0, f64::max);
    if stray_mm > 0.1 * pixel_spacing_mm[0].min(pixel_spacing_mm[1]) {
        notes.push(format!("slices lie up to {stray_mm:.3} mm beside the line from the first to the last"));
    }
    Some((last - first) / (positions.len() - 1) as f64)
}

/// The mean distance of slices without positions, from `SliceLocation` where there is one.
fn step_of_locations(infos: &[&FrameInfo], numbered: &str, notes: &mut Vec<String>) -> Option<f64> {
    let located: Option<Vec<f64>> = infos.iter().map(|info| info.location_mm).collect();
    let located = located.filter(|all| all.len() > 1 && all.last() > all.first());
    notes.push(format!(
        "ImagePositionPatient is missing; slices are ordered {}, and the volume begins at 0",
        if located.is_some() { "by their location" } else { numbered }
    ));
    let located = located?;
    let distances: Vec<f64> = located.iter().map(|location| location - located[0]).collect();
    tell_gaps(&distances, notes);
    Some(distances.last()? / (distances.len() - 1) as f64)
}

/// Tells of missing slices, or of slices at uneven distances. `distances` are from the first slice,
/// increasing.
fn tell_gaps(distances: &[f64], notes: &mut Vec<String>) {
    let gaps: Vec<f64> = distances.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let mut sorted = gaps.clone();
    sorted.sort_by(f64::total_cmp);
    let usual = sorted[sorted.len() / 2];
    let (least, most) = (sorted[0], sorted[sorted.len() - 1]);
    if most - usual <= EVEN * usual && usual - least <= EVEN * usual {
        return;
    }
    let mean = distances[distances.len() - 1] / gaps.len() as f64;
    let multiple = |gap: f64| (gap / usual).round();
    let is_multiple = |gap: &f64| (gap / usual - multiple(*gap)).abs() <= EVEN * multiple(*gap).max(1.0);
    if usual > 0.0 && gaps.iter().all(is_multiple) {
        let missing: f64 = gaps.iter().map(|gap| multiple(*gap) - 1.0).sum();
        let after = gaps.iter().position(|gap| multiple(*gap) > 1.0).unwrap_or(0) + 1;
        notes.push(format!(
            "slices missing: {missing}, the first after slice {after}; slices lie {usual:.4} mm apart, there up \
             to {most:.4} mm; all are drawn {mean:.4} mm apart"
        ));
    } else {
        notes.push(format!(
            "slices lie {least:.4} to {most:.4} mm apart, usually {usual:.4} mm; all are drawn {mean:.4} mm apart"
        ));
    }
}
