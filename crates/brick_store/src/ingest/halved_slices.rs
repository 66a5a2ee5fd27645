use std::path::Path;

use glam::UVec3;
use glassbrick_volume::{BrickGrid, BrickId, StoredType};
use rayon::prelude::*;

use super::bricks_at_once;
use super::slice_window::SliceFeed;
use crate::element::{Element, with_element};
use crate::store::{BrickFiles, StoreDesc, StoreError};

/// The slices of a level, each voxel the average of those of the stored level below that it covers.
pub struct HalvedSlices<'a> {
    store: &'a StoreDesc,
    files: BrickFiles,
    below: u32,
    grid_below: BrickGrid,
    extent: UVec3,
    /// The layer of bricks below that comes next.
    next_layer: u32,
    /// Memory to fill again.
    used: Vec<Vec<u8>>,
}

impl<'a> HalvedSlices<'a> {
    /// Reads level `level` − 1 of the store in a folder, from the first slice on.
    pub fn new(root: &Path, store: &'a StoreDesc, level: u32) -> Self {
        let extent = store.volume.extent;
        Self {
            store,
            files: BrickFiles::new(root.to_owned(), store),
            below: level - 1,
            grid_below: store.layout.level_grid(extent, level - 1),
            extent: store.layout.level_grid(extent, level).extent,
            next_layer: 0,
            used: Vec::new(),
        }
    }

    /// Halves a layer of bricks into slices.
    fn halve_layer(&self, layer: u32, slices: &mut Vec<u8>) -> Result<(), StoreError> {
        let voxel_bytes = self.store.volume.stored_type.bytes();
        let grid = &self.grid_below;
        let half_core = grid.layout.core() / 2;
        let depth = (self.extent.z - layer * half_core).min(half_core) as usize;
        let [width, height] = [self.extent.x, self.extent.y].map(|n| n as usize);
        slices.resize(depth * width * height * voxel_bytes, 0);
        let bricks: Vec<UVec3> = (0..grid.counts.y)
            .flat_map(|y| (0..grid.counts.x).map(move |x| UVec3::new(x, y, layer)))
            .collect();
        for bricks in bricks.chunks(bricks_at_once(self.store)) {
            let halved: Vec<Vec<u8>> =
                bricks.par_iter().map(|&brick| self.halve_brick(brick)).collect::<Result<_, _>>()?;
            for (&brick, halved) in bricks.iter().zip(&halved) {
                let [x, y] = [brick.x * half_core, brick.y * half_core].map(|start| start as usize);
                let row_bytes = (width - x).min(half_core as usize) * voxel_bytes;
                let rows = (height - y).min(half_core as usize);
                for (number, row) in halved.chunks_exact(row_bytes).enumerate() {
                    let (z, y) = (number / rows, y + number % rows);
                    let place = ((z * height + y) * width + x) * voxel_bytes;
                    slices[place..place + row_bytes].copy_from_slice(row);
                }
            }
        }
        swap_to_native(slices, self.store.volume.stored_type);
        Ok(())
    }

    /// The averages over a brick's core.
    fn halve_brick(&self, brick: UVec3) -> Result<Vec<u8>, StoreError> {
        let core = self.grid_below.core_end(brick) - self.grid_below.core_start(brick);
        let id = BrickId::new(self.below, brick);
        self.files.read(id, || Ok(()), |_, voxels| halved(voxels, self.store, core))
    }
}

impl SliceFeed for HalvedSlices<'_> {
    fn next_slices(&mut self) -> Result<Vec<u8>, StoreError> {
        let mut slices = self.used.pop().unwrap_or_default();
        self.halve_layer(self.next_layer, &mut slices)?;
        self.next_layer += 1;
        Ok(slices)
    }

    fn give_back(&mut self, used: Vec<u8>) {
        self.used.push(used);
    }
}

/// Box averages over 2×2×2 voxels of a core, or those of them that exist; x fastest.
fn halved(voxels: &[u8], store: &StoreDesc, core: UVec3) -> Vec<u8> {
    fn average<T: Element>(voxels: &[u8], store: &StoreDesc, core: UVec3) -> Vec<u8> {
        let (edge, halo) = (store.layout.edge as usize, store.layout.halo as usize);
        let [width, height, depth] = core.to_array().map(|n| n as usize);
        let row = |z: usize, y: usize| {
            &voxels[(((z + halo) * edge + y + halo) * edge + halo) * T::BYTES..][..width * T::BYTES]
        };
        let mut out = vec![0; width.div_ceil(2) * height.div_ceil(2) * depth.div_ceil(2) * T::BYTES];
        let mut out_rows = out.chunks_exact_mut(width.div_ceil(2) * T::BYTES);
        let mut sums = vec![T::Sum::default(); width.div_ceil(2)];
        for z in (0..depth).step_by(2) {
            for y in (0..height).step_by(2) {
                sums.fill(T::Sum::default());
                let (ys, zs) = (y..(y + 2).min(height), z..(z + 2).min(depth));
                for row in zs.clone().flat_map(|z| ys.clone().map(move |y| row(z, y))) {
                    let pairs = row.chunks_exact(2 * T::BYTES);
                    let last = pairs.remainder();
                    for (sum, pair) in sums.iter_mut().zip(pairs) {
                        let (first, second) = pair.split_at(T::BYTES);
                        *sum += T::read(first).to_sum() + T::read(second).to_sum();
                    }
                    if let (Some(sum), false) = (sums.last_mut(), last.is_empty()) {
                        *sum += T::read(last).to_sum();
                    }
                }
                let rows = (ys.len() * zs.len()) as u32;
                let out_row = out_rows.next().expect("there is a row for each pair of rows");
                let mut out_voxels = out_row.chunks_exact_mut(T::BYTES);
                for (sum, out) in sums[..width / 2].iter().zip(&mut out_voxels) {
                    T::mean(*sum, 2 * rows).write(out);
                }
                for (sum, out) in sums[width / 2..].iter().zip(&mut out_voxels) {
                    T::mean(*sum, rows).write(out);
                }
            }
        }
        out
    }
    with_element!(store.volume.stored_type, average(voxels, store, core))
}

/// Turns little-endian voxels into this machine's.
fn swap_to_native(voxels: &mut [u8], stored_type: StoredType) {
    if cfg!(target_endian = "big") {
        voxels.chunks_exact_mut(stored_type.bytes()).for_each(<[u8]>::reverse);
    }
}
