//! A frame layer by layer, in groups of as many bricks as there are threads: each brick is loaded once, and is in use only
//! while its group is drawn. Bricks are asked for in the plan's order, so what memory still holds, and what it must let go,
//! does not depend on which thread is faster.

use std::ops::Range;

use glassbrick_volume::{PlannedBrick, ReadError};
use rayon::prelude::*;

use crate::executor::{CpuFrame, Picture};
use crate::kernel::Kernel;
use crate::tiles::Tiles;

/// Draws all layers.
pub fn draw<K: Kernel>(kernel: &K, picture: Picture) -> Result<CpuFrame, ReadError> {
    let tiles = Tiles::new(kernel, picture.scene.rays);
    let mut loaded = 0;
    let layers = &picture.scene.plan.layers;
    for (number, layer) in layers.iter().enumerate() {
        let is_open =
            |brick: &&PlannedBrick| !picture.is_hidden(kernel, brick, tiles.in_rect(&brick.footprint));
        let open: Vec<&PlannedBrick> = layer.bricks.par_iter().filter(is_open).collect();
        loaded += open.len();
        if let Some(next) = layers.get(number + 1) {
            // Some of them will be hidden by this layer; they are hinted at, and then not read.
            picture.will_need(next.bricks.iter().filter(is_open));
        }
        for group in open.chunks(rayon::current_num_threads()) {
            let voxels = picture.load_all(group)?;
            let prepared: Vec<_> = group
                .par_iter()
                .zip(&voxels)
                .map(|(brick, voxels)| kernel.prepare(picture.view(brick, voxels.as_deref()?)))
                .collect();
            shares::<K>(group, &prepared).into_par_iter().for_each(|share| {
                let tiles = tiles.in_rows(share.tile_rows, &share.brick.footprint);
                let samples = tiles.map(|mut tile| kernel.add_brick(&mut tile, share.prepared)).sum();
                picture.count(share.brick, samples);
            });
        }
    }
    let frame = tiles.finish(kernel, picture.scene.rays);
    Ok(picture.finish(frame, loaded))
}

/// Rows of tiles of a brick's footprint, to be drawn by one thread.
struct Share<'a, P> {
    brick: &'a PlannedBrick,
    prepared: &'a P,
    tile_rows: Range<u32>,
}

/// Cuts the footprints of a group's bricks into shares, so that all threads have work.
fn shares<'a, 'b, K: Kernel>(
    group: &[&'a PlannedBrick],
    prepared: &'a [Option<K::Prepared<'b>>],
) -> Vec<Share<'a, K::Prepared<'b>>> {
    let wanted = 4 * rayon::current_num_threads();
    let per_brick = wanted.div_ceil(group.len()) as u32;
    let mut shares = Vec::new();
    for (&brick, prepared) in group.iter().zip(prepared) {
        let Some(prepared) = prepared else { continue };
        let rows = Tiles::<K::Tile>::rows(&brick.footprint);
        let rows_per_share = (rows.len() as u32).div_ceil(per_brick).max(1);
        for start in rows.clone().step_by(rows_per_share as usize) {
            shares.push(Share { brick, prepared, tile_rows: start..(start + rows_per_share).min(rows.end) });
        }
    }
    shares
}
