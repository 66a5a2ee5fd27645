use std::collections::BTreeSet;

/// How many slots there can be: the numbers above name no slot in a page table.
pub const MOST_SLOTS: u32 = 1 << 31;

/// A place for one brick. Slots are numbered from 0 on, atlas by atlas.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SlotId(pub u32);

impl SlotId {
    /// The slot's place in tables.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// The slots that hold no brick. The lowest is given first, so that atlases are needed one after the other.
#[derive(Clone, Debug)]
pub struct FreeSlots {
    slots: u32,
    /// Slots from here on were never given.
    unused: u32,
    /// Slots below that were given and came back.
    returned: BTreeSet<SlotId>,
}

impl FreeSlots {
    /// All of `slots` slots, or of as many as there can be.
    pub fn new(slots: u32) -> Self {
        Self { slots: slots.min(MOST_SLOTS), unused: 0, returned: BTreeSet::new() }
    }

    /// How many slots there are, free or not.
    pub fn slots(&self) -> u32 {
        self.slots
    }

    /// How many are free.
    pub fn free(&self) -> usize {
        (self.slots - self.unused) as usize + self.returned.len()
    }

    /// The lowest free slot, which is then not free.
    pub fn give(&mut self) -> Option<SlotId> {
        self.returned.pop_first().or_else(|| {
            let slot = SlotId(self.unused);
            (self.unused < self.slots).then(|| {
                self.unused += 1;
                slot
            })
        })
    }

    /// Makes a slot free that was given.
    pub fn take_back(&mut self, slot: SlotId) {
        let was_given = slot.0 < self.unused && self.returned.insert(slot);
        debug_assert!(was_given, "{slot:?} was free");
    }

    /// Leaves out the slots from `slots` on; none of them is given.
    pub fn limit(&mut self, slots: u32) {
        self.slots = self.slots.min(slots);
        self.unused = self.unused.min(slots);
        self.returned.split_off(&SlotId(slots));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_free_slot_is_given_first() {
        let mut free = FreeSlots::new(4);
        let given: Vec<u32> = (0..3).filter_map(|_| free.give()).map(|slot| slot.0).collect();
        assert_eq!(given, [0, 1, 2]);
        free.take_back(SlotId(2));
        free.take_back(SlotId(0));
        assert_eq!(free.free(), 3);
        let given: Vec<u32> = std::iter::from_fn(|| free.give()).map(|slot| slot.0).collect();
        assert_eq!(given, [0, 2, 3]);
    }

    #[test]
    fn slots_beyond_a_limit_are_not_given() {
        let mut free = FreeSlots::new(10);
        (0..5).for_each(|slot| assert_eq!(free.give(), Some(SlotId(slot))));
        (1..5).rev().for_each(|slot| free.take_back(SlotId(slot)));
        free.limit(3);
        assert_eq!((free.slots(), free.free()), (3, 2));
        assert_eq!([free.give(), free.give(), free.give()], [Some(SlotId(1)), Some(SlotId(2)), None]);
    }

    #[test]
    fn no_slot_has_the_number_of_something_else() {
        assert_eq!(FreeSlots::new(u32::MAX).slots(), MOST_SLOTS);
        assert_eq!(SlotId(MOST_SLOTS - 1).0 + 1, crate::NOT_PLANNED);
    }
}
