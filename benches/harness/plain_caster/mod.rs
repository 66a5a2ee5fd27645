//! SW, the baseline: a ray caster as Levoy (1990) has it, without bricks. The whole volume is one array, every ray marches
//! through all of it, one sample after the other, and stops where it is opaque.

mod array;
mod pixel;

use glam::{DVec3, UVec2, Vec3};
use glassbrick::{Camera, Frame, Mode, RenderRequest};
use glassbrick_volume::{FrameRays, Ray, VOLUME_MARGIN_VOXELS, Voxels};
use rayon::prelude::*;

pub use array::PlainVolume;
use array::{PlainVoxel, VoxelArray};
use pixel::{Dvr, Extremum, Mean, Pixel};

use crate::BenchError;

/// Draws a picture of the volume at full resolution; returns how many samples were evaluated, too. Skipping, memory and
/// passes are not this one's matter: of the request, it takes size, step, transfer function, mode, shading and cutoff.
///
/// # Errors
/// When the camera is impossible.
pub fn draw(
    volume: &PlainVolume,
    request: &RenderRequest,
    camera: &Camera,
) -> Result<(Frame, u64), BenchError> {
    let size = UVec2::from_array(request.size);
    let rays =
        FrameRays::new(&volume.desc.level(0), camera, size, request.step_voxels).map_err(BenchError::View)?;
    let march = March { volume, request, rays: &rays };
    Ok(volume.threads.install(|| match &volume.voxels {
        Voxels::U8(voxels) => march.draw(voxels),
        Voxels::I8(voxels) => march.draw(voxels),
        Voxels::U16(voxels) => march.draw(voxels),
        Voxels::I16(voxels) => march.draw(voxels),
        Voxels::F32(voxels) => march.draw(voxels),
    }))
}

struct March<'a> {
    volume: &'a PlainVolume,
    request: &'a RenderRequest,
    rays: &'a FrameRays,
}

impl March<'_> {
    fn draw<V: PlainVoxel>(&self, voxels: &[V]) -> (Frame, u64) {
        let desc = &self.volume.desc;
        let array = VoxelArray { voxels, extent: desc.extent, rescale: desc.rescale };
        let transfer_function = &self.request.transfer_function.bake(desc.smallest_spacing_mm());
        let settings = &self.request.settings;
        match settings.mode {
            Mode::Dvr => {
                let normal_from_gradient = desc.normal_from_gradient().as_mat3();
                let cutoff = settings.effective_cutoff();
                self.pixels(&array, || {
                    Dvr::new(transfer_function, cutoff, settings.shading, normal_from_gradient)
                })
            }
            Mode::Mip => self.pixels(&array, || Extremum::new(transfer_function, 1.0)),
            Mode::Minip => self.pixels(&array, || Extremum::new(transfer_function, -1.0)),
            Mode::Mean => self.pixels(&array, || Mean::new(transfer_function)),
        }
    }

    /// Every pixel, rows shared out over the threads.
    fn pixels<V: PlainVoxel, P: Pixel>(
        &self,
        array: &VoxelArray<V>,
        start: impl Fn() -> P + Sync,
    ) -> (Frame, u64) {
        let [width, height] = self.request.size;
        let mut frame = Frame::transparent(width, height);
        let rows =
            frame.rgba.par_chunks_mut(width as usize).zip(frame.depth_mm.par_chunks_mut(width as usize));
        let samples = rows
            .enumerate()
            .map(|(row, (rgba, depth_mm))| {
                let mut samples = 0;
                for column in 0..width {
                    let ray = self.rays.ray(column, row as u32);
                    let mut pixel = start();
                    samples += self.march(array, &ray, &mut pixel);
                    let (color, number) = pixel.finish();
                    rgba[column as usize] = color;
                    if let Some(number) = number {
                        depth_mm[column as usize] = self.rays.depth_mm(number) as f32;
                    }
                }
                samples
            })
            .sum();
        (frame, samples)
    }

    /// Adds a ray's samples to its pixel until they end or no more can count.
    fn march<V: PlainVoxel>(&self, array: &VoxelArray<V>, ray: &Ray, pixel: &mut impl Pixel) -> u64 {
        let mut samples = 0;
        let [low, high] = self.volume.box_voxel();
        for number in self.numbers_near(ray) {
            let at = ray.sample(number);
            if !(at.cmpge(low).all() && at.cmplt(high).all()) {
                continue;
            }
            samples += 1;
            pixel.add(array, at, ray, number);
            if pixel.is_done() {
                break;
            }
        }
        samples
    }

    /// The samples of a ray that may lie in the volume: where it meets its box, and one more on either side.
    fn numbers_near(&self, ray: &Ray) -> std::ops::Range<u32> {
        let (start, step) = (ray.start.as_dvec3(), ray.step.as_dvec3());
        let (low, high) = (DVec3::splat(-0.5), self.volume.desc.extent.as_dvec3() - 0.5);
        let (mut enter, mut leave) = (0.0, f64::from(self.rays.sample_count));
        for axis in 0..3 {
            if step[axis] == 0.0 {
                continue;
            }
            let meets = [low, high].map(|face| (face[axis] - start[axis]) / step[axis]);
            enter = meets[0].min(meets[1]).max(enter);
            leave = meets[0].max(meets[1]).min(leave);
        }
        let first = (enter - MARGIN_SAMPLES).max(0.0);
        let end = (leave + MARGIN_SAMPLES).clamp(0.0, f64::from(self.rays.sample_count));
        first as u32..end as u32
    }
}

/// More than rounding and the box's margin can move the end of a ray.
const MARGIN_SAMPLES: f64 = 2.0;

impl PlainVolume {
    /// Where samples count, as `f32` positions are compared.
    fn box_voxel(&self) -> [Vec3; 2] {
        let margin = VOLUME_MARGIN_VOXELS as f32;
        [Vec3::splat(-0.5 - margin), self.desc.extent.as_vec3() - 0.5 + margin]
    }
}
