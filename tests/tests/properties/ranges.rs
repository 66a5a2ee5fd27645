use glam::UVec3;
use glassbrick_volume::{Brick, BrickId, BrickSource, Voxels};
use proptest::prelude::*;

use super::cases;
use super::stored::{Stored, stored};

/// Smallest and largest voxel of a brick's core with `around` voxels more on each side.
fn by_hand(volume: &Stored, brick: UVec3, around: u32) -> [f32; 2] {
    let grid = volume.layout.grid(volume.desc.extent);
    let low = grid.core_start(brick).saturating_sub(UVec3::splat(around));
    let high = (grid.core_end(brick) + around).min(volume.desc.extent);
    let voxels = volume.voxels_in(low, high);
    voxels.fold([f32::INFINITY, f32::NEG_INFINITY], |[min, max], voxel| [min.min(voxel), max.max(voxel)])
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn ranges_are_those_counted_by_hand(volume in stored(30)) {
        let source = volume.source();
        let grid = source.grid(0);
        prop_assert_eq!(source.ranges(0).len(), grid.len());
        for (index, range) in source.ranges(0).iter().enumerate() {
            let brick = grid.brick(index);
            prop_assert_eq!(range.core, by_hand(&volume, brick, 0), "core of {}", brick);
            prop_assert_eq!(range.reach, by_hand(&volume, brick, 1), "reach of {}", brick);
        }
        prop_assert_eq!(source.not_finite(), volume.not_finite);
    }

    #[test]
    fn a_brick_holds_its_voxels_and_beyond_the_volume_its_edge(volume in stored(20)) {
        let source = volume.source();
        let grid = source.grid(0);
        for index in 0..grid.len() {
            let place = grid.brick(index);
            let UVec3 { x, y, z } = place;
            let brick = source.brick(BrickId { level: 0, x, y, z }).expect("the array is at hand");
            let edge = brick.edge;
            prop_assert_eq!(edge, volume.layout.edge);
            let voxels = floats(&brick);
            prop_assert_eq!(voxels.len(), volume.layout.voxels() + Brick::PADDING);
            for (index, &voxel) in voxels[..volume.layout.voxels()].iter().enumerate() {
                let offset = super::stored::voxel_at(index, UVec3::splat(edge)).as_ivec3();
                prop_assert_eq!(voxel, volume.at(grid.halo_start(place) + offset), "{} of {}", offset, place);
            }
        }
    }
}

fn floats(brick: &Brick) -> Vec<f32> {
    match &brick.voxels {
        Voxels::U8(voxels) => voxels.iter().map(|&voxel| voxel.into()).collect(),
        Voxels::I8(voxels) => voxels.iter().map(|&voxel| voxel.into()).collect(),
        Voxels::U16(voxels) => voxels.iter().map(|&voxel| voxel.into()).collect(),
        Voxels::I16(voxels) => voxels.iter().map(|&voxel| voxel.into()).collect(),
        Voxels::F32(voxels) => voxels.clone(),
    }
}
