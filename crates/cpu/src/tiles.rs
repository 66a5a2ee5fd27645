use std::sync::{Mutex, MutexGuard};

use glassbrick_volume::{Frame, FrameRays, PixelRect, Ray};
use rayon::prelude::*;

use crate::projector::{NO_SAMPLE, Projector};

/// Pixels along a tile's side.
pub const TILE: u32 = 8;

/// The picture under way, in tiles that belong to one thread at a time.
pub struct Tiles<P> {
    columns: u32,
    tiles: Vec<Mutex<Tile<P>>>,
}

/// Rays and what they have gathered so far, row by row.
pub struct Tile<P> {
    pub rect: PixelRect,
    pub rays: Vec<Ray>,
    pub pixels: Vec<P>,
}

impl<P: Copy> Tile<P> {
    /// The places in `rays` and `pixels` of those of the tile's pixels that lie in `rect`.
    pub fn places(&self, rect: &PixelRect) -> impl Iterator<Item = usize> + use<P> {
        let [min, max] = [self.rect.min, self.rect.max];
        let columns = rect.min[0].max(min[0])..rect.max[0].min(max[0]);
        let rows = rect.min[1].max(min[1])..rect.max[1].min(max[1]);
        let width = max[0] - min[0];
        rows.flat_map(move |row| {
            columns.clone().map(move |column| ((row - min[1]) * width + column - min[0]) as usize)
        })
    }
}

impl<P: Copy + Send + Sync> Tiles<P> {
    pub fn new(rays: &FrameRays, start: P) -> Self {
        let columns = rays.size.x.div_ceil(TILE);
        let rows = rays.size.y.div_ceil(TILE);
        let tiles = (0..columns * rows)
            .into_par_iter()
            .map(|tile| {
                let min = [tile % columns * TILE, tile / columns * TILE];
                let max = [(min[0] + TILE).min(rays.size.x), (min[1] + TILE).min(rays.size.y)];
                let pixels =
                    (min[1]..max[1]).flat_map(|row| (min[0]..max[0]).map(move |column| (column, row)));
                let rays: Vec<Ray> = pixels.map(|(column, row)| rays.ray(column, row)).collect();
                Mutex::new(Tile { rect: PixelRect { min, max }, pixels: vec![start; rays.len()], rays })
            })
            .collect();
        Self { columns, tiles }
    }

    /// The rows of tiles that meet a rectangle of pixels.
    pub fn rows(rect: &PixelRect) -> std::ops::Range<u32> {
        rect.min[1] / TILE..rect.max[1].div_ceil(TILE)
    }

    /// The tiles of some rows that meet a rectangle of pixels, each locked while it is looked at.
    pub fn in_rows<'a>(
        &'a self,
        rows: std::ops::Range<u32>,
        rect: &PixelRect,
    ) -> impl Iterator<Item = MutexGuard<'a, Tile<P>>> {
        let columns = rect.min[0] / TILE..rect.max[0].div_ceil(TILE);
        rows.flat_map(move |row| columns.clone().map(move |column| row * self.columns + column))
            .map(|tile| self.tiles[tile as usize].lock().expect("no thread panics while it holds a tile"))
    }

    /// Whether a condition holds for every pixel of a rectangle.
    pub fn all(&self, rect: &PixelRect, condition: impl Fn(&P) -> bool) -> bool {
        self.in_rows(Self::rows(rect), rect)
            .all(|tile| tile.places(rect).all(|place| condition(&tile.pixels[place])))
    }

    /// The finished picture.
    pub fn finish(self, rays: &FrameRays, projector: &impl Projector<Pixel = P>) -> Frame {
        let mut frame = Frame::transparent(rays.size.x, rays.size.y);
        for tile in self.tiles {
            let tile = tile.into_inner().expect("no thread panics while it holds a tile");
            let width = (tile.rect.max[0] - tile.rect.min[0]) as usize;
            for (place, pixel) in tile.pixels.iter().enumerate() {
                let (column, row) =
                    (tile.rect.min[0] as usize + place % width, tile.rect.min[1] as usize + place / width);
                let index = row * rays.size.x as usize + column;
                let (rgba, number) = projector.finish(pixel);
                frame.rgba[index] = rgba;
                if number != NO_SAMPLE {
                    frame.depth_mm[index] = rays.depth_mm(number) as f32;
                }
            }
        }
        frame
    }
}
