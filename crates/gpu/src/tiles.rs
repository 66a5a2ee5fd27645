use std::collections::{BTreeMap, BTreeSet};

use glassbrick_volume::{BrickId, FramePlan, PixelRect, PlannedBrick};

/// Pixels of a tile, at most: what it keeps of each fits into every device's buffers.
const MOST_PIXELS: u32 = 1 << 21;
/// Pixels along a side of a tile, at most: what every device can draw into.
const MOST_SIDE: u32 = 2048;

/// What the drawing of a tile, or of all tiles of a frame, took.
#[derive(Default)]
pub struct Taken {
    /// Places in the grid of bricks that were rendered.
    pub rendered: BTreeSet<u32>,
    /// Why bricks were left out that could not be read, by place in the grid.
    pub damaged: BTreeMap<u32, String>,
    /// Bricks that were needed, not resident and not waited for, each once, the nearest first.
    pub missing: Vec<BrickId>,
}

impl Taken {
    /// Adds what another tile took.
    pub fn add(&mut self, other: Self) {
        self.rendered.extend(other.rendered);
        self.damaged.extend(other.damaged);
        let known: BTreeSet<BrickId> = self.missing.iter().copied().collect();
        self.missing.extend(other.missing.into_iter().filter(|brick| !known.contains(brick)));
    }
}

/// The parts that a picture is drawn in, each for itself.
pub fn tiles([width, height]: [u32; 2]) -> Vec<PixelRect> {
    let tile_width = width.min(MOST_SIDE);
    let tile_height = height.min(MOST_SIDE).min(MOST_PIXELS / tile_width);
    let starts = |length: u32, step: u32| (0..length).step_by(step as usize);
    starts(height, tile_height)
        .flat_map(|y| starts(width, tile_width).map(move |x| [x, y]))
        .map(|min| PixelRect { min, max: [width.min(min[0] + tile_width), height.min(min[1] + tile_height)] })
        .collect()
}

/// The planned bricks that a tile can meet, layer by layer.
pub fn layers_of(plan: &FramePlan, tile: &PixelRect) -> Vec<Vec<PlannedBrick>> {
    let meets = |brick: &&PlannedBrick| brick.footprint.overlaps(tile);
    let layers = plan.layers.iter().map(|layer| layer.bricks.iter().filter(meets).copied().collect());
    layers.filter(|layer: &Vec<_>| !layer.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once() {
        for size in [[1, 1], [512, 512], [2048, 1024], [2049, 1025], [32_768, 3], [3, 32_768], [5000, 4100]] {
            let tiles = tiles(size);
            let area = |tile: &PixelRect| {
                u64::from(tile.max[0] - tile.min[0]) * u64::from(tile.max[1] - tile.min[1])
            };
            assert_eq!(tiles.iter().map(area).sum::<u64>(), u64::from(size[0]) * u64::from(size[1]));
            for tile in &tiles {
                assert!(area(tile) > 0 && area(tile) <= u64::from(MOST_PIXELS));
                assert!(tile.max[0] <= size[0] && tile.max[1] <= size[1]);
                assert!(tile.max[0] - tile.min[0] <= MOST_SIDE && tile.max[1] - tile.min[1] <= MOST_SIDE);
            }
        }
    }
}
