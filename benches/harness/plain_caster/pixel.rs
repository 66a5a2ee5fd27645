use glam::{Mat3, Vec3};
use glassbrick::Phong;
use glassbrick_volume::{BAKED_ENTRIES, BakedTransferFunction, Ray};

use super::array::{PlainVoxel, VoxelArray};

/// What a ray makes of its samples, front to back.
pub trait Pixel {
    fn add<V: PlainVoxel>(&mut self, array: &VoxelArray<V>, at: Vec3, ray: &Ray, number: u32);

    /// Whether no further sample counts.
    fn is_done(&self) -> bool;

    /// Premultiplied colour and opacity, and the sample that gives the depth.
    fn finish(&self) -> ([f32; 4], Option<u32>);
}

/// Emission and absorption, perhaps lit from the eye.
pub struct Dvr<'a> {
    transfer_function: &'a BakedTransferFunction,
    cutoff: f32,
    light: Option<Phong>,
    /// Takes gradients to world space, up to a factor.
    normal_from_gradient: Mat3,
    color: Vec3,
    opacity: f32,
    half_opaque_at: Option<u32>,
}

impl<'a> Dvr<'a> {
    pub fn new(
        transfer_function: &'a BakedTransferFunction,
        cutoff: f32,
        light: Option<Phong>,
        normal_from_gradient: Mat3,
    ) -> Self {
        let (color, opacity) = (Vec3::ZERO, 0.0);
        Self { transfer_function, cutoff, light, normal_from_gradient, color, opacity, half_opaque_at: None }
    }

    fn lit(&self, color: Vec3, light: &Phong, gradient: Vec3, ray: &Ray) -> Vec3 {
        let normal = self.normal_from_gradient * gradient;
        if normal == Vec3::ZERO {
            return color;
        }
        // The gradient along the ray is the same in every space.
        let along = gradient.dot(ray.step).abs() / (normal.length() * ray.step_length_mm);
        let n_dot_l = along.min(1.0);
        color * (light.ambient + light.diffuse * n_dot_l) + light.specular * n_dot_l.powf(light.shininess)
    }
}

impl Pixel for Dvr<'_> {
    fn add<V: PlainVoxel>(&mut self, array: &VoxelArray<V>, at: Vec3, ray: &Ray, number: u32) {
        let (entry, fraction) = entry(self.transfer_function, array.value(at));
        let mix = |a: f32, b: f32| a + fraction * (b - a);
        let extinction =
            mix(self.transfer_function.extinction[entry], self.transfer_function.extinction[entry + 1]);
        if extinction <= 0.0 {
            return;
        }
        let [low, high] = [entry, entry + 1].map(|entry| Vec3::from(self.transfer_function.color[entry]));
        let color = low + fraction * (high - low);
        let color = match &self.light {
            Some(light) => self.lit(color, light, array.gradient(at), ray),
            None => color,
        };
        let weight = (1.0 - self.opacity) * -(-extinction * ray.step_length_mm).exp_m1();
        self.color += weight * color;
        self.opacity += weight;
        if self.opacity >= 0.5 {
            self.half_opaque_at.get_or_insert(number);
        }
    }

    fn is_done(&self) -> bool {
        self.opacity >= self.cutoff
    }

    fn finish(&self) -> ([f32; 4], Option<u32>) {
        (self.color.extend(self.opacity).to_array(), self.half_opaque_at)
    }
}

/// The largest or smallest value.
pub struct Extremum<'a> {
    transfer_function: &'a BakedTransferFunction,
    /// 1 for the largest, −1 for the smallest.
    sign: f32,
    found: Option<(f32, u32)>,
}

impl<'a> Extremum<'a> {
    pub fn new(transfer_function: &'a BakedTransferFunction, sign: f32) -> Self {
        Self { transfer_function, sign, found: None }
    }
}

impl Pixel for Extremum<'_> {
    fn add<V: PlainVoxel>(&mut self, array: &VoxelArray<V>, at: Vec3, _ray: &Ray, number: u32) {
        let value = array.value(at);
        if self.found.is_none_or(|(best, _)| self.sign * value > self.sign * best) {
            self.found = Some((value, number));
        }
    }

    fn is_done(&self) -> bool {
        false
    }

    fn finish(&self) -> ([f32; 4], Option<u32>) {
        match self.found {
            Some((value, number)) => (self.transfer_function.projected(f64::from(value)), Some(number)),
            None => ([0.0; 4], None),
        }
    }
}

/// The arithmetic mean of the values.
pub struct Mean<'a> {
    transfer_function: &'a BakedTransferFunction,
    sum: f64,
    samples: u32,
}

impl<'a> Mean<'a> {
    pub fn new(transfer_function: &'a BakedTransferFunction) -> Self {
        Self { transfer_function, sum: 0.0, samples: 0 }
    }
}

impl Pixel for Mean<'_> {
    fn add<V: PlainVoxel>(&mut self, array: &VoxelArray<V>, at: Vec3, _ray: &Ray, _number: u32) {
        self.sum += f64::from(array.value(at));
        self.samples += 1;
    }

    fn is_done(&self) -> bool {
        false
    }

    fn finish(&self) -> ([f32; 4], Option<u32>) {
        let rgba = match self.samples {
            0 => [0.0; 4],
            samples => self.transfer_function.projected(self.sum / f64::from(samples)),
        };
        (rgba, None)
    }
}

/// The entry of a baked table below a value, and how far the value is on its way to the next.
fn entry(transfer_function: &BakedTransferFunction, value: f32) -> (usize, f32) {
    let last = (BAKED_ENTRIES - 1) as f64;
    let at = (f64::from(value) - transfer_function.first_value) * transfer_function.entries_per_value();
    let at = at.clamp(0.0, last);
    let entry = (at as usize).min(BAKED_ENTRIES - 2);
    (entry, (at - entry as f64) as f32)
}
