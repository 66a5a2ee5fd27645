use crate::{Brick, Voxels};

/// Voxels along a cell's side, as a power of two.
pub const CELL_EDGE_LOG2: u32 = 3;

/// The range of stored values in each cell of 8³ voxels of a brick, halo included: what trilinear samples between the
/// cell's voxels and the next ones can reach.
#[derive(Clone, Debug, PartialEq)]
pub struct BrickCells {
    /// Cells along each axis.
    pub edge: usize,
    /// x fastest.
    pub min: Vec<f32>,
    pub max: Vec<f32>,
}

impl BrickCells {
    /// Finds the ranges of a brick's cells.
    pub fn of(brick: &Brick) -> Self {
        let edge = brick.edge as usize;
        match &brick.voxels {
            Voxels::U8(voxels) => cells(voxels, edge, u8::MAX, u8::MIN),
            Voxels::I8(voxels) => cells(voxels, edge, i8::MAX, i8::MIN),
            Voxels::U16(voxels) => cells(voxels, edge, u16::MAX, u16::MIN),
            Voxels::I16(voxels) => cells(voxels, edge, i16::MAX, i16::MIN),
            Voxels::F32(voxels) => cells(voxels, edge, f32::INFINITY, f32::NEG_INFINITY),
        }
    }

    /// Cells along each axis of a brick of that edge.
    pub const fn edge(brick_edge: u32) -> usize {
        brick_edge.div_ceil(1 << CELL_EDGE_LOG2) as usize
    }

    /// Size in memory of the cells of a brick of that edge.
    pub const fn bytes(brick_edge: u32) -> usize {
        let edge = Self::edge(brick_edge);
        edge * edge * edge * 2 * size_of::<f32>()
    }
}

fn cells<V: Copy + PartialOrd + Into<f32>>(voxels: &[V], edge: usize, above: V, below: V) -> BrickCells {
    let cell = 1 << CELL_EDGE_LOG2;
    let cells = edge.div_ceil(cell);
    // First along y, then along z, both whole rows at a time, and last along x.
    let mut slabs = vec![(above, below); edge * cells * edge];
    for (slab, rows) in slabs.chunks_exact_mut(cells * edge).zip(voxels.chunks_exact(edge * edge)) {
        for (cell_y, widened) in slab.chunks_exact_mut(edge).enumerate() {
            for row in rows.chunks_exact(edge).skip(cell_y * cell).take(cell + 1) {
                for (range, &voxel) in widened.iter_mut().zip(row) {
                    range.0 = if voxel < range.0 { voxel } else { range.0 };
                    range.1 = if voxel > range.1 { voxel } else { range.1 };
                }
            }
        }
    }
    let mut found = BrickCells { edge: cells, min: Vec::new(), max: Vec::new() };
    let mut plane = vec![(above, below); cells * edge];
    for cell_z in 0..cells {
        plane.fill((above, below));
        for slab in slabs.chunks_exact(cells * edge).skip(cell_z * cell).take(cell + 1) {
            for (range, &(min, max)) in plane.iter_mut().zip(slab) {
                range.0 = if min < range.0 { min } else { range.0 };
                range.1 = if max > range.1 { max } else { range.1 };
            }
        }
        for row in plane.chunks_exact(edge) {
            for cell_x in 0..cells {
                let (mut min, mut max) = (above, below);
                for &(voxel_min, voxel_max) in row.iter().skip(cell_x * cell).take(cell + 1) {
                    min = if voxel_min < min { voxel_min } else { min };
                    max = if voxel_max > max { voxel_max } else { max };
                }
                found.min.push(min.into());
                found.max.push(max.into());
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_hold_their_voxels_and_the_next_ones() {
        let edge = 20usize;
        let at = |x: usize, y: usize, z: usize| ((x * 31 + y * 17 + z * 101) % 251) as u8;
        let mut voxels: Vec<u8> = (0..edge)
            .flat_map(|z| (0..edge).flat_map(move |y| (0..edge).map(move |x| at(x, y, z))))
            .collect();
        voxels.extend([255; Brick::PADDING]);
        let cells = BrickCells::of(&Brick::new(edge as u32, Voxels::U8(voxels)));
        assert_eq!(cells.edge, 3);
        for (index, (&min, &max)) in cells.min.iter().zip(&cells.max).enumerate() {
            let start = [index % 3 * 8, index / 3 % 3 * 8, index / 9 * 8];
            let [xs, ys, zs] = start.map(|first| first..(first + 9).min(edge));
            let inside = zs.flat_map(|z| {
                let xs = xs.clone();
                ys.clone().flat_map(move |y| xs.clone().map(move |x| at(x, y, z)))
            });
            let by_hand: Vec<u8> = inside.collect();
            assert_eq!(min, f32::from(*by_hand.iter().min().unwrap()));
            assert_eq!(max, f32::from(*by_hand.iter().max().unwrap()));
        }
    }
}
