use std::collections::VecDeque;

use glassbrick_volume::{BrickGrid, VolumeDesc};

use crate::StoreError;
use crate::brick_cut::Slices;

/// Gives the slices of a volume from the first on, a few at a time.
pub trait SliceFeed {
    /// The next slices: whole ones, at least one, in this machine's byte order.
    ///
    /// # Errors
    /// When they cannot be read.
    fn next_slices(&mut self) -> Result<Vec<u8>, StoreError>;

    /// Takes back memory that is free to be filled again.
    fn give_back(&mut self, used: Vec<u8>);
}

/// The slices of a volume that a layer of bricks is cut from: as many as a brick has along z, and what the feed gave
/// with them.
pub struct SliceWindow {
    grid: BrickGrid,
    slice_bytes: usize,
    /// Runs of slices that follow each other, each with its first one.
    runs: VecDeque<(u32, Vec<u8>)>,
    /// One past the last slice that is at hand.
    end: u32,
}

impl SliceWindow {
    /// An empty window at the begin of a level.
    pub fn new(level: &VolumeDesc, grid: &BrickGrid) -> Self {
        Self { grid: *grid, slice_bytes: level.slice_bytes() as usize, runs: VecDeque::new(), end: 0 }
    }

    /// Moves on to the slices of a layer of bricks, halo included; takes those that are missing. A run that is resumed
    /// passes over what it has stored.
    ///
    /// # Errors
    /// When slices cannot be read.
    pub fn advance_to(&mut self, layer: u32, feed: &mut dyn SliceFeed) -> Result<(), StoreError> {
        let layout = self.grid.layout;
        let start = (layer * layout.core()).saturating_sub(layout.halo);
        let end = ((layer + 1) * layout.core() + layout.halo).min(self.grid.extent.z);
        self.drop_before(start, feed);
        while self.end < end {
            let slices = feed.next_slices()?;
            let first = self.end;
            self.end += (slices.len() / self.slice_bytes) as u32;
            self.runs.push_back((first, slices));
            self.drop_before(start, feed);
        }
        Ok(())
    }

    /// Lets go of runs that end before a slice.
    fn drop_before(&mut self, start: u32, feed: &mut dyn SliceFeed) {
        let is_done =
            |(first, slices): &mut (u32, Vec<u8>)| *first + (slices.len() / self.slice_bytes) as u32 <= start;
        while let Some((_, used)) = self.runs.pop_front_if(is_done) {
            feed.give_back(used);
        }
    }
}

impl Slices for SliceWindow {
    fn slice(&self, z: u32) -> &[u8] {
        let run = self.runs.partition_point(|(first, _)| *first <= z) - 1;
        let (first, slices) = &self.runs[run];
        &slices[(z - first) as usize * self.slice_bytes..][..self.slice_bytes]
    }
}
