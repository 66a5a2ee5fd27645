use std::collections::HashSet;

use glassbrick_volume::{BrickGrid, FramePlan, FrameRays, PixelRect};
use proptest::prelude::*;

use super::any::view;
use super::cases;
use super::stored::hash;

/// Where each brick of a grid stands in a plan: its layer and footprint.
fn places(plan: &FramePlan, grid: &BrickGrid) -> Vec<Option<(usize, PixelRect)>> {
    let mut places = vec![None; grid.len()];
    for (layer, bricks) in plan.layers.iter().enumerate() {
        for brick in &bricks.bricks {
            places[brick.index as usize] = Some((layer, brick.footprint));
        }
    }
    places
}

fn all(grid: &BrickGrid) -> Vec<u32> {
    (0..grid.len() as u32).collect()
}

/// The bricks that a ray's samples belong to, one after the other.
fn bricks_along(grid: &BrickGrid, rays: &FrameRays, column: u32, row: u32) -> Vec<usize> {
    let ray = rays.ray(column, row);
    let owners = (0..rays.sample_count).filter_map(|number| grid.owner(ray.sample(number)));
    let mut bricks: Vec<usize> = owners.map(|brick| grid.index(brick)).collect();
    bricks.dedup();
    bricks
}

proptest! {
    #![proptest_config(cases(1500))]

    #[test]
    fn layers_are_an_order_from_front_to_back_and_footprints_hold_every_sample(view in view(36)) {
        let (grid, rays) = (view.grid(), view.rays());
        let plan = FramePlan::new(0, &grid, &rays, &all(&grid));
        let places = places(&plan, &grid);
        for row in 0..rays.size.y {
            for column in 0..rays.size.x {
                let mut front = None;
                for brick in bricks_along(&grid, &rays, column, row) {
                    let Some((layer, footprint)) = places[brick] else {
                        return Err(TestCaseError::fail(format!("brick {brick} is not planned")));
                    };
                    prop_assert!(front < Some(layer), "layer {} comes after {:?}", layer, front);
                    front = Some(layer);
                    let holds = (footprint.min[0]..footprint.max[0]).contains(&column)
                        && (footprint.min[1]..footprint.max[1]).contains(&row);
                    prop_assert!(holds, "pixel {column}, {row} is not in {footprint:?}");
                }
            }
        }
    }

    #[test]
    fn a_plan_lists_each_of_its_bricks_once_and_no_other(view in view(36), seed in any::<u64>()) {
        let (grid, rays) = (view.grid(), view.rays());
        let some: Vec<u32> =
            all(&grid).into_iter().filter(|&brick| hash(seed, brick.into()).is_multiple_of(3)).collect();
        let plan = FramePlan::new(0, &grid, &rays, &some);
        prop_assert!(plan.layers.iter().map(|layer| layer.distance).is_sorted_by(|a, b| a < b));
        let mut seen = HashSet::new();
        for layer in &plan.layers {
            prop_assert!(!layer.bricks.is_empty());
            prop_assert!(layer.bricks.is_sorted_by(|a, b| a.index < b.index));
            for brick in &layer.bricks {
                prop_assert!(some.contains(&brick.index) && seen.insert(brick.index));
                let PixelRect { min, max } = brick.footprint;
                prop_assert!(min[0] < max[0] && max[0] <= rays.size.x && min[1] < max[1] && max[1] <= rays.size.y);
            }
        }
        prop_assert_eq!(seen.len(), plan.bricks());

        // What else is drawn does not change a brick's place.
        let whole = places(&FramePlan::new(0, &grid, &rays, &all(&grid)), &grid);
        for brick in all(&grid) {
            let is_planned = whole[brick as usize].is_some() && some.contains(&brick);
            prop_assert_eq!(seen.contains(&brick), is_planned);
        }
    }
}
