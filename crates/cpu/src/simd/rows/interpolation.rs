//! Values and gradients between voxels that were read along rows: in the same steps as where voxels are gathered, along the
//! volume's x first, then y and z, whichever of them the rows lie along.

use glassbrick_volume::RowAxis;

use super::super::avx512::Avx512;
use super::super::brick::lerp;
use super::super::lanes::Lanes;

type F = <Avx512 as Lanes>::F;

/// The value at each sample, of the eight voxels around it and its fractions, both along the turned axes.
#[inline(always)]
pub fn value(corners: &[[[F; 2]; 2]; 2], fraction: [F; 3], row_axis: RowAxis) -> F {
    match row_axis {
        RowAxis::X => Between::<2, { RowAxis::X as usize }> { voxels: corners, fraction }.value(),
        RowAxis::Y => Between::<2, { RowAxis::Y as usize }> { voxels: corners, fraction }.value(),
        RowAxis::Z => Between::<2, { RowAxis::Z as usize }> { voxels: corners, fraction }.value(),
    }
}

/// Twice the change of the value per voxel along each of the volume's axes, of the voxels around samples with the next ones on
/// each side.
#[inline(always)]
pub fn gradient(surroundings: &[[[F; 4]; 4]; 4], fraction: [F; 3], row_axis: RowAxis) -> [F; 3] {
    match row_axis {
        RowAxis::X => Between::<4, { RowAxis::X as usize }> { voxels: surroundings, fraction }.gradient(),
        RowAxis::Y => Between::<4, { RowAxis::Y as usize }> { voxels: surroundings, fraction }.gradient(),
        RowAxis::Z => Between::<4, { RowAxis::Z as usize }> { voxels: surroundings, fraction }.gradient(),
    }
}

/// Samples between voxels that lie turned by `AXIS`, a [`RowAxis`].
struct Between<'a, const SIDE: usize, const AXIS: usize> {
    /// By their places along z, y, and the row.
    voxels: &'a [[[F; SIDE]; SIDE]; SIDE],
    fraction: [F; 3],
}

impl<const SIDE: usize, const AXIS: usize> Between<'_, SIDE, AXIS> {
    const ROW_AXIS: RowAxis = RowAxis::ALL[AXIS];

    /// By places along the volume's axes.
    #[inline(always)]
    fn voxel(&self, place: [usize; 3]) -> F {
        let [along, y, z] = Self::ROW_AXIS.swapped(place);
        self.voxels[z][y][along]
    }

    /// The value in a row along the volume's x, before which there are so many others along it.
    #[inline(always)]
    fn along_x(&self, x: usize, y: usize, z: usize) -> F {
        let [fx, ..] = Self::ROW_AXIS.swapped(self.fraction);
        lerp::<Avx512>(self.voxel([x, y, z]), self.voxel([x + 1, y, z]), fx)
    }
}

impl<const AXIS: usize> Between<'_, 2, AXIS> {
    #[inline(always)]
    fn value(&self) -> F {
        let [_, fy, fz] = Self::ROW_AXIS.swapped(self.fraction);
        let lower = lerp::<Avx512>(self.along_x(0, 0, 0), self.along_x(0, 1, 0), fy);
        let upper = lerp::<Avx512>(self.along_x(0, 0, 1), self.along_x(0, 1, 1), fy);
        lerp::<Avx512>(lower, upper, fz)
    }
}

impl<const AXIS: usize> Between<'_, 4, AXIS> {
    #[inline(always)]
    fn gradient(&self) -> [F; 3] {
        let [_, fy, fz] = Self::ROW_AXIS.swapped(self.fraction);
        // The samples' cell is the one in the middle: from 1 to 2 along each axis.
        let x0 = lerp::<Avx512>(self.change_along_x(1, 1), self.change_along_x(2, 1), fy);
        let x1 = lerp::<Avx512>(self.change_along_x(1, 2), self.change_along_x(2, 2), fy);
        let (r00, r10) = (self.along_x(1, 1, 1), self.along_x(1, 2, 1));
        let (r01, r11) = (self.along_x(1, 1, 2), self.along_x(1, 2, 2));
        let y0 = Avx512::sub(r10, self.along_x(1, 0, 1));
        let y0 = lerp::<Avx512>(y0, Avx512::sub(self.along_x(1, 3, 1), r00), fy);
        let y1 = Avx512::sub(r11, self.along_x(1, 0, 2));
        let y1 = lerp::<Avx512>(y1, Avx512::sub(self.along_x(1, 3, 2), r01), fy);
        let z0 = Avx512::sub(r01, self.along_x(1, 1, 0));
        let z0 = lerp::<Avx512>(z0, Avx512::sub(self.along_x(1, 1, 3), r00), fz);
        let z1 = Avx512::sub(r11, self.along_x(1, 2, 0));
        let z1 = lerp::<Avx512>(z1, Avx512::sub(self.along_x(1, 2, 3), r10), fz);
        [lerp::<Avx512>(x0, x1, fz), lerp::<Avx512>(y0, y1, fz), lerp::<Avx512>(z0, z1, fy)]
    }

    /// Twice the change along the volume's x.
    #[inline(always)]
    fn change_along_x(&self, y: usize, z: usize) -> F {
        let [fx, ..] = Self::ROW_AXIS.swapped(self.fraction);
        let [before, at] = [self.voxel([0, y, z]), self.voxel([1, y, z])];
        let [next, beyond] = [self.voxel([2, y, z]), self.voxel([3, y, z])];
        lerp::<Avx512>(Avx512::sub(next, before), Avx512::sub(beyond, at), fx)
    }
}
