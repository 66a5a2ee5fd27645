use glassbrick_volume::{VisibleBricks, boundary_bricks};
use proptest::prelude::*;

use super::any::{extent, layout};
use super::stored::hash;

proptest! {
    #[test]
    fn boundary_bricks_are_the_outermost_visible_ones_up_to_half_the_slots(
        extent in extent(60), layout in layout(), slots in 0..200usize, seed in any::<u64>(),
    ) {
        let grid = layout.grid(extent);
        let bricks: Vec<u32> = (0..grid.len() as u32).filter(|&brick| !hash(seed, brick.into()).is_multiple_of(3)).collect();
        let visible = VisibleBricks { bricks: bricks.clone(), ..VisibleBricks::default() };
        let boundary = boundary_bricks(&visible, &grid, slots);

        prop_assert_eq!(boundary.len(), bricks.len().min(slots / 2));
        let steps_to_surface = |brick: u32| {
            let (place, counts) = (grid.brick(brick as usize).to_array(), grid.counts.to_array());
            (0..3).map(|axis| place[axis].min(counts[axis] - 1 - place[axis])).min().expect("three axes")
        };
        let rank = |&brick: &u32| (steps_to_surface(brick), brick);
        prop_assert!(boundary.iter().map(rank).is_sorted_by(|a, b| a < b), "from outside in, then by id");
        let left_out = bricks.iter().filter(|brick| !boundary.contains(brick)).map(rank).min();
        if let (Some(last), Some(left_out)) = (boundary.last().map(rank), left_out) {
            prop_assert!(last < left_out);
        }
        prop_assert!(boundary.iter().all(|brick| bricks.contains(brick)));
    }
}
