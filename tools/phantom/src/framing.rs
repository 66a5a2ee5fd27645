//! Which part of the body a volume of some extent shows.

/// Where voxels lie in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    pub spacing_mm: [f64; 3],
    /// Centre of the first voxel.
    pub origin_mm: [f64; 3],
}

/// The box that holds the body: its width and depth, centred, and its height from the soles.
pub const BODY_SIZE_MM: [f64; 3] = [466.0, 274.0, 1800.0];
/// The middle of the body's depth.
const MIDDLE_Y_MM: f64 = 3.0;
/// Deeper volumes show the whole body.
const WHOLE_BODY_FROM_MM: f64 = 1500.0;
/// Shallower volumes show a slab around the heart.
const SLAB_BELOW_MM: f64 = 200.0;
const HEART_Z_MM: f64 = 1315.0;

/// The frame of a volume.
pub fn frame(extent: [u32; 3]) -> Frame {
    let [nx, ny, nz] = extent.map(f64::from);
    let [width, depth, height] = BODY_SIZE_MM;
    let in_plane = (width / nx).max(depth / ny);
    let reach = nz * in_plane;
    let (bottom, spacing_z) = if reach >= WHOLE_BODY_FROM_MM {
        (0.0, height / nz)
    } else if reach < SLAB_BELOW_MM {
        (HEART_Z_MM - reach / 2.0, in_plane)
    } else {
        (height - reach, in_plane)
    };
    Frame {
        spacing_mm: [in_plane, in_plane, spacing_z],
        origin_mm: [
            -(nx - 1.0) / 2.0 * in_plane,
            MIDDLE_Y_MM - (ny - 1.0) / 2.0 * in_plane,
            bottom + spacing_z / 2.0,
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_visible_human_sized_volume_shows_the_whole_body() {
        let frame = frame([512, 304, 1730]);
        assert!(frame.spacing_mm.iter().all(|&mm| (0.9..1.1).contains(&mm)), "{frame:?}");
        assert!((frame.spacing_mm[2] * 1730.0 - 1800.0).abs() < 1e-9);
        assert!((frame.origin_mm[2] - frame.spacing_mm[2] / 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_cube_shows_head_and_chest_with_cubic_voxels() {
        let frame = frame([256, 256, 256]);
        assert_eq!(frame.spacing_mm, [466.0 / 256.0; 3]);
        assert!((frame.origin_mm[2] + 255.5 * frame.spacing_mm[2] - 1800.0).abs() < 1e-9);
    }

    #[test]
    fn a_few_slices_show_the_heart() {
        let frame = frame([512, 512, 106]);
        let middle = frame.origin_mm[2] + 52.5 * frame.spacing_mm[2];
        assert!((middle - HEART_Z_MM).abs() < 1e-9);
    }

    #[test]
    fn twice_the_voxels_show_the_same_box() {
        for extent in [[5, 7, 11], [96, 80, 128], [1, 1, 1], [16, 16, 4000]] {
            let (coarse, fine) = (frame(extent), frame(extent.map(|n| 2 * n)));
            for axis in 0..3 {
                assert!((coarse.spacing_mm[axis] - 2.0 * fine.spacing_mm[axis]).abs() < 1e-9);
                let corner = |frame: &Frame| frame.origin_mm[axis] - frame.spacing_mm[axis] / 2.0;
                assert!((corner(&coarse) - corner(&fine)).abs() < 1e-9, "{extent:?}");
            }
        }
    }
}
