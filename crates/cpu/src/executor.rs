use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use glam::{Mat3, UVec3, Vec3};
use glassbrick_volume::{
    BakedTransferFunction, Brick, BrickGrid, BrickId, BrickRange, BrickSource, Frame, FramePlan, FrameRays,
    Mode, PlannedBrick, Ray, ReadError, RenderSettings, Skip, Voxels,
};
use rayon::prelude::*;

use crate::interval::samples_in_box;
use crate::look_up::LookUp;
use crate::projector::{Dvr, Extremum, Headlight, Mean, Projector};
use crate::sampler::{Sampler, Voxel};
use crate::tiles::Tiles;

/// What is to be drawn.
pub struct CpuScene<'a> {
    pub rays: &'a FrameRays,
    pub plan: &'a FramePlan,
    pub transfer_function: &'a BakedTransferFunction,
    pub settings: RenderSettings,
}

/// A finished frame and what it took.
pub struct CpuFrame {
    pub frame: Frame,
    /// Samples evaluated.
    pub samples: u64,
    /// Planned bricks that could not change the picture any more when their layer's turn came; they were not loaded.
    pub occluded: usize,
    /// Planned bricks of which at least one sample was evaluated.
    pub rendered: usize,
}

/// Draws a planned frame on the threads of the current rayon pool.
///
/// # Errors
/// When a brick cannot be read.
pub fn draw(source: &dyn BrickSource, scene: &CpuScene) -> Result<CpuFrame, ReadError> {
    let desc = source.desc();
    let look_up = LookUp::new(scene.transfer_function, desc.rescale);
    match scene.settings.mode {
        Mode::Dvr => {
            let light = scene.settings.shading.map(|phong| Headlight {
                phong,
                normal_from_gradient: normal_from_gradient(desc.world_from_voxel().matrix3),
            });
            let opacity_cutoff = scene.settings.effective_cutoff();
            draw_with(&Dvr { look_up, opacity_cutoff, light }, source, scene)
        }
        mode @ (Mode::Mip | Mode::Minip) => {
            // A negative slope turns the largest value into the smallest stored value.
            let sign = if (mode == Mode::Mip) == (desc.rescale.slope > 0.0) { 1.0 } else { -1.0 };
            draw_with(&Extremum { look_up, sign }, source, scene)
        }
        Mode::Mean => draw_with(&Mean { look_up }, source, scene),
    }
}

/// The inverse transpose, in which surfaces' normals go from voxel to world space.
fn normal_from_gradient(world_from_voxel: glam::DMat3) -> Mat3 {
    world_from_voxel.inverse().transpose().as_mat3()
}

fn draw_with<P: Projector>(
    projector: &P,
    source: &dyn BrickSource,
    scene: &CpuScene,
) -> Result<CpuFrame, ReadError> {
    let picture = Picture {
        projector,
        scene,
        grid: source.grid(scene.plan.level),
        ranges: source.ranges(scene.plan.level),
        tiles: Tiles::new(scene.rays, projector.start()),
        samples: AtomicU64::new(0),
    };
    let (mut occluded, mut rendered) = (0, 0);
    for layer in &scene.plan.layers {
        let open: Vec<&PlannedBrick> =
            layer.bricks.par_iter().filter(|brick| !picture.is_hidden(brick)).collect();
        occluded += layer.bricks.len() - open.len();
        rendered += picture.draw_bricks(source, &open)?;
    }
    Ok(CpuFrame {
        samples: picture.samples.into_inner(),
        frame: picture.tiles.finish(scene.rays, projector),
        occluded,
        rendered,
    })
}

/// A picture under way.
struct Picture<'a, P: Projector> {
    projector: &'a P,
    scene: &'a CpuScene<'a>,
    grid: BrickGrid,
    ranges: &'a [BrickRange],
    tiles: Tiles<P::Pixel>,
    samples: AtomicU64,
}

/// Rows of tiles of a brick's footprint, to be drawn by one thread.
struct Share<'a> {
    brick: &'a PlannedBrick,
    tile_rows: Range<u32>,
    is_rendered: &'a AtomicBool,
}

impl<P: Projector> Picture<'_, P> {
    /// Whether nothing in a brick can change the picture any more.
    fn is_hidden(&self, brick: &PlannedBrick) -> bool {
        let reach = self.ranges[brick.index as usize].reach;
        self.scene.settings.skip == Skip::All
            && self.tiles.all(&brick.footprint, |pixel| self.projector.is_unchanged_by(pixel, reach))
    }

    /// Draws bricks of one layer; returns how many had a sample evaluated.
    fn draw_bricks(&self, source: &dyn BrickSource, open: &[&PlannedBrick]) -> Result<usize, ReadError> {
        let is_rendered: Vec<AtomicBool> = open.iter().map(|_| AtomicBool::new(false)).collect();
        let shares = self.shares(open, &is_rendered);
        let level = self.scene.plan.level;
        shares.into_par_iter().try_for_each(|share| {
            let UVec3 { x, y, z } = self.grid.brick(share.brick.index as usize);
            let brick = source.brick(BrickId { level, x, y, z })?;
            self.draw_share(&brick, &share);
            Ok::<(), ReadError>(())
        })?;
        Ok(is_rendered.iter().filter(|flag| flag.load(Ordering::Relaxed)).count())
    }

    /// Cuts the footprints of a layer with few bricks into shares, so that all threads have work.
    fn shares<'b>(&self, open: &[&'b PlannedBrick], is_rendered: &'b [AtomicBool]) -> Vec<Share<'b>> {
        let wanted = 4 * rayon::current_num_threads();
        let per_brick = wanted.div_ceil(open.len().max(1)) as u32;
        let mut shares = Vec::new();
        for (&brick, is_rendered) in open.iter().zip(is_rendered) {
            let rows = Tiles::<P::Pixel>::rows(&brick.footprint);
            let rows_per_share = (rows.len() as u32).div_ceil(per_brick).max(1);
            for start in rows.clone().step_by(rows_per_share as usize) {
                let tile_rows = start..(start + rows_per_share).min(rows.end);
                shares.push(Share { brick, tile_rows, is_rendered });
            }
        }
        shares
    }

    fn draw_share(&self, brick: &Brick, share: &Share) {
        let samples = match &brick.voxels {
            Voxels::U8(voxels) => self.draw_voxels(voxels, share),
            Voxels::I8(voxels) => self.draw_voxels(voxels, share),
            Voxels::U16(voxels) => self.draw_voxels(voxels, share),
            Voxels::I16(voxels) => self.draw_voxels(voxels, share),
            Voxels::F32(voxels) => self.draw_voxels(voxels, share),
        };
        if samples > 0 {
            self.samples.fetch_add(samples, Ordering::Relaxed);
            share.is_rendered.store(true, Ordering::Relaxed);
        }
    }

    /// Adds a brick's samples to the pixels of a share; returns how many there were.
    fn draw_voxels<V: Voxel>(&self, voxels: &[V], share: &Share) -> u64 {
        let index = share.brick.index as usize;
        let brick = self.grid.brick(index);
        let sampler =
            Sampler { voxels, edge: self.grid.layout.edge as usize, halo_start: self.grid.halo_start(brick) };
        let owned = self.grid.owned_box(brick);
        let reach = self.ranges[index].reach;
        let rect = &share.brick.footprint;
        let mut samples = 0;
        for mut tile in self.tiles.in_rows(share.tile_rows.clone(), rect) {
            for place in tile.places(rect) {
                let pixel = tile.pixels[place];
                if self.is_passed_by(&pixel, reach) {
                    continue;
                }
                let ray = tile.rays[place];
                let (pixel, evaluated) = self.march(pixel, &ray, owned, &sampler);
                tile.pixels[place] = pixel;
                samples += u64::from(evaluated);
            }
        }
        samples
    }

    fn is_passed_by(&self, pixel: &P::Pixel, reach: [f32; 2]) -> bool {
        let skip_all = self.scene.settings.skip == Skip::All;
        self.projector.is_done(pixel) || (skip_all && self.projector.is_unchanged_by(pixel, reach))
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
        let numbers = samples_in_box(ray, owned, self.scene.rays.sample_count);
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
