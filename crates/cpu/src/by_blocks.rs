//! A frame block by block of the picture: a thread takes the rays of a block through all their bricks. No thread waits
//! for another, but all bricks of the frame are held until it is finished.

use std::cmp::Ordering;
use std::sync::OnceLock;

use glassbrick_volume::{Frame, FrameRays, PixelRect, PlannedBrick, ReadError};
use rayon::prelude::*;

use crate::executor::{CpuFrame, HeldBrick, Picture};
use crate::kernel::{Kernel, NO_SAMPLE, common};
use crate::tiles::TILE;

/// Pixels along a block's side: a whole number of tiles.
const BLOCK: u32 = 32;

/// How many of a block's bricks are hinted at while one is loaded.
const READ_AHEAD: usize = 2;

/// Draws all blocks.
pub fn draw<K: Kernel>(kernel: &K, picture: Picture) -> Result<CpuFrame, ReadError> {
    let rays = picture.scene.rays;
    let bricks = ordered(kernel, &picture);
    let held: Vec<HeldBrick> = bricks.iter().map(|_| OnceLock::new()).collect();
    let prepared: Vec<OnceLock<Option<K::Prepared<'_>>>> = bricks.iter().map(|_| OnceLock::new()).collect();
    let mut frame = Frame::transparent(rays.size.x, rays.size.y);
    let blocks = blocks(&mut frame, &bricks);
    // One by one: some blocks take long, and most take no time.
    blocks.into_par_iter().with_max_len(1).try_for_each(|mut block| {
        let rects: Vec<PixelRect> = block.tiles().collect();
        let mut tiles: Vec<K::Tile> = rects.iter().map(|&rect| kernel.start(rays, rect)).collect();
        for (step, &(place, footprint)) in block.bricks.iter().enumerate() {
            let brick = PlannedBrick { footprint, ..*bricks[place] };
            // A brick that is at hand costs no more to try than to look at.
            if held[place].get().is_none() && picture.is_hidden(kernel, &brick, tiles.iter()) {
                continue;
            }
            if held[place].get().is_none() {
                let coming = block.bricks[step + 1..].iter().take(READ_AHEAD).map(|&(place, _)| place);
                picture.will_need(
                    coming.filter(|&place| held[place].get().is_none()).map(|place| bricks[place]),
                );
            }
            let Some(voxels) = picture.hold(&brick, &held[place])? else { continue };
            let prepared =
                prepared[place].get_or_init(|| kernel.prepare(picture.view(bricks[place], voxels)));
            if let Some(prepared) = prepared {
                let met = tiles.iter_mut().zip(&rects).filter(|(_, rect)| rect.overlaps(&footprint));
                picture.count(&brick, met.map(|(tile, _)| kernel.add_brick(tile, prepared)).sum());
            }
        }
        for (tile, rect) in tiles.iter().zip(&rects) {
            block.finish(kernel, rays, rect, tile);
        }
        Ok::<(), ReadError>(())
    })?;
    let loaded = held.iter().filter(|brick| brick.get().is_some()).count();
    drop(prepared);
    Ok(picture.finish(frame, loaded))
}

/// The planned bricks in the order in which rays go through them.
fn ordered<'a, K: Kernel>(kernel: &K, picture: &Picture<'a>) -> Vec<&'a PlannedBrick> {
    let mut bricks: Vec<&PlannedBrick> =
        picture.scene.plan.layers.iter().flat_map(|layer| &layer.bricks).collect();
    let rank = |brick: &PlannedBrick| kernel.rank(picture.ranges[brick.index as usize].reach);
    // Bricks without a rank stay as they are: front to back.
    bricks.sort_by(|a, b| match (rank(a), rank(b)) {
        (Some(a), Some(b)) => b.total_cmp(&a),
        _ => Ordering::Equal,
    });
    bricks
}

/// A square of the picture.
struct Block<'a> {
    rect: PixelRect,
    /// The bricks that its pixels can meet, by their place among those planned, with the pixels that can.
    bricks: Vec<(usize, PixelRect)>,
    /// Its pixels and their depths, row by row.
    rows: Vec<(&'a mut [[f32; 4]], &'a mut [f32])>,
}

/// The blocks that may show something.
fn blocks<'a>(frame: &'a mut Frame, bricks: &[&PlannedBrick]) -> Vec<Block<'a>> {
    let size = [frame.width, frame.height];
    let [columns, rows] = size.map(|pixels| pixels.div_ceil(BLOCK));
    let corners = (0..rows).flat_map(|row| (0..columns).map(move |column| [column * BLOCK, row * BLOCK]));
    let mut blocks: Vec<Block> = corners
        .map(|min| {
            let max = [0, 1].map(|axis| (min[axis] + BLOCK).min(size[axis]));
            Block { rect: PixelRect { min, max }, bricks: Vec::new(), rows: Vec::new() }
        })
        .collect();
    for (place, brick) in bricks.iter().enumerate() {
        let [across, down] =
            [0, 1].map(|axis| brick.footprint.min[axis] / BLOCK..brick.footprint.max[axis].div_ceil(BLOCK));
        for row in down {
            for block in across.clone().map(|column| (row * columns + column) as usize) {
                let met = common(&blocks[block].rect, &brick.footprint)
                    .expect("a footprint meets the blocks it was cut into");
                blocks[block].bricks.push((place, met));
            }
        }
    }
    let width = frame.width as usize;
    let rows = frame.rgba.chunks_mut(width).zip(frame.depth_mm.chunks_mut(width)).enumerate();
    for (row, (rgba, depth_mm)) in rows {
        let first = row / BLOCK as usize * columns as usize;
        let spans = rgba.chunks_mut(BLOCK as usize).zip(depth_mm.chunks_mut(BLOCK as usize));
        for (block, span) in blocks[first..].iter_mut().zip(spans) {
            block.rows.push(span);
        }
    }
    blocks.retain(|block| !block.bricks.is_empty());
    blocks
}

impl Block<'_> {
    /// The tiles that the block consists of.
    fn tiles(&self) -> impl Iterator<Item = PixelRect> + use<> {
        let PixelRect { min, max } = self.rect;
        let corners = move |axis: usize| (min[axis]..max[axis]).step_by(TILE as usize);
        corners(1).flat_map(move |row| corners(0).map(move |column| [column, row])).map(move |first| {
            PixelRect { min: first, max: [0, 1].map(|axis| (first[axis] + TILE).min(max[axis])) }
        })
    }

    /// Puts what a tile has gathered into the picture.
    fn finish<K: Kernel>(&mut self, kernel: &K, rays: &FrameRays, rect: &PixelRect, tile: &K::Tile) {
        let [left, top] = [0, 1].map(|axis| rect.min[axis] - self.rect.min[axis]);
        let [width, height] = [0, 1].map(|axis| rect.max[axis] - rect.min[axis]);
        let mut pixels =
            (top..top + height).flat_map(|row| (left..left + width).map(move |column| (column, row)));
        kernel.finish(tile, |pixel, number| {
            let (column, row) = pixels.next().expect("a tile hands out as many pixels as it has");
            let (rgba, depth_mm) = &mut self.rows[row as usize];
            rgba[column as usize] = pixel;
            if number != NO_SAMPLE {
                depth_mm[column as usize] = rays.depth_mm(number) as f32;
            }
        });
    }
}
