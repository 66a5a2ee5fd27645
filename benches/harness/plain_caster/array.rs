use glam::{UVec3, Vec3};
use glassbrick::{BrickSource, Rescale, Volume, VolumeDesc, available_memory_bytes};
use glassbrick_volume::{Brick, BrickId, Voxels};
use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::BenchError;

/// A whole volume in memory, as one array.
pub struct PlainVolume {
    pub desc: VolumeDesc,
    pub voxels: Voxels,
    pub threads: ThreadPool,
}

/// A type that voxels are kept in.
pub trait PlainVoxel: Copy + Default + Into<f32> + Send + Sync {}

impl<V: Copy + Default + Into<f32> + Send + Sync> PlainVoxel for V {}

impl PlainVolume {
    /// Reads every voxel of a volume.
    ///
    /// # Errors
    /// When they do not fit into the memory that is free, or cannot be read.
    pub fn read(volume: &Volume) -> Result<Self, BenchError> {
        let desc = volume.desc().clone();
        let needed_bytes = desc.bytes();
        if let Some(available_bytes) = available_memory_bytes()
            && needed_bytes > available_bytes
        {
            return Err(BenchError::NoRoomForTheWhole { needed_bytes, available_bytes });
        }
        let threads = ThreadPoolBuilder::new().num_threads(volume.threads()).build()?;
        let source = volume.bricks();
        let first = source.brick(BrickId::new(0, UVec3::ZERO))?;
        let voxels = threads.install(|| match &first.voxels {
            Voxels::U8(_) => gather(source, u8_voxels).map(Voxels::U8),
            Voxels::I8(_) => gather(source, i8_voxels).map(Voxels::I8),
            Voxels::U16(_) => gather(source, u16_voxels).map(Voxels::U16),
            Voxels::I16(_) => gather(source, i16_voxels).map(Voxels::I16),
            Voxels::F32(_) => gather(source, f32_voxels).map(Voxels::F32),
        })?;
        Ok(Self { desc, voxels, threads })
    }
}

/// The voxels of a brick, all of which are of one type.
macro_rules! voxels_of {
    ($name:ident, $kind:ident, $voxel:ty) => {
        fn $name(brick: &Brick) -> &[$voxel] {
            match &brick.voxels {
                Voxels::$kind(voxels) => voxels,
                _ => &[],
            }
        }
    };
}

voxels_of!(u8_voxels, U8, u8);
voxels_of!(i8_voxels, I8, i8);
voxels_of!(u16_voxels, U16, u16);
voxels_of!(i16_voxels, I16, i16);
voxels_of!(f32_voxels, F32, f32);

/// The cores of all bricks, put together.
fn gather<V: PlainVoxel>(
    source: &dyn BrickSource,
    voxels_of: fn(&Brick) -> &[V],
) -> Result<Vec<V>, BenchError> {
    let grid = source.grid(0);
    let [nx, ny, _] = grid.extent.as_usizevec3().to_array();
    let core = grid.layout.core() as usize;
    let mut whole = vec![V::default(); grid.extent.as_usizevec3().element_product()];
    let slabs = whole.par_chunks_mut(nx * ny * core).enumerate();
    slabs.try_for_each(|(brick_z, slab)| {
        for (brick_y, brick_x) in (0..grid.counts.y).flat_map(|y| (0..grid.counts.x).map(move |x| (y, x))) {
            let place = UVec3::new(brick_x, brick_y, brick_z as u32);
            let brick = source.brick(BrickId::new(0, place))?;
            let voxels = voxels_of(&brick);
            let edge = brick.edge as usize;
            let start = grid.core_start(place).as_usizevec3();
            let size = grid.core_end(place).as_usizevec3() - start;
            let halo = grid.layout.halo as usize;
            for (z, y) in (0..size.z).flat_map(|z| (0..size.y).map(move |y| (z, y))) {
                let from = ((z + halo) * edge + y + halo) * edge + halo;
                let to = (z * ny + start.y + y) * nx + start.x;
                slab[to..to + size.x].copy_from_slice(&voxels[from..from + size.x]);
            }
        }
        Ok::<(), BenchError>(())
    })?;
    Ok(whole)
}

/// Voxels of one type, x fastest.
pub struct VoxelArray<'a, V> {
    pub voxels: &'a [V],
    pub extent: UVec3,
    pub rescale: Rescale,
}

impl<V: PlainVoxel> VoxelArray<'_, V> {
    /// The value at a place in voxel coordinates, interpolated linearly along each axis.
    pub fn value(&self, at: Vec3) -> f32 {
        let below = at.floor();
        let fraction = at - below;
        let last = self.extent.as_ivec3() - 1;
        let low = below.as_ivec3().clamp(glam::IVec3::ZERO, last).as_usizevec3();
        let high = (below.as_ivec3() + 1).clamp(glam::IVec3::ZERO, last).as_usizevec3();
        let (nx, ny) = (self.extent.x as usize, self.extent.y as usize);
        let row = |y: usize, z: usize| {
            let start = (z * ny + y) * nx;
            let (a, b): (f32, f32) = (self.voxels[start + low.x].into(), self.voxels[start + high.x].into());
            a + fraction.x * (b - a)
        };
        let plane = |z: usize| {
            let (a, b) = (row(low.y, z), row(high.y, z));
            a + fraction.y * (b - a)
        };
        let (a, b) = (plane(low.z), plane(high.z));
        let stored = a + fraction.z * (b - a);
        self.rescale.value(f64::from(stored)) as f32
    }

    /// Central differences over one voxel on each side, in values a voxel.
    pub fn gradient(&self, at: Vec3) -> Vec3 {
        let along = |axis: Vec3| (self.value(at + axis) - self.value(at - axis)) / 2.0;
        Vec3::new(along(Vec3::X), along(Vec3::Y), along(Vec3::Z))
    }
}
