use glam::DVec3;

/// The world's directions in the patient's terms, as x, y and z and their opposites point.
const NAMES: [[&str; 2]; 3] = [["left", "right"], ["posterior", "anterior"], ["superior", "inferior"]];

/// Angles below this are not worth a word, in degrees.
const ALIGNED_DEG: f64 = 0.05;

/// Where a voxel axis points in the patient: the nearest direction, and how far off it is.
pub fn patient_direction(axis: DVec3) -> String {
    let parts = axis.to_array();
    let nearest =
        (0..3).fold(0, |best, part| if parts[part].abs() > parts[best].abs() { part } else { best });
    let name = NAMES[nearest][usize::from(parts[nearest] < 0.0)];
    let off_deg = (parts[nearest].abs() / axis.length()).min(1.0).acos().to_degrees();
    if off_deg < ALIGNED_DEG { name.to_owned() } else { format!("{name} ({off_deg:.1}° off)") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_named_after_where_they_point() {
        assert_eq!(patient_direction(DVec3::X), "left");
        assert_eq!(patient_direction(DVec3::NEG_Y), "anterior");
        assert_eq!(patient_direction(DVec3::NEG_Z), "inferior");
        let tilted = DVec3::new(0.0, 12f64.to_radians().sin(), 12f64.to_radians().cos());
        assert_eq!(patient_direction(tilted), "superior (12.0° off)");
    }
}
