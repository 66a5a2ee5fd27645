use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

use glam::UVec3;
use glassbrick_volume::{
    BakedTransferFunction, Brick, BrickGrid, BrickId, BrickRange, BrickSource, Frame, FramePlan, FrameRays,
    PlannedBrick, ReadError, RenderSettings, Skip,
};
use rayon::prelude::*;

use crate::kernel::{BrickView, Kernel};
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

/// Draws a planned frame with one kernel, layer by layer.
pub fn draw_with<K: Kernel>(
    kernel: &K,
    source: &dyn BrickSource,
    scene: &CpuScene,
) -> Result<CpuFrame, ReadError> {
    let picture = Picture {
        kernel,
        scene,
        grid: source.grid(scene.plan.level),
        ranges: source.ranges(scene.plan.level),
        tiles: Tiles::new(kernel, scene.rays),
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
        frame: picture.tiles.finish(kernel, scene.rays),
        occluded,
        rendered,
    })
}

/// A picture under way.
struct Picture<'a, K: Kernel> {
    kernel: &'a K,
    scene: &'a CpuScene<'a>,
    grid: BrickGrid,
    ranges: &'a [BrickRange],
    tiles: Tiles<K::Tile>,
    samples: AtomicU64,
}

/// Rows of tiles of a brick's footprint, to be drawn by one thread.
struct Share<'a> {
    brick: &'a PlannedBrick,
    tile_rows: Range<u32>,
    is_rendered: &'a AtomicBool,
}

impl<K: Kernel> Picture<'_, K> {
    /// Whether nothing in a brick can change the picture any more.
    fn is_hidden(&self, brick: &PlannedBrick) -> bool {
        let reach = self.ranges[brick.index as usize].reach;
        self.scene.settings.skip == Skip::All
            && self
                .tiles
                .in_rect(&brick.footprint)
                .all(|tile| self.kernel.is_unchanged_by(&tile, &brick.footprint, reach))
    }

    /// Draws bricks of one layer; returns how many had a sample evaluated.
    fn draw_bricks(&self, source: &dyn BrickSource, open: &[&PlannedBrick]) -> Result<usize, ReadError> {
        let is_rendered: Vec<AtomicBool> = open.iter().map(|_| AtomicBool::new(false)).collect();
        let level = self.scene.plan.level;
        self.shares(open, &is_rendered).into_par_iter().try_for_each(|share| {
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
            let rows = Tiles::<K::Tile>::rows(&brick.footprint);
            let rows_per_share = (rows.len() as u32).div_ceil(per_brick).max(1);
            for start in rows.clone().step_by(rows_per_share as usize) {
                let tile_rows = start..(start + rows_per_share).min(rows.end);
                shares.push(Share { brick, tile_rows, is_rendered });
            }
        }
        shares
    }

    fn draw_share(&self, brick: &Brick, share: &Share) {
        let range = &self.ranges[share.brick.index as usize];
        let Some(prepared) = self.kernel.prepare(BrickView::new(brick, share.brick, &self.grid, range))
        else {
            return;
        };
        let tiles = self.tiles.in_rows(share.tile_rows.clone(), &share.brick.footprint);
        let samples: u64 = tiles.map(|mut tile| self.kernel.add_brick(&mut tile, &prepared)).sum();
        if samples > 0 {
            self.samples.fetch_add(samples, Ordering::Relaxed);
            share.is_rendered.store(true, Ordering::Relaxed);
        }
    }
}
