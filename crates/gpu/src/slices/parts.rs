use glam::{BVec3, UVec3, Vec3};
use glassbrick_volume::{BrickCells, CELL_EDGE_LOG2};

use crate::slot_cells::CellQuestion;

/// Parts of a brick, at most.
pub const PARTS: usize = 8;

/// A part of a brick that is drawn for itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrickPart {
    /// The half-open box of samples that it owns, in voxels.
    pub owned: [Vec3; 2],
    /// Rank of its best value, for projections.
    pub best: f32,
}

/// Where a brick lies, and on which side of it the eye.
#[derive(Clone, Copy, Debug)]
pub struct BrickPlace {
    /// The half-open box of samples that it owns.
    pub owned: [Vec3; 2],
    /// Its first voxel, halo included.
    pub first_voxel: Vec3,
    /// The eye, in voxels; or where parallel rays come from.
    pub eye: Eye,
}

/// Where rays come from.
#[derive(Clone, Copy, Debug)]
pub enum Eye {
    At(Vec3),
    /// Parallel rays, by their direction.
    Along(Vec3),
}

/// The octants of a brick, the farthest first, each shrunk to the cells of which anything is asked: those that show
/// something, or for projections all. Octants without such cells are left out, so that few slices are drawn of nothing.
pub fn parts(place: &BrickPlace, cells: &BrickCells, question: &CellQuestion) -> Vec<BrickPart> {
    let cell_edge = (1 << CELL_EDGE_LOG2) as f32;
    let half = cells.edge as u32 / 2;
    let split = place.first_voxel + half as f32 * cell_edge;
    let is_low_near = match place.eye {
        Eye::At(eye) => eye.cmplt(split),
        Eye::Along(direction) => direction.cmpge(Vec3::ZERO),
    };
    let mut found: Vec<(usize, BrickPart)> = (0..PARTS)
        .filter_map(|octant| {
            let is_high = BVec3::new(octant & 1 != 0, octant & 2 != 0, octant & 4 != 0);
            let [low, high] = [
                UVec3::select(is_high, UVec3::splat(half), UVec3::ZERO),
                UVec3::select(is_high, UVec3::splat(cells.edge as u32), UVec3::splat(half)),
            ];
            let (shown, best) = shown_cells(cells, question, low, high)?;
            let [first, end] = shown.map(|cell| place.first_voxel + cell.as_vec3() * cell_edge);
            let owned = [first.max(place.owned[0]), end.min(place.owned[1])];
            let far_axes = (is_high & is_low_near) | (!is_high & !is_low_near);
            owned[0]
                .cmplt(owned[1])
                .all()
                .then_some((far_axes.bitmask().count_ones() as usize, BrickPart { owned, best }))
        })
        .collect();
    found.sort_by_key(|&(far_axes, _)| std::cmp::Reverse(far_axes));
    found.into_iter().map(|(_, part)| part).collect()
}

/// The box of the cells in [low, high) of which anything is asked, and the best rank in them.
fn shown_cells(
    cells: &BrickCells,
    question: &CellQuestion,
    low: UVec3,
    high: UVec3,
) -> Option<([UVec3; 2], f32)> {
    let mut bounds = [UVec3::MAX, UVec3::ZERO];
    let mut best = 0.0f32;
    for z in low.z..high.z {
        for y in low.y..high.y {
            for x in low.x..high.x {
                let index = (z as usize * cells.edge + y as usize) * cells.edge + x as usize;
                let (min, max) = (cells.min[index], cells.max[index]);
                let is_shown = match question {
                    CellQuestion::Distance(shown) => shown.meets(min, max),
                    CellQuestion::Rank([scale, offset]) => {
                        best = best.max(scale * min + offset).max(scale * max + offset);
                        true
                    }
                };
                if is_shown {
                    let cell = UVec3::new(x, y, z);
                    bounds = [bounds[0].min(cell), bounds[1].max(cell + 1)];
                }
            }
        }
    }
    bounds[0].cmplt(bounds[1]).all().then_some((bounds, best))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glassbrick_volume::{Band, Rescale, ShownValues};

    fn place(eye: Eye) -> BrickPlace {
        BrickPlace {
            owned: [Vec3::new(59.5, -0.501, -0.5), Vec3::new(119.5, 59.5, 59.5)],
            first_voxel: Vec3::new(58.0, -2.0, -2.0),
            eye,
        }
    }

    fn cells(value: impl Fn(usize, usize, usize) -> f32) -> BrickCells {
        let max: Vec<f32> = (0..512).map(|cell| value(cell % 8, cell / 8 % 8, cell / 64)).collect();
        BrickCells { edge: 8, min: vec![0.0; 512], max }
    }

    fn shown() -> CellQuestion {
        let band = Band { low: 500.0, high: f64::INFINITY };
        CellQuestion::Distance(ShownValues::new(&[band], Rescale::IDENTITY))
    }

    #[test]
    fn parts_are_the_boxes_of_shown_cells_by_octant() {
        let cells = cells(|x, y, z| if y == 0 && z == 0 && x >= 3 { 900.0 } else { 0.0 });
        let parts = parts(&place(Eye::Along(Vec3::X)), &cells, &shown());
        assert_eq!(parts.len(), 2);
        assert_eq!(
            parts[0].owned,
            [Vec3::new(90.0, -0.501, -0.5), Vec3::new(119.5, 6.0, 6.0)],
            "farthest first"
        );
        assert_eq!(parts[1].owned, [Vec3::new(82.0, -0.501, -0.5), Vec3::new(90.0, 6.0, 6.0)]);
    }

    #[test]
    fn parts_of_a_whole_brick_share_it_out_and_hide_none_that_comes_later() {
        let all = cells(|_, _, _| 900.0);
        for eye in [Vec3::new(-50.0, 20.0, 300.0), Vec3::new(88.0, 29.0, 29.0), Vec3::new(90.0, 30.0, 30.0)] {
            let parts = parts(&place(Eye::At(eye)), &all, &shown());
            assert_eq!(parts.len(), 8);
            let volume: f32 =
                parts.iter().map(|part| (part.owned[1] - part.owned[0]).element_product()).sum();
            assert!((volume - 60.0 * 60.001 * 60.0).abs() < 1.0);
            // On each axis on which two parts differ, the later one is not farther from the eye on all of them.
            for (first, later) in (0..8).flat_map(|a| (a + 1..8).map(move |b| (a, b))) {
                let beyond = |axis: usize| {
                    let [a, b] = [first, later].map(|part: usize| parts[part].owned);
                    (a[1][axis] <= b[0][axis] && eye[axis] < b[0][axis])
                        || (b[1][axis] <= a[0][axis] && eye[axis] >= a[0][axis])
                };
                let nearer =
                    |axis: usize| parts[first].owned[0][axis] != parts[later].owned[0][axis] && !beyond(axis);
                assert!((0..3).any(nearer), "{eye}: {first} hides {later}");
            }
        }
    }

    #[test]
    fn projections_keep_every_cell_and_know_the_best_of_each_part() {
        let cells = cells(|x, _, _| x as f32 * 100.0);
        let parts = parts(&place(Eye::Along(Vec3::NEG_X)), &cells, &CellQuestion::Rank([1e-3, 0.0]));
        assert_eq!(parts.len(), 8);
        assert!((parts[0].best - 0.3).abs() < 1e-6 && (parts[7].best - 0.7).abs() < 1e-6);
    }
}
