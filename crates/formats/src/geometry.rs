//! What every format's header must come down to: a grid of sane size, somewhere in the world.

use glam::{DMat3, DVec3, UVec3};

/// Voxels along one axis beyond which a header is taken to be damaged.
const LARGEST_EXTENT: u64 = 1 << 22;

/// The least volume of the box that three unit directions span. Gantry tilt stays far above it.
const LEAST_DETERMINANT: f64 = 1e-3;

/// Where a grid of voxels lies: LPS millimetres, positive spacing, independent unit directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Grid {
    pub spacing_mm: DVec3,
    pub origin_mm: DVec3,
    pub direction: DMat3,
}

impl Grid {
    /// The grid whose voxel axes step by these columns of LPS millimetres. A mirrored axis is one whose column
    /// points backwards.
    ///
    /// # Errors
    /// A sentence on what is wrong with them.
    pub fn from_columns(columns: DMat3, origin_mm: DVec3) -> Result<Self, String> {
        if !columns.is_finite() || !origin_mm.is_finite() {
            return Err("the place of the voxels in the world is not finite (NaN or inf)".to_owned());
        }
        let axes = [columns.x_axis, columns.y_axis, columns.z_axis];
        let lengths = axes.map(DVec3::length);
        if let Some(axis) = lengths.iter().position(|length| !(1e-12..=1e12).contains(length)) {
            let name = ["x", "y", "z"][axis];
            return Err(format!("the spacing along {name} is {}; it must be a length", lengths[axis]));
        }
        // Adding zero turns −0 into 0, which is what people expect to see.
        let [x, y, z] = std::array::from_fn(|axis| axes[axis] / lengths[axis] + DVec3::ZERO);
        let direction = DMat3::from_cols(x, y, z);
        if direction.determinant().abs() < LEAST_DETERMINANT {
            return Err("the directions of the voxel axes lie in one plane".to_owned());
        }
        Ok(Self { spacing_mm: DVec3::from_array(lengths), origin_mm: origin_mm + DVec3::ZERO, direction })
    }
}

/// The extent of a volume, checked so that sizes in bytes cannot overflow.
///
/// # Errors
/// A sentence on what is wrong with it.
pub(crate) fn checked_extent(sizes: [u64; 3]) -> Result<UVec3, String> {
    let [x, y, z] = sizes;
    if sizes.contains(&0) {
        return Err(format!("the volume has no voxels ({x}x{y}x{z})"));
    }
    let too_many = || format!("the header claims {x}x{y}x{z} voxels, more than any volume has");
    if sizes.iter().any(|&size| size > LARGEST_EXTENT) {
        return Err(too_many());
    }
    match x.checked_mul(y).and_then(|slice| slice.checked_mul(z)) {
        Some(voxels) if voxels <= u64::MAX >> 8 => Ok(UVec3::new(x as u32, y as u32, z as u32)),
        _ => Err(too_many()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spacing_and_direction_are_taken_apart() {
        let columns = DMat3::from_cols(DVec3::new(-2.0, 0.0, 0.0), DVec3::Y * 0.78125, DVec3::Z * 3.0);
        let grid = Grid::from_columns(columns, DVec3::ONE).unwrap();
        assert_eq!(grid.spacing_mm, DVec3::new(2.0, 0.78125, 3.0));
        assert_eq!(grid.direction, DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)));
    }

    #[test]
    fn shear_is_kept_and_a_flat_grid_refused() {
        let tilted = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(0.0, 0.5, 1.0));
        let grid = Grid::from_columns(tilted, DVec3::ZERO).unwrap();
        assert!((grid.direction.z_axis.length() - 1.0).abs() < 1e-15 && grid.direction.z_axis.y > 0.4);
        let flat = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 1e-5));
        assert!(Grid::from_columns(flat, DVec3::ZERO).unwrap_err().contains("one plane"));
    }

    #[test]
    fn what_is_no_length_is_refused() {
        let zero = DMat3::from_cols(DVec3::X, DVec3::ZERO, DVec3::Z);
        assert!(Grid::from_columns(zero, DVec3::ZERO).unwrap_err().contains("along y"));
        let nan = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::NAN);
        assert!(Grid::from_columns(nan, DVec3::ZERO).is_err());
        assert!(Grid::from_columns(DMat3::IDENTITY, DVec3::splat(f64::INFINITY)).is_err());
    }

    #[test]
    fn extents_that_no_file_can_back_are_refused() {
        assert_eq!(checked_extent([512, 304, 1730]), Ok(UVec3::new(512, 304, 1730)));
        for sizes in [[0, 1, 1], [1 << 23, 1, 1], [1 << 22, 1 << 22, 1 << 22], [u64::MAX, 2, 2]] {
            assert!(checked_extent(sizes).is_err(), "{sizes:?}");
        }
    }
}
