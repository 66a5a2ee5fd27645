/// The axis along which a brick's voxels lie one behind the other in memory. It has changed places with x: such a brick is
/// one of a volume that lies turned, with its cells and its place turned too.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum RowAxis {
    #[default]
    X,
    Y,
    Z,
}

impl RowAxis {
    /// Every axis, the usual one first.
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// One thing for each axis, with those of x and of this axis in each other's place: from the volume's axes to those of
    /// the turned one, and back.
    #[inline(always)]
    pub fn swapped<T: Copy>(self, [x, y, z]: [T; 3]) -> [T; 3] {
        match self {
            Self::X => [x, y, z],
            Self::Y => [y, x, z],
            Self::Z => [z, y, x],
        }
    }

    /// Turns edge³ voxels whose rows lie along x, or turns them back.
    pub(crate) fn turn<V: Copy>(self, voxels: &mut [V], edge: usize) {
        let slab = edge * edge;
        let voxels = &mut voxels[..edge * slab];
        match self {
            Self::X => {}
            Self::Y => voxels.chunks_exact_mut(slab).for_each(|plane| transpose(plane, edge)),
            Self::Z => {
                // Rows that lie a slab apart share few places of the caches, so those of a plane are brought together: a
                // third of the time.
                let mut plane = Vec::with_capacity(slab);
                for y in 0..edge {
                    plane.clear();
                    for rows in voxels.chunks_exact(slab) {
                        plane.extend_from_slice(&rows[y * edge..][..edge]);
                    }
                    transpose(&mut plane, edge);
                    for (rows, row) in voxels.chunks_exact_mut(slab).zip(plane.chunks_exact(edge)) {
                        rows[y * edge..][..edge].copy_from_slice(row);
                    }
                }
            }
        }
    }
}

/// So many rows and columns of a matrix are transposed at a time, for the caches' sake.
const BLOCK: usize = 8;

/// Transposes a square matrix.
fn transpose<V: Copy>(matrix: &mut [V], edge: usize) {
    for first_row in (0..edge).step_by(BLOCK) {
        for first_column in (0..=first_row).step_by(BLOCK) {
            for row in first_row..(first_row + BLOCK).min(edge) {
                for column in first_column..(first_column + BLOCK).min(row) {
                    matrix.swap(row * edge + column, column * edge + row);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turned_cube_has_its_axes_swapped() {
        for edge in [1, 7, 16, 21] {
            let at = |[x, y, z]: [usize; 3]| (z * edge + y) * edge + x;
            let voxels: Vec<usize> = (0..edge * edge * edge + 5).collect();
            for axis in RowAxis::ALL {
                let mut turned = voxels.clone();
                axis.turn(&mut turned, edge);
                for x in 0..edge {
                    for y in 0..edge {
                        for z in 0..edge {
                            let there = axis.swapped([x, y, z]);
                            assert_eq!(turned[at(there)], at([x, y, z]), "{axis:?}, {edge}");
                        }
                    }
                }
                assert_eq!(turned[edge.pow(3)..], voxels[edge.pow(3)..], "padding stays");
                axis.turn(&mut turned, edge);
                assert_eq!(turned, voxels, "{axis:?}, {edge}: there and back");
            }
        }
    }
}
