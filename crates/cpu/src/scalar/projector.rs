//! What rays make of their samples: one projector for each way to form a pixel.

use glam::{Mat3, Vec3};
use glassbrick_volume::{Phong, Ray};

use super::exponential::opacity;
use super::look_up::LookUp;
use super::sampler::{Cell, Sampler, Voxel};
use crate::kernel::NO_SAMPLE;

/// Forms pixels from samples that come front to back.
pub trait Projector: Sync {
    /// What a ray has gathered.
    type Pixel: Copy + Send + Sync;

    /// The pixel of a ray that has met no sample.
    fn start(&self) -> Self::Pixel;

    /// Whether no further sample is to be added.
    fn is_done(&self, pixel: &Self::Pixel) -> bool;

    /// Whether samples with stored values in [min, max] cannot change the pixel.
    fn is_unchanged_by(&self, pixel: &Self::Pixel, reach: [f32; 2]) -> bool;

    /// Adds the next sample.
    fn add<V: Voxel>(
        &self,
        pixel: &mut Self::Pixel,
        sampler: &Sampler<V>,
        cell: Cell,
        ray: &Ray,
        number: u32,
    );

    /// Premultiplied linear light, and the sample number that the pixel's depth is taken from.
    fn finish(&self, pixel: &Self::Pixel) -> ([f32; 4], u32);
}

/// Direct volume rendering: emission and absorption, with or without light.
pub struct Dvr<'a> {
    pub look_up: LookUp<'a>,
    pub opacity_cutoff: f32,
    pub light: Option<Headlight>,
}

/// Light from the eye on the surfaces of the volume.
pub struct Headlight {
    pub phong: Phong,
    /// Takes gradients per voxel to world space, up to a common factor.
    pub normal_from_gradient: Mat3,
}

impl Headlight {
    /// What light makes of a colour: a factor for it, and a term to add.
    fn shade(&self, gradient: Vec3, ray: &Ray) -> [f32; 2] {
        let normal = self.normal_from_gradient * gradient;
        let length = normal.length();
        if length == 0.0 {
            return [1.0, 0.0];
        }
        // n·l without leaving voxel space: the gradient along the ray is the same in every space.
        let n_dot_l = (gradient.dot(ray.step).abs() / (length * ray.step_length_mm)).min(1.0);
        let Phong { ambient, diffuse, specular, shininess } = self.phong;
        [ambient + diffuse * n_dot_l, specular * n_dot_l.powf(shininess)]
    }
}

#[derive(Clone, Copy)]
pub struct DvrPixel {
    color: [f32; 3],
    opacity: f32,
    depth: u32,
    is_done: bool,
}

impl Projector for Dvr<'_> {
    type Pixel = DvrPixel;

    fn start(&self) -> DvrPixel {
        DvrPixel { color: [0.0; 3], opacity: 0.0, depth: NO_SAMPLE, is_done: false }
    }

    fn is_done(&self, pixel: &DvrPixel) -> bool {
        pixel.is_done
    }

    fn is_unchanged_by(&self, pixel: &DvrPixel, _reach: [f32; 2]) -> bool {
        pixel.is_done
    }

    #[inline(always)]
    fn add<V: Voxel>(&self, pixel: &mut DvrPixel, sampler: &Sampler<V>, cell: Cell, ray: &Ray, number: u32) {
        let entry = self.look_up.entry(sampler.value(cell));
        let extinction = self.look_up.extinction(entry);
        if extinction <= 0.0 {
            return;
        }
        let weight = (1.0 - pixel.opacity) * opacity(extinction * ray.step_length_mm);
        let [factor, term] = match &self.light {
            Some(light) => light.shade(sampler.gradient(cell), ray),
            None => [1.0, 0.0],
        };
        let color = self.look_up.color(entry);
        for (gathered, color) in pixel.color.iter_mut().zip(color) {
            *gathered += weight * (color * factor + term);
        }
        pixel.opacity += weight;
        if pixel.opacity >= 0.5 && pixel.depth == NO_SAMPLE {
            pixel.depth = number;
        }
        pixel.is_done = pixel.opacity >= self.opacity_cutoff;
    }

    fn finish(&self, pixel: &DvrPixel) -> ([f32; 4], u32) {
        let [r, g, b] = pixel.color;
        ([r, g, b, pixel.opacity], pixel.depth)
    }
}

/// Maximum and minimum intensity projection, of stored values.
pub struct Extremum<'a> {
    pub look_up: LookUp<'a>,
    /// 1 to look for the largest stored value, −1 for the smallest.
    pub sign: f32,
}

#[derive(Clone, Copy)]
pub struct ExtremumPixel {
    /// The stored value times the sign; −∞ before the first sample.
    signed: f32,
    number: u32,
}

impl Projector for Extremum<'_> {
    type Pixel = ExtremumPixel;

    fn start(&self) -> ExtremumPixel {
        ExtremumPixel { signed: f32::NEG_INFINITY, number: NO_SAMPLE }
    }

    fn is_done(&self, _pixel: &ExtremumPixel) -> bool {
        false
    }

    fn is_unchanged_by(&self, pixel: &ExtremumPixel, [min, max]: [f32; 2]) -> bool {
        pixel.signed >= if self.sign > 0.0 { max } else { -min }
    }

    #[inline(always)]
    fn add<V: Voxel>(
        &self,
        pixel: &mut ExtremumPixel,
        sampler: &Sampler<V>,
        cell: Cell,
        _ray: &Ray,
        number: u32,
    ) {
        let signed = self.sign * sampler.value(cell);
        if signed > pixel.signed {
            *pixel = ExtremumPixel { signed, number };
        }
    }

    fn finish(&self, pixel: &ExtremumPixel) -> ([f32; 4], u32) {
        if pixel.number == NO_SAMPLE {
            return ([0.0; 4], NO_SAMPLE);
        }
        (self.look_up.projected(self.sign * pixel.signed), pixel.number)
    }
}

/// The arithmetic mean of the stored values.
pub struct Mean<'a> {
    pub look_up: LookUp<'a>,
}

#[derive(Clone, Copy)]
pub struct MeanPixel {
    sum: f64,
    samples: u32,
}

impl Projector for Mean<'_> {
    type Pixel = MeanPixel;

    fn start(&self) -> MeanPixel {
        MeanPixel { sum: 0.0, samples: 0 }
    }

    fn is_done(&self, _pixel: &MeanPixel) -> bool {
        false
    }

    fn is_unchanged_by(&self, _pixel: &MeanPixel, _reach: [f32; 2]) -> bool {
        false
    }

    #[inline(always)]
    fn add<V: Voxel>(
        &self,
        pixel: &mut MeanPixel,
        sampler: &Sampler<V>,
        cell: Cell,
        _ray: &Ray,
        _number: u32,
    ) {
        pixel.sum += f64::from(sampler.value(cell));
        pixel.samples += 1;
    }

    fn finish(&self, pixel: &MeanPixel) -> ([f32; 4], u32) {
        if pixel.samples == 0 {
            return ([0.0; 4], NO_SAMPLE);
        }
        (self.look_up.projected((pixel.sum / f64::from(pixel.samples)) as f32), NO_SAMPLE)
    }
}
