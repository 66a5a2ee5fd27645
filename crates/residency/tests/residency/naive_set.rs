//! A working set that is plain to see through: a row of slots, looked through from end to end.

use std::collections::BTreeSet;

use glassbrick_volume::BrickId;

#[derive(Clone, Copy)]
struct Entry {
    brick: BrickId,
    used: usize,
    drawn: bool,
    held: bool,
}

/// Slot, and the brick that had to go.
pub type Place = (usize, Option<BrickId>);

pub struct NaiveSet {
    slots: Vec<Option<Entry>>,
    pins: Vec<BrickId>,
    uses: usize,
}

impl NaiveSet {
    pub fn new(slots: usize) -> Self {
        Self { slots: vec![None; slots], pins: Vec::new(), uses: 0 }
    }

    pub fn slots(&self) -> usize {
        self.slots.len()
    }

    pub fn slot_of(&self, brick: BrickId) -> Option<usize> {
        self.slots.iter().position(|entry| entry.is_some_and(|entry| entry.brick == brick))
    }

    pub fn residents(&self) -> Vec<BrickId> {
        self.slots.iter().flatten().map(|entry| entry.brick).collect()
    }

    /// The resident ones of those that are pinned.
    pub fn pinned(&self) -> Vec<BrickId> {
        self.pins.iter().copied().filter(|&brick| self.slot_of(brick).is_some()).collect()
    }

    pub fn held(&self) -> Vec<BrickId> {
        self.slots.iter().flatten().filter(|entry| entry.held).map(|entry| entry.brick).collect()
    }

    pub fn missing_pinned(&self) -> Vec<BrickId> {
        self.pins.iter().copied().filter(|&brick| self.slot_of(brick).is_none()).collect()
    }

    fn entry(&mut self, brick: BrickId) -> Option<&mut Entry> {
        self.slots.iter_mut().flatten().find(|entry| entry.brick == brick)
    }

    pub fn begin_frame(&mut self) {
        self.slots.iter_mut().flatten().for_each(|entry| entry.drawn = false);
    }

    pub fn set_drawn(&mut self, brick: BrickId) {
        if let Some(entry) = self.entry(brick) {
            entry.drawn = true;
        }
    }

    pub fn hold(&mut self, brick: BrickId) -> Option<usize> {
        let slot = self.slot_of(brick)?;
        self.uses += 1;
        self.slots[slot] = Some(Entry { brick, used: self.uses, drawn: false, held: true });
        Some(slot)
    }

    pub fn admit(&mut self, brick: BrickId) -> Option<Place> {
        if let Some(slot) = self.hold(brick) {
            return Some((slot, None));
        }
        let free = self.slots.iter().position(Option::is_none);
        let slot = free.or_else(|| {
            let may_go = |slot: &usize| {
                !self.slots[*slot].is_some_and(|entry| entry.held || self.pins.contains(&entry.brick))
            };
            (0..self.slots.len())
                .filter(may_go)
                .min_by_key(|&slot| self.slots[slot].map(|entry| (!entry.drawn, entry.used)))
        })?;
        let evicted = self.slots[slot].map(|entry| entry.brick);
        self.uses += 1;
        self.slots[slot] = Some(Entry { brick, used: self.uses, drawn: false, held: true });
        Some((slot, evicted))
    }

    pub fn end_round(&mut self) {
        self.slots.iter_mut().flatten().for_each(|entry| entry.held = false);
    }

    pub fn remove(&mut self, brick: BrickId) -> Option<usize> {
        let slot = self.slot_of(brick)?;
        self.slots[slot] = None;
        Some(slot)
    }

    pub fn clear(&mut self) {
        self.slots.fill(None);
    }

    pub fn limit(&mut self, slots: usize) -> Vec<BrickId> {
        let before = self.residents();
        self.slots.truncate(slots);
        self.pins.truncate(self.slots.len() / 2);
        before.into_iter().filter(|&brick| self.slot_of(brick).is_none()).collect()
    }

    pub fn set_pinned(&mut self, bricks: &[BrickId]) -> usize {
        self.pins = bricks.iter().copied().take(self.slots.len() / 2).collect();
        self.pins.len()
    }

    /// The longest beginning of `wanted` that finds room beside the pinned bricks, and what is loaded for it.
    pub fn next_round(&mut self, wanted: &[BrickId], most_loads: usize) -> (usize, Vec<(BrickId, Place)>) {
        self.end_round();
        let pinned = self.pinned();
        let fits = |taken: &usize| {
            let taken = &wanted[..*taken];
            let there: BTreeSet<&BrickId> = taken.iter().chain(&pinned).collect();
            let loads = taken.iter().filter(|&&brick| self.slot_of(brick).is_none()).count();
            there.len() <= self.slots.len() && loads <= most_loads.max(1)
        };
        let taken = (0..=wanted.len()).rev().find(fits).expect("nothing at all fits");
        let missing: Vec<BrickId> =
            wanted[..taken].iter().copied().filter(|&brick| self.hold(brick).is_none()).collect();
        let admit = |brick| (brick, self.admit(brick).expect("it fits"));
        (taken, missing.into_iter().map(admit).collect())
    }
}
