//! The plain kernel: one ray after the other, one sample after the other. Vectors of rays are held to it.

mod exponential;
mod interval;
mod look_up;
mod projector;
mod sampler;

use glam::Vec3;
use glassbrick_volume::{BrickSource, FrameRays, Mode, PixelRect, Ray, ReadError, Skip, Voxels};

use crate::executor::{CpuFrame, CpuScene, draw_with};
use crate::kernel::{BrickView, Kernel};
pub use interval::samples_in_box;
pub use look_up::LookUp;
use projector::{Dvr, Extremum, Headlight, Mean, Projector};
use sampler::{Sampler, Voxel};

/// Draws a planned frame with plain code.
pub fn draw(source: &dyn BrickSource, scene: &CpuScene) -> Result<CpuFrame, ReadError> {
    let desc = source.desc();
    let look_up = LookUp::new(scene.transfer_function, desc.rescale);
    let (skip, sample_count) = (scene.settings.skip, scene.rays.sample_count);
    match scene.settings.mode {
        Mode::Dvr => {
            let light = scene.settings.shading.map(|phong| Headlight {
                phong,
                normal_from_gradient: desc.level(scene.plan.level).desc.normal_from_gradient().as_mat3(),
            });
            let projector = Dvr { look_up, opacity_cutoff: scene.settings.effective_cutoff(), light };
            draw_with(&Scalar { projector, skip, sample_count }, source, scene)
        }
        mode @ (Mode::Mip | Mode::Minip) => {
            let sign = mode.sign(desc.rescale);
            let projector = Extremum { look_up, sign };
            draw_with(&Scalar { projector, skip, sample_count }, source, scene)
        }
        Mode::Mean => draw_with(&Scalar { projector: Mean { look_up }, skip, sample_count }, source, scene),
    }
}

/// One way to form pixels.
struct Scalar<P> {
    projector: P,
    skip: Skip,
    sample_count: u32,
}

/// Rays and what they have gathered so far, row by row.
struct ScalarTile<P> {
    rect: PixelRect,
    rays: Vec<Ray>,
    pixels: Vec<P>,
}

impl<P> ScalarTile<P> {
    /// The places in `rays` and `pixels` of those of the tile's pixels that lie in `rect`.
    fn places(&self, rect: &PixelRect) -> impl Iterator<Item = usize> + use<P> {
        let [min, max] = [self.rect.min, self.rect.max];
        let columns = rect.min[0].max(min[0])..rect.max[0].min(max[0]);
        let rows = rect.min[1].max(min[1])..rect.max[1].min(max[1]);
        let width = max[0] - min[0];
        rows.flat_map(move |row| {
            columns.clone().map(move |column| ((row - min[1]) * width + column - min[0]) as usize)
        })
    }
}

impl<P: Projector> Kernel for Scalar<P> {
    type Tile = ScalarTile<P::Pixel>;
    type Prepared<'a> = BrickView<'a>;

    fn start(&self, rays: &FrameRays, rect: PixelRect) -> Self::Tile {
        let pixels = (rect.min[1]..rect.max[1])
            .flat_map(|row| (rect.min[0]..rect.max[0]).map(move |column| (column, row)));
        let rays: Vec<Ray> = pixels.map(|(column, row)| rays.ray(column, row)).collect();
        ScalarTile { rect, pixels: vec![self.projector.start(); rays.len()], rays }
    }

    fn is_unchanged_by(&self, tile: &Self::Tile, rect: &PixelRect, reach: [f32; 2]) -> bool {
        tile.places(rect).all(|place| self.projector.is_unchanged_by(&tile.pixels[place], reach))
    }

    fn prepare<'a>(&self, brick: BrickView<'a>) -> Option<BrickView<'a>> {
        Some(brick)
    }

    fn add_brick(&self, tile: &mut Self::Tile, brick: &BrickView) -> u64 {
        if !tile.rect.overlaps(&brick.footprint) {
            return 0;
        }
        match &brick.brick.voxels {
            Voxels::U8(voxels) => self.add_voxels(tile, brick, voxels),
            Voxels::I8(voxels) => self.add_voxels(tile, brick, voxels),
            Voxels::U16(voxels) => self.add_voxels(tile, brick, voxels),
            Voxels::I16(voxels) => self.add_voxels(tile, brick, voxels),
            Voxels::F32(voxels) => self.add_voxels(tile, brick, voxels),
        }
    }

    fn rank(&self, _reach: [f32; 2]) -> Option<f32> {
        None
    }

    fn finish(&self, tile: &Self::Tile, mut pixel: impl FnMut([f32; 4], u32)) {
        for gathered in &tile.pixels {
            let (rgba, number) = self.projector.finish(gathered);
            pixel(rgba, number);
        }
    }
}

impl<P: Projector> Scalar<P> {
    fn add_voxels<V: Voxel>(&self, tile: &mut ScalarTile<P::Pixel>, brick: &BrickView, voxels: &[V]) -> u64 {
        let sampler = Sampler { voxels, edge: brick.brick.edge as usize, halo_start: brick.halo_start };
        let mut samples = 0;
        for place in tile.places(&brick.footprint) {
            let pixel = tile.pixels[place];
            let is_passed_by = self.projector.is_done(&pixel)
                || (self.skip == Skip::All && self.projector.is_unchanged_by(&pixel, brick.reach));
            if !is_passed_by {
                let (pixel, evaluated) = self.march(pixel, &tile.rays[place], brick.owned, &sampler);
                tile.pixels[place] = pixel;
                samples += u64::from(evaluated);
            }
        }
        samples
    }

    /// Adds the samples of one ray in one brick; returns the pixel and how many there were.
    #[inline(always)]
    fn march<V: Voxel>(
        &self,
        mut pixel: P::Pixel,
        ray: &Ray,
        owned: [Vec3; 2],
        sampler: &Sampler<V>,
    ) -> (P::Pixel, u32) {
        let numbers = samples_in_box(ray, owned, self.sample_count);
        for number in numbers.clone() {
            let cell = sampler.cell(ray.sample(number));
            self.projector.add(&mut pixel, sampler, cell, ray, number);
            if self.projector.is_done(&pixel) {
                return (pixel, number + 1 - numbers.start);
            }
        }
        (pixel, numbers.len() as u32)
    }
}
