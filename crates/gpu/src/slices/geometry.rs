use glam::{DMat3, DVec3, UVec3};
use glassbrick_residency::SlotPlace;
use glassbrick_shaders::SlicedBrick;
use glassbrick_volume::{BrickGrid, FrameRays, PixelRect, VolumeDesc};

use super::parts::{BrickPart, BrickPlace, Eye};

/// Boxes are taken this much larger, in voxels, than they are, for the rounding of positions to f32.
const SLACK_VOXELS: f64 = 1.0 / 64.0;

/// And this much in the picture, in pixels: rasterizers take pixels by their centres, as rays do, and place corners on a
/// grid of 1/256 pixel. A whole pixel would cost a third more fragments of bricks seen from afar, and let hidden ones peep
/// out.
const SLACK_PIXELS: f64 = 1.0 / 8.0;

/// Where bricks and their slices lie in a tile of the picture.
///
/// Proxies are a little larger than bricks: which samples a brick owns is decided by each fragment.
pub struct SliceGeometry {
    grid: BrickGrid,
    /// Right, up (each in units of half the tile at depth 1) and slice, as directions in voxels and offsets.
    rows: [(DVec3, f64); 3],
    /// Depth of a slice, in mm: from number 0 and from one to the next.
    depth_mm: [f64; 2],
    /// Where the tile's middle is, in units of half the tile, as seen from the picture's.
    middle: [f64; 2],
    perspective: bool,
    eye: Eye,
    sample_count: u32,
    /// Of a pixel at depth 1 mm, or of any pixel of a parallel projection.
    pixel_mm: f64,
    /// Voxels along each axis for a mm away from that axis' faces.
    voxels_per_mm: DVec3,
    /// Which corner of a box is taken as which, so that slices go from corner 0 to corner 7 and faces turn one way.
    corners: [UVec3; 8],
}

impl SliceGeometry {
    /// For the level `desc` with its own grid.
    pub fn new(rays: &FrameRays, desc: &VolumeDesc, grid: BrickGrid, tile: &PixelRect) -> Self {
        let [right, up, depth] = rays.picture_from_voxel();
        let picture = rays.size.as_dvec2().to_array();
        let length = |axis: usize| f64::from(tile.max[axis] - tile.min[axis]);
        let (x_scale, y_scale) = (picture[0] / length(0), picture[1] / length(1));
        let middle = [
            x_scale - 2.0 * f64::from(tile.min[0]) / length(0) - 1.0,
            1.0 - y_scale + 2.0 * f64::from(tile.min[1]) / length(1),
        ];
        let scaled = |(direction, offset): (DVec3, f64), scale: f64| (direction * scale, offset * scale);
        let (first_mm, step_mm) = (rays.depth_mm(0), rays.step_mm);
        let slice = (depth.0 / step_mm, (depth.1 - first_mm) / step_mm);
        let voxel_from_world = desc.voxel_from_world().matrix3;
        Self {
            grid,
            rows: [scaled(right, x_scale), scaled(up, y_scale), slice],
            depth_mm: [first_mm, step_mm],
            middle,
            perspective: rays.is_perspective(),
            eye: if rays.is_perspective() {
                Eye::At(rays.eye_voxel.as_vec3())
            } else {
                Eye::Along(rays.forward_voxel.as_vec3())
            },
            sample_count: rays.sample_count,
            pixel_mm: rays.pixel_mm(),
            voxels_per_mm: DVec3::from_array(std::array::from_fn(|axis| voxel_from_world.row(axis).length())),
            corners: corner_order([right.0, up.0, depth.0]),
        }
    }

    /// The whole of a brick as a part.
    pub fn whole(&self, index: u32, best: f32) -> BrickPart {
        BrickPart { owned: self.grid.owned_box(self.grid.brick(index as usize)), best }
    }

    /// Where a brick lies, and the eye.
    pub fn place(&self, index: u32) -> BrickPlace {
        let brick = self.grid.brick(index as usize);
        BrickPlace {
            owned: self.grid.owned_box(brick),
            first_voxel: self.grid.halo_start(brick).as_vec3(),
            eye: self.eye,
        }
    }

    /// What is drawn of a part of a brick, and of how many slices; nothing where none of its samples is in front of the
    /// eye.
    pub fn of(&self, index: u32, slot: Option<SlotPlace>, part: &BrickPart) -> Option<(SlicedBrick, u32)> {
        let brick = self.grid.brick(index as usize);
        let owned = part.owned;
        let [low, high] = [owned[0].as_dvec3() - SLACK_VOXELS, owned[1].as_dvec3() + SLACK_VOXELS];
        let slice = |corner: UVec3, [low, high]: [DVec3; 2]| {
            let voxel = DVec3::select(corner.cmpeq(UVec3::ONE), high, low);
            self.rows[2].0.dot(voxel) + self.rows[2].1
        };
        let nearest = slice(self.corners[0], [low, high]).ceil().max(0.0);
        let farthest = slice(self.corners[7], [low, high]).floor().min(f64::from(self.sample_count) - 1.0);
        if farthest < nearest {
            return None;
        }
        let farthest_mm = self.depth_mm[0] + farthest * self.depth_mm[1];
        let pixel_mm = if self.perspective { self.pixel_mm * farthest_mm } else { self.pixel_mm };
        let more = self.voxels_per_mm * (SLACK_PIXELS * pixel_mm);
        let larger = [low - more, high + more];
        let core_start = self.grid.core_start(brick).as_vec3();
        let texel = slot.map_or(core_start, |slot| slot.texel.as_vec3()) + self.grid.layout.halo as f32;
        let sliced = SlicedBrick {
            corners: self.corners.map(|corner| self.clip(corner, larger)),
            owned_low: owned[0].to_array(),
            last_slice: farthest as f32,
            owned_high: owned[1].to_array(),
            // Never below the ranks of its samples, for rounding.
            best: (part.best + 4.0 * f32::EPSILON).max(2e-6),
            texel_from_voxel: (texel - core_start).to_array(),
            first_slice: nearest as f32,
        };
        Some((sliced, (farthest - nearest) as u32 + 1))
    }

    /// A corner in clip space before the division; z is the slice.
    fn clip(&self, corner: UVec3, [low, high]: [DVec3; 2]) -> [f32; 4] {
        let voxel = DVec3::select(corner.cmpeq(UVec3::ONE), high, low);
        let [right, up, slice] = self.rows.map(|(direction, offset)| direction.dot(voxel) + offset);
        let w = if self.perspective { self.depth_mm[0] + slice * self.depth_mm[1] } else { 1.0 };
        [right + self.middle[0] * w, up + self.middle[1] * w, slice, w].map(|component| component as f32)
    }
}

/// The corners of a box (0: low, 1: high on each voxel axis) in the order in which shaders know them: bit 0 of a corner's
/// number is its place along the first axis and so on; along each, slices grow; and seen along all three, right goes to up
/// by the same turn whatever the volume's handedness.
fn corner_order([right, up, depth]: [DVec3; 3]) -> [UVec3; 8] {
    let is_flipped = depth.cmplt(DVec3::ZERO);
    let flips = [is_flipped.x, is_flipped.y, is_flipped.z];
    let odd_flips = flips.iter().filter(|&&flipped| flipped).count() % 2 == 1;
    let is_mirrored = (DMat3::from_cols(right, up, depth).determinant() < 0.0) != odd_flips;
    std::array::from_fn(|number| {
        let mut along = [number & 1, number >> 1 & 1, number >> 2];
        if is_mirrored {
            along.swap(0, 1);
        }
        let corner = |axis: usize| (along[axis] ^ usize::from(flips[axis])) as u32;
        UVec3::new(corner(0), corner(1), corner(2))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec2;
    use glassbrick_volume::{BrickLayout, Camera, Projection, StoredType};

    fn each_sample_lies_in_a_slice_of_its_brick(camera: Camera, desc: &VolumeDesc) {
        let grid = BrickLayout { edge: 24, halo: 2 }.grid(desc.extent);
        let rays = FrameRays::new(&desc.level(0), &camera, UVec2::new(23, 17), 0.8).expect("sound camera");
        let tile = PixelRect { min: [3, 2], max: [20, 15] };
        let geometry = SliceGeometry::new(&rays, desc, grid, &tile);
        let drawn: Vec<_> = (0..grid.len() as u32)
            .map(|index| geometry.of(index, None, &geometry.whole(index, 1.0)))
            .collect();
        for row in tile.min[1]..tile.max[1] {
            for column in tile.min[0]..tile.max[0] {
                let ray = rays.ray(column, row);
                for number in 0..rays.sample_count {
                    let Some(owner) = grid.owner(ray.sample(number)) else { continue };
                    let (brick, slices) = drawn[grid.index(owner)].expect("a brick with a sample has slices");
                    let first = brick.last_slice as u32 + 1 - slices;
                    assert!((first..first + slices).contains(&number));
                    assert_eq!(brick.first_slice as u32, first);
                    let clip = geometry_clip(&geometry, ray.sample(number).as_dvec3());
                    let x = (clip[0] / clip[3] + 1.0) / 2.0 * 17.0 + 3.0 - (f64::from(column) + 0.5);
                    let y = (1.0 - clip[1] / clip[3]) / 2.0 * 13.0 + 2.0 - (f64::from(row) + 0.5);
                    assert!(x.abs() < 1e-3 && y.abs() < 1e-3, "off its pixel by {x}, {y}");
                    assert!((clip[2] - f64::from(number)).abs() < 1e-3);
                }
            }
        }
        for (brick, _) in drawn.into_iter().flatten() {
            let slices: Vec<f32> = brick.corners.iter().map(|corner| corner[2]).collect();
            for (corner, bit) in (0..8).flat_map(|corner| [1, 2, 4].map(|bit| (corner, bit))) {
                assert!(slices[corner & !bit] <= slices[corner | bit], "{slices:?}");
            }
        }
    }

    fn geometry_clip(geometry: &SliceGeometry, voxel: DVec3) -> [f64; 4] {
        geometry.clip(UVec3::ZERO, [voxel, voxel]).map(f64::from)
    }

    #[test]
    fn slices_hold_every_sample_at_its_pixel() {
        let mut desc = VolumeDesc::new(UVec3::new(47, 30, 61), StoredType::U8);
        desc.spacing_mm = DVec3::new(0.7, 1.0, 1.6);
        for (azimuth, elevation) in [(0.0, 0.0), (33.0, 20.0), (200.0, -50.0), (90.0, 90.0)] {
            for projection in
                [Projection::Perspective { fov_y_deg: 40.0 }, Projection::Orthographic { height_mm: 90.0 }]
            {
                let camera = Camera { projection, ..Camera::framing_around(&desc, azimuth, elevation) };
                each_sample_lies_in_a_slice_of_its_brick(camera, &desc);
            }
        }
        let eye_mm = DVec3::new(15.0, 14.0, 40.0);
        let camera = Camera {
            eye_mm,
            target_mm: eye_mm + DVec3::new(1.0, 0.3, -0.4),
            ..Camera::framing_around(&desc, 0.0, 0.0)
        };
        each_sample_lies_in_a_slice_of_its_brick(camera, &desc);
    }

    #[test]
    fn faces_turn_one_way_whatever_the_handedness() {
        let turn = |rows: [DVec3; 3]| {
            let at = |corner: usize| {
                let corner = corner_order(rows)[corner].as_dvec3();
                [rows[0].dot(corner), rows[1].dot(corner)]
            };
            let [a, b, c] = [at(0), at(1), at(2)];
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) > 0.0
        };
        for x in [-1.0, 1.0] {
            for y in [-1.0, 1.0] {
                for z in [-1.0, 1.0] {
                    let depth = DVec3::new(0.1, 0.2, z);
                    assert!(turn([DVec3::X * x, DVec3::Y * y, depth]));
                    assert!(turn([DVec3::Y * x, DVec3::X * y, depth]));
                }
            }
        }
    }
}
