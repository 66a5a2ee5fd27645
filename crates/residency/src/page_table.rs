use std::ops::Range;

use glassbrick_volume::{BrickGrid, BrickId};

use crate::{Load, SlotId, WorkingSet};

/// Added to the entry of a brick that is not in the plan, which is its distance from the nearest one that is, in bricks
/// along the farthest axis (Chebyshev): rays leap so far at once.
pub const NOT_PLANNED: u32 = 1 << 31;

/// The entry of a brick that is planned and not resident.
pub const MISSING: u32 = u32::MAX;

/// Distances beyond this are not told apart.
const FARTHEST: u32 = 1 << 20;

/// Where a shader finds the bricks of a level: one entry for each brick of the grid, by its place there. The entry of
/// a planned brick that is resident is the number of its slot.
#[derive(Clone, Debug)]
pub struct PageTable {
    level: u32,
    grid: BrickGrid,
    entries: Vec<u32>,
    dirty: Range<usize>,
}

impl PageTable {
    /// The table of a plan: `planned` are places in `grid`, which is the grid of `level`.
    pub fn new(
        level: u32,
        grid: BrickGrid,
        planned: impl IntoIterator<Item = u32>,
        set: &WorkingSet,
    ) -> Self {
        let entries = vec![NOT_PLANNED + FARTHEST; grid.len()];
        let mut table = Self { level, grid, entries, dirty: 0..0 };
        table.plan(planned, set);
        table.dirty = 0..table.entries.len();
        table
    }

    /// Takes another plan of the same level, and each brick's place as the set has it.
    pub fn plan(&mut self, planned: impl IntoIterator<Item = u32>, set: &WorkingSet) {
        let before = std::mem::take(&mut self.entries);
        self.entries = vec![NOT_PLANNED + FARTHEST; self.grid.len()];
        for index in planned.into_iter().map(|index| index as usize) {
            let brick = BrickId::new(self.level, self.grid.brick(index));
            self.entries[index] = set.slot_of(brick).map_or(MISSING, |slot| slot.0);
        }
        spread(&mut self.entries, self.grid.counts.as_usizevec3().to_array());
        let differs = |&index: &usize| before[index] != self.entries[index];
        let first = (0..before.len()).find(differs);
        let last = (0..before.len()).rev().find(differs);
        if let (Some(first), Some(last)) = (first, last) {
            self.touch(first..last + 1);
        }
    }

    /// Follows a round's loads and evictions.
    pub fn follow(&mut self, loads: &[Load]) {
        for load in loads {
            if let Some(evicted) = load.evicted {
                self.set_missing(evicted);
            }
            self.set_resident(load.brick, load.slot);
        }
    }

    /// A brick is in a slot. Nothing happens where it is not planned.
    pub fn set_resident(&mut self, brick: BrickId, slot: SlotId) {
        self.set(brick, slot.0);
    }

    /// A brick is in no slot any more. Nothing happens where it is not planned.
    pub fn set_missing(&mut self, brick: BrickId) {
        self.set(brick, MISSING);
    }

    /// A brick is not drawn after all.
    pub fn leave_out(&mut self, brick: BrickId) {
        self.set(brick, NOT_PLANNED + 1);
    }

    /// All entries, as they are uploaded.
    pub fn entries(&self) -> &[u32] {
        &self.entries
    }

    /// The entries that may have changed since this was asked last; all of a table that was not asked before.
    pub fn take_dirty(&mut self) -> Option<Range<usize>> {
        let dirty = std::mem::take(&mut self.dirty);
        (!dirty.is_empty()).then_some(dirty)
    }

    fn set(&mut self, brick: BrickId, entry: u32) {
        if brick.level != self.level || brick.place().cmpge(self.grid.counts).any() {
            return;
        }
        let index = self.grid.index(brick.place());
        let before = self.entries[index];
        if !is_not_planned(before) && before != entry {
            self.entries[index] = entry;
            self.touch(index..index + 1);
        }
    }

    fn touch(&mut self, changed: Range<usize>) {
        self.dirty = if self.dirty.is_empty() {
            changed
        } else {
            self.dirty.start.min(changed.start)..self.dirty.end.max(changed.end)
        };
    }
}

fn is_not_planned(entry: u32) -> bool {
    entry >= NOT_PLANNED && entry != MISSING
}

/// Sets the distances of all bricks that are not planned: axis by axis, each brick takes the least distance of any in its
/// row, where one that is so many steps away is at least that far.
fn spread(entries: &mut [u32], counts: [usize; 3]) {
    let mut distances: Vec<u32> =
        entries.iter().map(|&entry| if is_not_planned(entry) { FARTHEST } else { 0 }).collect();
    let strides = [1, counts[0], counts[0] * counts[1]];
    for axis in 0..3 {
        for first in 0..distances.len() {
            if (first / strides[axis]).is_multiple_of(counts[axis]) {
                spread_row(&mut distances, first, strides[axis], counts[axis]);
            }
        }
    }
    for (entry, distance) in entries.iter_mut().zip(distances) {
        if is_not_planned(*entry) {
            *entry = NOT_PLANNED + distance;
        }
    }
}

fn spread_row(distances: &mut [u32], first: usize, stride: usize, count: usize) {
    let row: Vec<u32> = (0..count).map(|place| distances[first + place * stride]).collect();
    for place in 0..count {
        let at = |other: usize| row[other].max(place.abs_diff(other) as u32);
        let mut nearest = row[place];
        // No brick that is farther away than the nearest found can be nearer.
        for apart in 1..count {
            if apart as u32 >= nearest {
                break;
            }
            if place >= apart {
                nearest = nearest.min(at(place - apart));
            }
            if place + apart < count {
                nearest = nearest.min(at(place + apart));
            }
        }
        distances[first + place * stride] = nearest;
    }
}
