use glam::{DVec3, I64Vec3, UVec3};

use crate::{BrickGrid, Footprints, FrameRays, PixelRect};

/// A frame as data: which bricks are drawn in which order. The same for every executor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FramePlan {
    /// The level whose bricks are drawn.
    pub level: u32,
    /// Front to back; a ray meets at most one brick of a layer.
    pub layers: Vec<Layer>,
}

/// The bricks at one Manhattan distance from the eye's brick.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layer {
    /// The distance, in bricks.
    pub distance: u64,
    /// Ascending by their place in the grid.
    pub bricks: Vec<PlannedBrick>,
}

/// A brick that is to be drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PlannedBrick {
    /// Its place in the grid.
    pub index: u32,
    /// The pixels that can meet it.
    pub footprint: PixelRect,
}

impl FramePlan {
    /// Orders those of `bricks` (places in `grid`, ascending) that are in the frustum.
    pub fn new(level: u32, grid: &BrickGrid, rays: &FrameRays, bricks: &[u32]) -> Self {
        let eye_brick = eye_brick(grid, rays);
        let footprints = Footprints::new(rays);
        let mut planned: Vec<(u64, PlannedBrick)> = bricks
            .iter()
            .filter_map(|&index| {
                let brick = grid.brick(index as usize);
                let footprint = footprints.of_brick(grid, brick)?;
                Some((manhattan_distance(brick, eye_brick), PlannedBrick { index, footprint }))
            })
            .collect();
        planned.sort_unstable_by_key(|&(distance, brick)| (distance, brick.index));
        let layers = planned
            .chunk_by(|a, b| a.0 == b.0)
            .map(|layer| Layer {
                distance: layer[0].0,
                bricks: layer.iter().map(|&(_, brick)| brick).collect(),
            })
            .collect();
        Self { level, layers }
    }

    /// Number of bricks in all layers.
    pub fn bricks(&self) -> usize {
        self.layers.iter().map(|layer| layer.bricks.len()).sum()
    }
}

/// The eye's brick on the unbounded lattice; for an orthographic camera the corner brick that faces the viewer.
///
/// The eye is rounded to `f32` as samples are. Rounding keeps order, so on each axis no sample lies on the other side
/// of the eye than its ray goes, and a ray never comes back towards the eye's brick.
pub fn eye_brick(grid: &BrickGrid, rays: &FrameRays) -> I64Vec3 {
    if rays.is_perspective() {
        let eye_voxel = rays.eye_voxel.as_vec3().as_dvec3();
        return ((eye_voxel + 0.5) / f64::from(grid.layout.core())).floor().as_i64vec3();
    }
    let last = grid.counts.as_i64vec3() - 1;
    I64Vec3::select(rays.forward_voxel.cmpge(DVec3::ZERO), I64Vec3::ZERO, last)
}

fn manhattan_distance(brick: UVec3, eye_brick: I64Vec3) -> u64 {
    let apart = brick.as_i64vec3() - eye_brick;
    apart.to_array().into_iter().map(i64::unsigned_abs).fold(0, u64::saturating_add)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BrickLayout, Camera, NamedView, Projection, StoredType, VolumeDesc};
    use glam::UVec2;

    fn plan(camera: impl Fn(&VolumeDesc) -> Camera) -> (FramePlan, FrameRays, BrickGrid) {
        let desc = VolumeDesc::new(UVec3::new(120, 90, 61), StoredType::U8);
        let grid = BrickLayout { edge: 34, halo: 2 }.grid(desc.extent);
        let rays =
            FrameRays::new(&desc.level(0), &camera(&desc), UVec2::new(33, 27), 1.0).expect("sound camera");
        let all: Vec<u32> = (0..grid.len() as u32).collect();
        (FramePlan::new(0, &grid, &rays, &all), rays, grid)
    }

    /// Along each ray, the samples' bricks follow the layers, and no two bricks share a layer.
    fn layers_are_a_front_to_back_order(camera: impl Fn(&VolumeDesc) -> Camera) {
        let (plan, rays, grid) = plan(camera);
        let mut layer_of = vec![None; grid.len()];
        for (number, layer) in plan.layers.iter().enumerate() {
            for brick in &layer.bricks {
                layer_of[brick.index as usize] = Some(number);
            }
        }
        for row in 0..rays.size.y {
            for column in 0..rays.size.x {
                let ray = rays.ray(column, row);
                let mut bricks: Vec<usize> = (0..rays.sample_count)
                    .filter_map(|number| grid.owner(ray.sample(number)))
                    .map(|brick| grid.index(brick))
                    .collect();
                bricks.dedup();
                let layers: Vec<_> = bricks.iter().map(|&b| layer_of[b].expect("planned")).collect();
                assert!(layers.is_sorted_by(|a, b| a < b), "{layers:?}");
            }
        }
    }

    #[test]
    fn layers_are_a_front_to_back_order_for_an_eye_outside() {
        layers_are_a_front_to_back_order(|desc| Camera::framing_around(desc, 33.0, -20.0));
        layers_are_a_front_to_back_order(|desc| Camera::framing(desc, NamedView::Bottom));
    }

    #[test]
    fn layers_are_a_front_to_back_order_for_an_eye_inside_and_on_a_face() {
        for eye_mm in
            [DVec3::new(40.0, 50.0, 20.0), DVec3::new(29.5, 59.5, 29.5), DVec3::new(29.5, 10.0, 0.0)]
        {
            layers_are_a_front_to_back_order(|desc| Camera {
                eye_mm,
                target_mm: eye_mm + DVec3::new(1.0, -0.4, 0.2),
                ..Camera::framing(desc, NamedView::Front)
            });
        }
    }

    #[test]
    fn layers_are_a_front_to_back_order_for_an_eye_off_a_face_by_less_than_samples_are_rounded() {
        let eye_mm = DVec3::new(40.0, 29.499_999_999, 40.0);
        layers_are_a_front_to_back_order(|desc| Camera {
            eye_mm,
            target_mm: eye_mm - DVec3::new(0.0, 1e-7, 1.0),
            up: DVec3::X,
            ..Camera::framing(desc, NamedView::Front)
        });
    }

    #[test]
    fn layers_are_a_front_to_back_order_for_parallel_rays() {
        let projection = Projection::Orthographic { height_mm: 150.0 };
        layers_are_a_front_to_back_order(|desc| Camera {
            projection,
            ..Camera::framing_around(desc, 200.0, 40.0)
        });
        layers_are_a_front_to_back_order(|desc| Camera {
            projection,
            ..Camera::framing(desc, NamedView::Left)
        });
    }

    #[test]
    fn the_first_layer_holds_the_eyes_brick() {
        let (plan, _, grid) = plan(|desc| Camera {
            eye_mm: DVec3::new(45.0, 45.0, 30.0),
            target_mm: DVec3::new(100.0, 45.0, 30.0),
            ..Camera::framing(desc, NamedView::Front)
        });
        assert_eq!(plan.layers[0].distance, 0);
        assert_eq!(plan.layers[0].bricks[0].index as usize, grid.index(UVec3::new(1, 1, 1)));
    }
}
