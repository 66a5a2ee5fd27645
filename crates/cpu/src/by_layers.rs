//! A frame layer by layer: each brick is loaded once, and is in use only while its layer is drawn.

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
        shares::<K>(&open).into_par_iter().try_for_each(|share| {
            let Some(brick) = picture.load(share.brick)? else { return Ok(()) };
            if let Some(prepared) = kernel.prepare(picture.view(share.brick, &brick)) {
                let tiles = tiles.in_rows(share.tile_rows, &share.brick.footprint);
                let samples = tiles.map(|mut tile| kernel.add_brick(&mut tile, &prepared)).sum();
                picture.count(share.brick, samples);
            }
            Ok::<(), ReadError>(())
        })?;
    }
    let frame = tiles.finish(kernel, picture.scene.rays);
    Ok(picture.finish(frame, loaded))
}

/// Rows of tiles of a brick's footprint, to be drawn by one thread.
struct Share<'a> {
    brick: &'a PlannedBrick,
    tile_rows: Range<u32>,
}

/// Cuts the footprints of a layer with few bricks into shares, so that all threads have work.
fn shares<'a, K: Kernel>(open: &[&'a PlannedBrick]) -> Vec<Share<'a>> {
    let wanted = 4 * rayon::current_num_threads();
    let per_brick = wanted.div_ceil(open.len().max(1)) as u32;
    let mut shares = Vec::new();
    for &brick in open {
        let rows = Tiles::<K::Tile>::rows(&brick.footprint);
        let rows_per_share = (rows.len() as u32).div_ceil(per_brick).max(1);
        for start in rows.clone().step_by(rows_per_share as usize) {
            shares.push(Share { brick, tile_rows: start..(start + rows_per_share).min(rows.end) });
        }
    }
    shares
}
