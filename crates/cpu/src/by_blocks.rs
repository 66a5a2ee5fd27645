//! A frame block by block of the picture: a thread takes the rays of a block through all their bricks. No thread waits
//! for another, but all bricks of the frame are held until it is finished.

use std::cmp::Ordering;
use std::sync::{Arc, OnceLock};

use glassbrick_volume::{Brick, PixelRect, PlannedBrick, ReadError};
use rayon::prelude::*;

use crate::executor::Picture;
use crate::kernel::{Kernel, common};

/// Pixels along a block's side: a whole number of tiles.
const BLOCK: u32 = 32;

/// How many of a block's bricks are hinted at while one is loaded.
const READ_AHEAD: usize = 2;

/// Draws all blocks; returns how many bricks were loaded.
pub fn draw<K: Kernel>(picture: &Picture<K>) -> Result<usize, ReadError> {
    let bricks = ordered(picture);
    let held: Vec<OnceLock<Option<Arc<Brick>>>> = bricks.iter().map(|_| OnceLock::new()).collect();
    let prepared: Vec<OnceLock<Option<K::Prepared<'_>>>> = bricks.iter().map(|_| OnceLock::new()).collect();
    blocks(picture.scene.rays.size.to_array(), &bricks).into_par_iter().try_for_each(|block| {
        for (step, &(place, footprint)) in block.iter().enumerate() {
            let brick = PlannedBrick { footprint, ..*bricks[place] };
            // A brick that is at hand costs no more to try than to look at.
            if held[place].get().is_none() && picture.is_hidden(&brick) {
                continue;
            }
            let voxels = match held[place].get() {
                Some(voxels) => voxels,
                None => {
                    let coming = block[step + 1..].iter().take(READ_AHEAD).map(|&(place, _)| place);
                    picture.will_need(
                        coming.filter(|&place| held[place].get().is_none()).map(|place| bricks[place]),
                    );
                    let voxels = picture.load(&brick)?;
                    held[place].get_or_init(|| voxels)
                }
            };
            let Some(voxels) = voxels else { continue };
            let prepared = prepared[place].get_or_init(|| picture.prepare(bricks[place], voxels));
            if let Some(prepared) = prepared {
                let tiles = picture.tiles.in_rect(&footprint);
                let samples = tiles.map(|mut tile| picture.kernel.add_brick(&mut tile, prepared)).sum();
                picture.count(&brick, samples);
            }
        }
        Ok::<(), ReadError>(())
    })?;
    Ok(held.iter().filter(|brick| brick.get().is_some()).count())
}

/// The planned bricks in the order in which rays go through them.
fn ordered<'a, K: Kernel>(picture: &Picture<'a, K>) -> Vec<&'a PlannedBrick> {
    let mut bricks: Vec<&PlannedBrick> =
        picture.scene.plan.layers.iter().flat_map(|layer| &layer.bricks).collect();
    let rank = |brick: &PlannedBrick| picture.kernel.rank(picture.ranges[brick.index as usize].reach);
    // Bricks without a rank stay as they are: front to back.
    bricks.sort_by(|a, b| match (rank(a), rank(b)) {
        (Some(a), Some(b)) => b.total_cmp(&a),
        _ => Ordering::Equal,
    });
    bricks
}

/// Of each block, the bricks that its pixels can meet, by place in `bricks`, with the pixels that can.
fn blocks(size: [u32; 2], bricks: &[&PlannedBrick]) -> Vec<Vec<(usize, PixelRect)>> {
    let [columns, rows] = size.map(|pixels| pixels.div_ceil(BLOCK));
    let mut blocks = vec![Vec::new(); (columns * rows) as usize];
    for (place, brick) in bricks.iter().enumerate() {
        let [across, down] =
            [0, 1].map(|axis| brick.footprint.min[axis] / BLOCK..brick.footprint.max[axis].div_ceil(BLOCK));
        for row in down {
            for column in across.clone() {
                let min = [column * BLOCK, row * BLOCK];
                let block = PixelRect { min, max: min.map(|first| first + BLOCK) };
                let met =
                    common(&block, &brick.footprint).expect("a footprint meets the blocks it was cut into");
                blocks[(row * columns + column) as usize].push((place, met));
            }
        }
    }
    blocks
}
