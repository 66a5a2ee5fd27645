use glam::{IVec3, Vec3};

/// A voxel as kernels read it.
pub trait Voxel: Copy + Send + Sync {
    fn to_f32(self) -> f32;
}

macro_rules! voxel {
    ($($voxel:ty)*) => {$(
        impl Voxel for $voxel {
            #[inline(always)]
            fn to_f32(self) -> f32 {
                f32::from(self)
            }
        }
    )*};
}

voxel!(u8 i8 u16 i16 f32);

/// Reads stored values between the voxels of a brick.
pub struct Sampler<'a, V> {
    pub voxels: &'a [V],
    /// Voxels along each axis.
    pub edge: usize,
    /// The volume's voxel that is the brick's first.
    pub halo_start: IVec3,
}

/// The cell of eight voxels that a sample lies in.
#[derive(Clone, Copy)]
pub struct Cell {
    /// Its first voxel in the brick.
    index: usize,
    fraction: Vec3,
}

impl<V: Voxel> Sampler<'_, V> {
    /// The cell of a sample that the brick owns.
    #[inline(always)]
    pub fn cell(&self, sample_voxel: Vec3) -> Cell {
        let floor = [sample_voxel.x, sample_voxel.y, sample_voxel.z].map(floor_to_i32);
        let [x, y, z] = [0, 1, 2].map(|axis| (floor[axis] - self.halo_start[axis]) as usize);
        let fraction = sample_voxel - Vec3::from(floor.map(|cell| cell as f32));
        Cell { index: (z * self.edge + y) * self.edge + x, fraction }
    }

    /// The stored value at a sample, by trilinear interpolation.
    #[inline(always)]
    pub fn value(&self, cell: Cell) -> f32 {
        self.trilinear(cell.index, cell.fraction)
    }

    /// Change of the stored value per voxel along each axis: central differences of one voxel.
    #[inline(always)]
    pub fn gradient(&self, Cell { index, fraction }: Cell) -> Vec3 {
        let along = |stride: usize| {
            0.5 * (self.trilinear(index + stride, fraction) - self.trilinear(index - stride, fraction))
        };
        Vec3::new(along(1), along(self.edge), along(self.edge * self.edge))
    }

    #[inline(always)]
    fn trilinear(&self, index: usize, fraction: Vec3) -> f32 {
        let row = |start: usize| {
            let pair = &self.voxels[start..start + 2];
            let (a, b) = (pair[0].to_f32(), pair[1].to_f32());
            a + fraction.x * (b - a)
        };
        let slab = |start: usize| {
            let (a, b) = (row(start), row(start + self.edge));
            a + fraction.y * (b - a)
        };
        let (a, b) = (slab(index), slab(index + self.edge * self.edge));
        a + fraction.z * (b - a)
    }
}

/// ⌊x⌋ of coordinates, which are small.
#[inline(always)]
fn floor_to_i32(x: f32) -> i32 {
    let toward_zero = x as i32;
    toward_zero - i32::from(toward_zero as f32 > x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> Vec<u16> {
        (0..512).map(|i| ((i % 8) * 3 + (i / 8 % 8) * 50 + i / 64 * 700) as u16).collect()
    }

    #[test]
    fn a_linear_ramp_is_met_exactly() {
        let voxels = ramp();
        let sampler = Sampler { voxels: &voxels, edge: 8, halo_start: IVec3::splat(-2) };
        let cell = sampler.cell(Vec3::new(-0.25, 1.5, 2.125));
        assert_eq!(sampler.value(cell), 1.75 * 3.0 + 3.5 * 50.0 + 4.125 * 700.0);
        assert_eq!(sampler.gradient(cell), Vec3::new(3.0, 50.0, 700.0));
    }

    #[test]
    fn floor_goes_down_below_zero() {
        assert_eq!([-0.25, -1.0, 0.0, 0.75, 7.999_999].map(floor_to_i32), [-1, -1, 0, 0, 7]);
    }
}
