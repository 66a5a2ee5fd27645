use std::ops::Range;

use glassbrick_volume::{BrickGrid, BrickId};

use crate::{Load, SlotId, WorkingSet};

/// The entry of a brick that is not in the plan: rays leap over it.
pub const NOT_PLANNED: u32 = u32::MAX;

/// The entry of a brick that is planned and not resident.
pub const MISSING: u32 = u32::MAX - 1;

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
        let entries = vec![NOT_PLANNED; grid.len()];
        let mut table = Self { level, grid, entries, dirty: 0..0 };
        table.plan(planned, set);
        table.dirty = 0..table.entries.len();
        table
    }

    /// Takes another plan of the same level, and each brick's place as the set has it.
    pub fn plan(&mut self, planned: impl IntoIterator<Item = u32>, set: &WorkingSet) {
        let before = std::mem::replace(&mut self.entries, vec![NOT_PLANNED; self.grid.len()]);
        for index in planned.into_iter().map(|index| index as usize) {
            let brick = BrickId::new(self.level, self.grid.brick(index));
            self.entries[index] = set.slot_of(brick).map_or(MISSING, |slot| slot.0);
        }
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
        self.set(brick, NOT_PLANNED);
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
        if before != NOT_PLANNED && before != entry {
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
