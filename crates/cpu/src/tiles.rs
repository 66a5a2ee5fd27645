use std::ops::Range;
use std::sync::{Mutex, MutexGuard};

use glassbrick_volume::{Frame, FrameRays, PixelRect};
use rayon::prelude::*;

use crate::kernel::{Kernel, NO_SAMPLE};

/// Pixels along a tile's side.
pub const TILE: u32 = 8;

/// The picture under way, in tiles that belong to one thread at a time.
pub struct Tiles<T> {
    size: [u32; 2],
    columns: u32,
    tiles: Vec<Mutex<T>>,
}

impl<T: Send> Tiles<T> {
    pub fn new(kernel: &impl Kernel<Tile = T>, rays: &FrameRays) -> Self {
        let size = rays.size.to_array();
        let [columns, rows] = size.map(|pixels| pixels.div_ceil(TILE));
        let tiles = (0..columns * rows)
            .into_par_iter()
            .map(|tile| Mutex::new(kernel.start(rays, tile_rect(size, tile % columns, tile / columns))))
            .collect();
        Self { size, columns, tiles }
    }

    /// The rows of tiles that meet a rectangle of pixels.
    pub fn rows(rect: &PixelRect) -> Range<u32> {
        rect.min[1] / TILE..rect.max[1].div_ceil(TILE)
    }

    /// The tiles of some rows that meet a rectangle of pixels, each locked while it is looked at.
    pub fn in_rows<'a>(
        &'a self,
        rows: Range<u32>,
        rect: &PixelRect,
    ) -> impl Iterator<Item = MutexGuard<'a, T>> + use<'a, T> {
        let columns = rect.min[0] / TILE..rect.max[0].div_ceil(TILE);
        rows.flat_map(move |row| columns.clone().map(move |column| row * self.columns + column))
            .map(|tile| locked(&self.tiles[tile as usize]))
    }

    /// The tiles that meet a rectangle of pixels.
    pub fn in_rect<'a>(&'a self, rect: &PixelRect) -> impl Iterator<Item = MutexGuard<'a, T>> + use<'a, T> {
        self.in_rows(Self::rows(rect), rect)
    }

    /// The finished picture.
    pub fn finish(&self, kernel: &impl Kernel<Tile = T>, rays: &FrameRays) -> Frame {
        let [width, height] = self.size;
        let mut frame = Frame::transparent(width, height);
        // A row of tiles is a run of whole rows of the picture.
        let run = (width * TILE) as usize;
        let runs = frame.rgba.par_chunks_mut(run).zip(frame.depth_mm.par_chunks_mut(run));
        let rows = self.tiles.par_chunks(self.columns as usize).zip(runs).enumerate();
        rows.for_each(|(row, (tiles, (rgba, depth_mm)))| {
            for (column, tile) in (0..).zip(tiles) {
                let PixelRect { min, max } = tile_rect(self.size, column, row as u32);
                let pixels =
                    (0..max[1] - min[1]).flat_map(|row| (min[0]..max[0]).map(move |column| (column, row)));
                let mut places = pixels.map(|(column, row)| (row * width + column) as usize);
                kernel.finish(&locked(tile), |pixel, number| {
                    let place = places.next().expect("a tile hands out as many pixels as it has");
                    rgba[place] = pixel;
                    if number != NO_SAMPLE {
                        depth_mm[place] = rays.depth_mm(number) as f32;
                    }
                });
            }
        });
        frame
    }
}

fn locked<T>(tile: &Mutex<T>) -> MutexGuard<'_, T> {
    tile.lock().expect("no thread panics while it holds a tile")
}

fn tile_rect(size: [u32; 2], column: u32, row: u32) -> PixelRect {
    let min = [column * TILE, row * TILE];
    PixelRect { min, max: [0, 1].map(|axis| (min[axis] + TILE).min(size[axis])) }
}
