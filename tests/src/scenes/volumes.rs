use std::sync::Arc;

use glam::{DMat3, DVec3};

/// Voxels, what they mean, and where they lie in the world.
#[derive(Clone, Debug)]
pub struct Volume {
    /// Voxels along x, y and z.
    pub extent: [usize; 3],
    /// The stored type's name: `u8`, `i16`, `f32` and so on.
    pub stored_type: &'static str,
    /// Values that the stored type holds exactly, x fastest.
    pub voxels: Arc<[f64]>,
    pub slope: f64,
    pub intercept: f64,
    /// The smallest and largest value, after rescale, that voxels of this kind take.
    pub value_range: [f64; 2],
    pub geometry: Geometry,
}

/// Where a volume lies in the world, in millimetres.
#[derive(Clone, Copy, Debug)]
pub struct Geometry {
    pub spacing: [f64; 3],
    pub origin: [f64; 3],
    /// World directions of the voxel axes: three unit columns.
    pub direction: [[f64; 3]; 3],
}

/// How volumes of a stored type are filled: the range of stored values, and the rescale.
pub struct Stored {
    pub name: &'static str,
    range: [f64; 2],
    slope: f64,
    intercept: f64,
}

// Ranges are all that the type has, or what scanners and simulations make of it; u32, i32 and f64 hold values that
// must be rounded to become f32.
pub const U8: Stored = Stored { name: "u8", range: [0.0, 255.0], slope: 1.0, intercept: 0.0 };
pub const I8: Stored = Stored { name: "i8", range: [-128.0, 127.0], slope: -2.0, intercept: 10.0 };
pub const U16: Stored = Stored { name: "u16", range: [0.0, 65535.0], slope: 0.05, intercept: -1000.0 };
pub const I16: Stored = Stored { name: "i16", range: [-1024.0, 3071.0], slope: 1.0, intercept: 0.0 };
pub const U32: Stored = Stored { name: "u32", range: [0.0, 4_294_967_295.0], slope: 2.5e-7, intercept: 0.0 };
pub const I32: Stored = Stored { name: "i32", range: [-2e9, 2e9], slope: -1e-6, intercept: 500.0 };
pub const F32: Stored = Stored { name: "f32", range: [-0.25, 1.75], slope: 1.0, intercept: 0.0 };
pub const F64: Stored = Stored { name: "f64", range: [-1234.5, 6543.21], slope: -0.125, intercept: 20.0 };

impl Volume {
    /// Smooth noise with blobs that saturate, and a sharp-edged hollow: what scans of bodies look like.
    pub fn body(stored: &Stored, extent: [usize; 3], geometry: Geometry) -> Self {
        Self::filled(stored, extent, geometry, |voxel, middle| {
            let around = (voxel - middle) / (middle + 1.0);
            let hollow = (around - DVec3::new(0.3, 0.2, -0.1)) / DVec3::new(0.25, 0.4, 0.3);
            if hollow.length_squared() < 1.0 {
                return 0.0;
            }
            let blobs = BLOBS.map(|(centre, radius)| {
                (-(around - DVec3::from_array(centre)).length_squared() / (radius * radius)).exp()
            });
            0.9 * noise(voxel) - 0.15 + 0.8 * blobs.into_iter().sum::<f64>()
        })
    }

    /// Smooth noise alone, so that even the steepest transfer function changes over many samples.
    pub fn smooth(stored: &Stored, extent: [usize; 3], geometry: Geometry) -> Self {
        Self::filled(stored, extent, geometry, |voxel, _| noise(voxel))
    }

    /// Voxels from `field`, 0 to 1, of the voxel and the volume's middle.
    fn filled(
        stored: &Stored,
        extent: [usize; 3],
        geometry: Geometry,
        field: impl Fn(DVec3, DVec3) -> f64,
    ) -> Self {
        let [low, high] = stored.range;
        let middle = (DVec3::from_array(extent.map(|n| n as f64)) - 1.0) / 2.0;
        let voxel = |index: usize| {
            let (x, rest) = (index % extent[0], index / extent[0]);
            let voxel = DVec3::new(x as f64, (rest % extent[1]) as f64, (rest / extent[1]) as f64);
            let value = low + field(voxel, middle).clamp(0.0, 1.0) * (high - low);
            match stored.name {
                "f64" => value,
                "f32" => f64::from(value as f32),
                _ => value.round(),
            }
        };
        let ends = stored.range.map(|end| stored.slope * end + stored.intercept);
        Self {
            extent,
            stored_type: stored.name,
            voxels: (0..extent.iter().product()).map(voxel).collect(),
            slope: stored.slope,
            intercept: stored.intercept,
            value_range: [ends[0].min(ends[1]), ends[0].max(ends[1])],
            geometry,
        }
    }

    /// The same with some voxels NaN, +inf and -inf.
    pub fn with_voxels_not_finite(mut self) -> Self {
        let not_finite = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().cycle();
        let voxels = Arc::make_mut(&mut self.voxels);
        voxels.iter_mut().skip(77).step_by(1931).zip(not_finite).for_each(|(voxel, value)| *voxel = value);
        self
    }

    /// The voxels as the stored type lays them out, little endian.
    pub fn stored_bytes(&self) -> Vec<u8> {
        fn bytes<const N: usize>(voxels: &[f64], to_bytes: impl Fn(f64) -> [u8; N]) -> Vec<u8> {
            voxels.iter().flat_map(|&voxel| to_bytes(voxel)).collect()
        }
        match self.stored_type {
            "u8" => bytes(&self.voxels, |v| (v as u8).to_le_bytes()),
            "i8" => bytes(&self.voxels, |v| (v as i8).to_le_bytes()),
            "u16" => bytes(&self.voxels, |v| (v as u16).to_le_bytes()),
            "i16" => bytes(&self.voxels, |v| (v as i16).to_le_bytes()),
            "u32" => bytes(&self.voxels, |v| (v as u32).to_le_bytes()),
            "i32" => bytes(&self.voxels, |v| (v as i32).to_le_bytes()),
            "f32" => bytes(&self.voxels, |v| (v as f32).to_le_bytes()),
            "f64" => bytes(&self.voxels, f64::to_le_bytes),
            other => panic!("{other} is not a stored type"),
        }
    }

    /// The voxel position in the middle of the volume.
    pub fn centre_voxel(&self) -> [f64; 3] {
        self.extent.map(|n| (n as f64 - 1.0) / 2.0)
    }

    /// The length of the diagonal, in mm, were the axes orthogonal.
    pub fn diagonal_mm(&self) -> f64 {
        DVec3::from_array(std::array::from_fn(|axis| self.extent[axis] as f64 * self.geometry.spacing[axis]))
            .length()
    }
}

impl Geometry {
    /// Cubic voxels of 1 mm along the world's axes.
    pub const fn plain() -> Self {
        Self {
            spacing: [1.0; 3],
            origin: [-20.0, 7.0, 100.0],
            direction: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        }
    }

    pub const fn anisotropic() -> Self {
        Self { spacing: [0.7, 0.9, 2.5], ..Self::plain() }
    }

    /// Rotated about no axis in particular.
    pub fn oblique() -> Self {
        let axis = DVec3::new(0.3, -0.8, 0.5).normalize();
        let direction = DMat3::from_axis_angle(axis, 0.7).to_cols_array_2d();
        Self { spacing: [0.9, 0.8, 1.1], direction, ..Self::plain() }
    }

    /// Slices that are shifted against each other as under a tilted gantry: the z axis leans by 20°.
    pub fn gantry_tilt() -> Self {
        let tilt = 20.0_f64.to_radians();
        let direction = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, tilt.sin(), tilt.cos()]];
        Self { spacing: [0.8, 0.8, 1.5], direction, ..Self::plain() }
    }

    /// The x axis runs against the other two.
    pub const fn left_handed() -> Self {
        Self { direction: [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], ..Self::anisotropic() }
    }

    /// Sagittal slices: x of the voxels is the world's y, y its −z, z its x.
    pub const fn axes_permuted() -> Self {
        Self { direction: [[0.0, 1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]], ..Self::anisotropic() }
    }

    /// The world position of a voxel position.
    pub fn world_from_voxel(&self, voxel: [f64; 3]) -> [f64; 3] {
        let scaled = DVec3::from_array(voxel) * DVec3::from_array(self.spacing);
        (DVec3::from_array(self.origin) + DMat3::from_cols_array_2d(&self.direction) * scaled).to_array()
    }
}

/// Centres and radii, in half extents from the middle.
const BLOBS: [([f64; 3], f64); 4] =
    [([-0.4, -0.3, 0.2], 0.45), ([0.5, -0.5, -0.4], 0.3), ([0.0, 0.6, 0.5], 0.35), ([-0.7, 0.7, -0.8], 0.3)];

/// Two octaves of smooth noise, 0 to 1.
fn noise(voxel: DVec3) -> f64 {
    0.7 * octave(voxel / 17.0, 1) + 0.3 * octave(voxel / 9.0, 2)
}

/// Random values on a lattice, with smooth interpolation between them.
fn octave(position: DVec3, seed: u32) -> f64 {
    let cell = position.floor();
    let t = position - cell;
    let weight = t * t * (DVec3::splat(3.0) - 2.0 * t);
    let cell = cell.as_uvec3();
    let corner = |x, y, z| lattice([cell.x + x, cell.y + y, cell.z + z], seed);
    let row = |y, z| corner(0, y, z) * (1.0 - weight.x) + corner(1, y, z) * weight.x;
    let plane = |z| row(0, z) * (1.0 - weight.y) + row(1, z) * weight.y;
    plane(0) * (1.0 - weight.z) + plane(1) * weight.z
}

/// A random value, 0 to 1, that depends on the lattice point and the seed alone.
fn lattice(point: [u32; 3], seed: u32) -> f64 {
    let mut hash = seed.wrapping_mul(0x9e37_79b9);
    for coordinate in point {
        hash = (hash ^ coordinate).wrapping_mul(0x85eb_ca6b);
        hash = (hash ^ (hash >> 15)).wrapping_mul(0xc2b2_ae35);
        hash ^= hash >> 13;
    }
    f64::from(hash) / f64::from(u32::MAX)
}
