use std::collections::HashMap;

use glassbrick_volume::BrickId;

use crate::eviction_order::{EvictionOrder, Turn};
use crate::slots::FreeSlots;
use crate::{Admitted, SlotId};

/// A brick in a slot.
#[derive(Clone, Copy, Debug)]
pub struct Resident {
    pub brick: BrickId,
    /// When it was last used.
    pub used: u64,
    /// The frame that it was last drawn in; 0 is none.
    pub drawn_in: u64,
    pub held: bool,
    pub pinned: bool,
}

impl Resident {
    /// Whether it might have to go for another brick.
    pub fn may_go(&self) -> bool {
        !self.held && !self.pinned
    }

    fn turn(&self, frame: u64) -> Turn {
        Turn { undrawn: self.drawn_in != frame, used: self.used }
    }
}

/// The bricks in slots, by slot and by brick; of those that may go it is known whose turn it is.
#[derive(Clone, Debug)]
pub struct Residents {
    free: FreeSlots,
    /// As far as slots were given.
    by_slot: Vec<Option<Resident>>,
    slot_of: HashMap<BrickId, SlotId>,
    evictable: EvictionOrder,
    frame: u64,
}

impl Residents {
    /// No brick in any of `slots` slots.
    pub fn new(slots: u32) -> Self {
        Self {
            free: FreeSlots::new(slots),
            by_slot: Vec::new(),
            slot_of: HashMap::new(),
            evictable: EvictionOrder::default(),
            frame: 1,
        }
    }

    /// How many slots there are.
    pub fn slots(&self) -> u32 {
        self.free.slots()
    }

    /// How many bricks there are.
    pub fn len(&self) -> usize {
        self.slot_of.len()
    }

    /// How many slots are free, or their bricks may go.
    pub fn admissible(&self) -> usize {
        self.free.free() + self.evictable.len()
    }

    /// Where a brick is.
    pub fn slot_of(&self, brick: BrickId) -> Option<SlotId> {
        self.slot_of.get(&brick).copied()
    }

    /// What is in a slot.
    pub fn in_slot(&self, slot: SlotId) -> Option<&Resident> {
        self.by_slot.get(slot.index())?.as_ref()
    }

    /// All of them, by slot.
    pub fn iter(&self) -> impl Iterator<Item = (SlotId, BrickId)> {
        let by_slot = (0..).zip(&self.by_slot);
        by_slot.filter_map(|(slot, resident)| resident.map(|resident| (SlotId(slot), resident.brick)))
    }

    /// The frame under way.
    pub fn frame(&self) -> u64 {
        self.frame
    }

    /// Goes on to the next frame, in which no brick is drawn yet.
    pub fn begin_frame(&mut self) {
        self.frame += 1;
        self.evictable.begin_frame();
    }

    /// Puts a brick that is in no slot into the lowest free one, or in the place of the brick whose turn it is to go.
    pub fn place(&mut self, resident: Resident) -> Option<Admitted> {
        let evicted = match self.free.free() {
            0 => Some(self.vacate(self.evictable.first()?)),
            _ => None,
        };
        let slot = self.free.give()?;
        if self.by_slot.len() <= slot.index() {
            self.by_slot.resize(slot.index() + 1, None);
        }
        self.by_slot[slot.index()] = Some(resident);
        self.slot_of.insert(resident.brick, slot);
        self.edit(slot, |_| ());
        Some(Admitted { slot, evicted })
    }

    /// Changes what is known of the brick in a slot, and with it whether and when it may go.
    pub fn edit(&mut self, slot: SlotId, change: impl FnOnce(&mut Resident)) {
        let resident = self.by_slot[slot.index()].as_mut().expect("a brick was found in this slot");
        self.evictable.remove(resident.turn(self.frame));
        change(resident);
        if resident.may_go() {
            self.evictable.insert(resident.turn(self.frame), slot);
        }
    }

    /// Takes the brick out of a slot.
    pub fn vacate(&mut self, slot: SlotId) -> BrickId {
        let resident = self.by_slot[slot.index()].take().expect("a brick was found in this slot");
        self.evictable.remove(resident.turn(self.frame));
        self.slot_of.remove(&resident.brick);
        self.free.take_back(slot);
        resident.brick
    }

    /// Leaves only the first `slots` slots, and tells which bricks had to go.
    pub fn limit(&mut self, slots: u32) -> Vec<BrickId> {
        let beyond: Vec<SlotId> = self.iter().map(|(slot, _)| slot).filter(|slot| slot.0 >= slots).collect();
        let gone = beyond.into_iter().map(|slot| self.vacate(slot)).collect();
        self.free.limit(slots);
        self.by_slot.truncate(slots as usize);
        gone
    }
}
