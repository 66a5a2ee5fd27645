use crate::{BrickCells, CELL_EDGE_LOG2};
use glam::Vec3;

/// How far each cell of a brick is from one that may show something.
pub struct Occupancy {
    /// In cells, along the farthest axis (Chebyshev); 0: the cell may show something. x fastest, and then a few bytes
    /// that mean nothing, so that four can be read anywhere.
    pub distance: Vec<u8>,
    /// The box of the cells that may show something, in the brick's voxels: no sample outside it shows anything.
    pub occupied: [Vec3; 2],
}

/// Distances beyond this are not told apart; a ray asks again when it has gone so far.
const FARTHEST: u8 = 100;

impl Occupancy {
    /// Finds the cells for which `shows` holds of their smallest and largest stored value; nothing where it holds for
    /// none.
    pub fn new(cells: &BrickCells, shows: impl Fn(f32, f32) -> bool) -> Option<Self> {
        let edge = cells.edge;
        let mut distance = vec![FARTHEST; edge * edge * edge + 4];
        // A row of cells along x is the bits of a word.
        let mut rows = vec![0u64; edge * edge];
        let mut bounds = [[usize::MAX; 3], [0; 3]];
        for (index, (&min, &max)) in cells.min.iter().zip(&cells.max).enumerate() {
            if shows(min, max) {
                distance[index] = 0;
                rows[index / edge] |= 1 << (index % edge);
                let cell = [index % edge, index / edge % edge, index / (edge * edge)];
                for axis in 0..3 {
                    bounds[0][axis] = bounds[0][axis].min(cell[axis]);
                    bounds[1][axis] = bounds[1][axis].max(cell[axis] + 1);
                }
            }
        }
        if bounds[0][0] == usize::MAX {
            return None;
        }
        spread(&mut rows, &mut distance, edge);
        let to_voxels = |cell: [usize; 3]| Vec3::from(cell.map(|at| (at << CELL_EDGE_LOG2) as f32));
        Some(Self { distance, occupied: bounds.map(to_voxels) })
    }
}

/// Sets the distances of all cells by widening the set of near ones cell by cell.
fn spread(rows: &mut Vec<u64>, distance: &mut [u8], edge: usize) {
    let whole_row = if edge == 64 { u64::MAX } else { (1 << edge) - 1 };
    for step in 1..FARTHEST {
        if rows.iter().all(|&row| row == whole_row) {
            return;
        }
        let wider = widened(rows, edge, whole_row);
        for (row, (&wide, &near)) in wider.iter().zip(rows.iter()).enumerate() {
            let mut reached = wide & !near;
            while reached != 0 {
                distance[row * edge + reached.trailing_zeros() as usize] = step;
                reached &= reached - 1;
            }
        }
        *rows = wider;
    }
}

/// A set of cells with all their neighbours.
fn widened(rows: &[u64], edge: usize, whole_row: u64) -> Vec<u64> {
    let along_x: Vec<u64> = rows.iter().map(|&row| (row | row << 1 | row >> 1) & whole_row).collect();
    let along = |rows: &[u64], stride: usize, count: usize| -> Vec<u64> {
        (0..rows.len())
            .map(|row| {
                let place = row / stride % count;
                let before = if place > 0 { rows[row - stride] } else { 0 };
                let after = if place + 1 < count { rows[row + stride] } else { 0 };
                rows[row] | before | after
            })
            .collect()
    };
    along(&along(&along_x, 1, edge), edge, edge)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_to_the_nearest_occupied_cell() {
        let edge = 7usize;
        let occupied = [[1, 2, 0], [6, 6, 5]];
        let at = |index: usize| [index % edge, index / edge % edge, index / (edge * edge)];
        let max: Vec<f32> =
            (0..edge.pow(3)).map(|index| f32::from(u8::from(occupied.contains(&at(index))))).collect();
        let cells = BrickCells { edge, min: vec![0.0; max.len()], max };
        let occupancy = Occupancy::new(&cells, |_, max| max > 0.5).expect("two cells are occupied");
        for index in 0..edge.pow(3) {
            let apart = |other: &[usize; 3]| (0..3).map(|axis| at(index)[axis].abs_diff(other[axis])).max();
            let nearest = occupied.iter().filter_map(apart).min().expect("there are two");
            assert_eq!(usize::from(occupancy.distance[index]), nearest, "{:?}", at(index));
        }
        assert_eq!(occupancy.occupied, [Vec3::new(8.0, 16.0, 0.0), Vec3::new(56.0, 56.0, 48.0)]);
        assert!(Occupancy::new(&cells, |_, max| max > 2.0).is_none());
    }
}
