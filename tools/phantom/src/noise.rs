//! Random numbers that depend on a seed and a place alone, so that any slab of any volume can be made by itself.

use crate::solid::Row;

/// A well-mixed 64-bit number from another (the finalizer of SplitMix64).
pub fn mix(value: u64) -> u64 {
    let value = (value ^ (value >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let value = (value ^ (value >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    value ^ (value >> 31)
}

/// A sequence of random numbers, for growing the anatomy.
#[derive(Clone, Debug)]
pub struct Sequence(u64);

impl Sequence {
    /// `stream` tells apart sequences of one seed.
    pub fn new(seed: u64, stream: u64) -> Self {
        Self(mix(seed ^ mix(stream.wrapping_add(0x9e37_79b9_7f4a_7c15))))
    }

    /// The next number, from `low` to `high`.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        low + (high - low) * (mix(self.0) >> 40) as f32 / (1u64 << 24) as f32
    }
}

/// The scanner's noise of one row of voxels.
#[derive(Clone, Copy, Debug)]
pub struct RowNoise {
    keys: [u32; 2],
}

impl RowNoise {
    /// Row `y` of slice `z`.
    pub fn new(seed: u64, y: u32, z: u32) -> Self {
        let key = mix(mix(seed) ^ (u64::from(z) << 32 | u64::from(y)));
        Self { keys: [key as u32, (key >> 32) as u32] }
    }

    /// A nearly normal number of variance 1, at most 4 in size: four uniform ones added.
    #[inline(always)]
    pub fn at(self, x: u32) -> f32 {
        const DEVIATION_OF_SUM: f32 = 147.8;
        let hash = (x ^ self.keys[0]).wrapping_mul(0x9e37_79b1);
        let hash = (hash ^ (hash >> 15)).wrapping_add(self.keys[1]).wrapping_mul(0x85eb_ca77);
        let hash = (hash ^ (hash >> 13)).wrapping_mul(0xc2b2_ae3d);
        let hash = hash ^ (hash >> 16);
        let pairs = (hash & 0x00ff_00ff) + ((hash >> 8) & 0x00ff_00ff);
        let sum = (pairs & 0xffff) + (pairs >> 16);
        (sum as i32 - 510) as f32 * (1.0 / DEVIATION_OF_SUM)
    }
}

/// A smooth random field, from −1 to 1: the grain of a tissue.
#[derive(Clone, Copy, Debug)]
pub struct Grain {
    pub seed: u64,
    /// Distance of the random values between which it is interpolated.
    pub cell_mm: f32,
}

impl Grain {
    /// Multiplies the field by `amplitude` and adds it to a row.
    pub fn add(self, row: &Row, amplitude: f32, out: &mut [f32]) {
        let inverse = 1.0 / self.cell_mm;
        let [x, y, z] = row.first_mm.map(|mm| mm * inverse);
        let (y0, z0) = (y.floor(), z.floor());
        let (ty, tz) = (ease(y - y0), ease(z - z0));
        let column = |cell: i32| {
            let value = |dy: i32, dz: i32| self.corner([cell, y0 as i32 + dy, z0 as i32 + dz]);
            let low = value(0, 0) + (value(1, 0) - value(0, 0)) * ty;
            let high = value(0, 1) + (value(1, 1) - value(0, 1)) * ty;
            (low + (high - low) * tz) * amplitude
        };
        let step = row.step_mm * inverse;
        let mut start = 0;
        let (mut cell, mut next) = (i32::MIN, 0.0);
        while start < out.len() {
            let at = (x + start as f32 * step).floor() as i32;
            let here = if at == cell.wrapping_add(1) && start > 0 { next } else { column(at) };
            (cell, next) = (at, column(at + 1));
            // The voxels up to the next random value.
            let end = ((((at + 1) as f32 - x) / step).ceil() as usize).clamp(start + 1, out.len());
            for (i, value) in out[start..end].iter_mut().enumerate() {
                let t = x + (start as i32 + i as i32) as f32 * step - at as f32;
                *value += here + (next - here) * ease(t);
            }
            start = end;
        }
    }

    fn corner(self, [x, y, z]: [i32; 3]) -> f32 {
        let place = (x as u32).wrapping_mul(0x8da6_b343)
            ^ (y as u32).wrapping_mul(0xd816_3841)
            ^ (z as u32).wrapping_mul(0xcb1a_b31f);
        let hash = (place ^ self.seed as u32).wrapping_mul(0x85eb_ca77);
        let hash = (hash ^ (hash >> 15)).wrapping_mul(0xc2b2_ae3d);
        (hash >> 8) as f32 * (2.0 / (1u32 << 24) as f32) - 1.0
    }
}

fn ease(t: f32) -> f32 {
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn row_noise_has_mean_zero_and_variance_one() {
        let (mut sum, mut squares, mut neighbours, mut count) = (0.0, 0.0, 0.0, 0.0);
        for y in 0..200 {
            let noise = RowNoise::new(7, y, 3);
            for x in 0..500 {
                let value = f64::from(noise.at(x));
                assert!(value.abs() < 4.0);
                sum += value;
                squares += value * value;
                neighbours += value * f64::from(noise.at(x + 1));
                count += 1.0;
            }
        }
        assert!((sum / count).abs() < 0.01, "mean {}", sum / count);
        assert!((squares / count - 1.0).abs() < 0.02, "variance {}", squares / count);
        assert!((neighbours / count).abs() < 0.01, "correlation {}", neighbours / count);
    }

    #[test]
    fn grain_is_the_same_wherever_a_row_begins() {
        let grain = Grain { seed: 1, cell_mm: 5.0 };
        let mut whole = [0.0; 64];
        grain.add(&Row { first_mm: [-8.0, 3.0, 9.0], step_mm: 0.5 }, 10.0, &mut whole);
        let mut part = [0.0; 32];
        grain.add(&Row { first_mm: [8.0, 3.0, 9.0], step_mm: 0.5 }, 10.0, &mut part);
        assert!(whole[32..].iter().zip(&part).all(|(a, b)| (a - b).abs() < 1e-4));
        assert!(whole.iter().all(|value| value.abs() <= 10.0));
        assert!(whole.iter().any(|value| value.abs() > 1.0));
    }
}
