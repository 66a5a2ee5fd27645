use glassbrick_volume::BrickId;

use crate::SlotId;
use crate::pins::Pins;
use crate::residents::{Resident, Residents};

/// Which brick is in which slot.
///
/// A brick counts as resident from its admission on, though its voxels come later: whoever draws waits for them, and
/// removes the brick if they do not come. A free slot is preferred to an eviction. Those who may go do so in this
/// order: bricks drawn in this frame, then the others, the least recently used first. A pinned brick never goes, nor
/// one that is held for the round under way.
///
/// Each operation on one brick takes O(log slots); those on a frame, a round or the pins take that for each brick
/// drawn, held or pinned.
#[derive(Clone, Debug)]
pub struct WorkingSet {
    residents: Residents,
    /// Slots of bricks that were held since the round began; a brick may have left since.
    held: Vec<SlotId>,
    pins: Pins,
    /// Ticks at each use.
    clock: u64,
    peak: usize,
    counts: WorkingSetCounts,
}

/// What happened in a working set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WorkingSetCounts {
    /// Bricks that were asked for and resident.
    pub hits: u64,
    /// Bricks that were admitted, prefetched ones too.
    pub misses: u64,
    /// Bricks that had to go for another one.
    pub evictions: u64,
}

/// Where a brick goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Admitted {
    pub slot: SlotId,
    /// The brick that had to go for it.
    pub evicted: Option<BrickId>,
}

impl WorkingSet {
    /// No brick in any of `slots` slots, of which there are [`MOST_SLOTS`](crate::MOST_SLOTS) at most.
    pub fn new(slots: u32) -> Self {
        Self {
            residents: Residents::new(slots),
            held: Vec::new(),
            pins: Pins::default(),
            clock: 0,
            peak: 0,
            counts: WorkingSetCounts::default(),
        }
    }

    /// How many slots there are.
    pub fn slots(&self) -> u32 {
        self.residents.slots()
    }

    /// Where a brick is.
    pub fn slot_of(&self, brick: BrickId) -> Option<SlotId> {
        self.residents.slot_of(brick)
    }

    /// The resident bricks, by slot.
    pub fn residents(&self) -> impl Iterator<Item = (SlotId, BrickId)> {
        self.residents.iter()
    }

    /// How many bricks are resident.
    pub fn resident(&self) -> usize {
        self.residents.len()
    }

    /// How many bricks were resident at once, at most.
    pub fn peak(&self) -> usize {
        self.peak
    }

    /// How many bricks could be admitted, one after the other.
    pub fn admissible(&self) -> usize {
        self.residents.admissible()
    }

    /// Whether a brick is resident and might have to go for another one.
    pub fn may_go(&self, brick: BrickId) -> bool {
        let resident = self.slot_of(brick).and_then(|slot| self.residents.in_slot(slot));
        resident.is_some_and(Resident::may_go)
    }

    /// What happened since this was asked last.
    pub fn take_counts(&mut self) -> WorkingSetCounts {
        std::mem::take(&mut self.counts)
    }

    /// A frame begins: none of its bricks is drawn yet.
    pub fn begin_frame(&mut self) {
        self.residents.begin_frame();
    }

    /// The brick's layer is drawn; this frame does not need it any more, unless it is held again.
    pub fn set_drawn(&mut self, brick: BrickId) {
        if let Some(slot) = self.slot_of(brick) {
            let frame = self.residents.frame();
            self.residents.edit(slot, |resident| resident.drawn_in = frame);
        }
    }

    /// Uses a brick that is resident: it stays until the round ends. None where it is not.
    pub fn hold(&mut self, brick: BrickId) -> Option<SlotId> {
        let slot = self.hold_again(brick)?;
        self.counts.hits += 1;
        Some(slot)
    }

    /// As [`WorkingSet::hold`], of a brick whose use was counted before.
    pub fn hold_again(&mut self, brick: BrickId) -> Option<SlotId> {
        let slot = self.slot_of(brick)?;
        let used = self.tick();
        let hold =
            |resident: &mut Resident| *resident = Resident { used, drawn_in: 0, held: true, ..*resident };
        self.residents.edit(slot, hold);
        self.held.push(slot);
        Some(slot)
    }

    /// Gives a brick a slot and holds it until the round ends; a brick that is resident is held in the slot that it
    /// has. None where every slot's brick is pinned or held.
    pub fn admit(&mut self, brick: BrickId) -> Option<Admitted> {
        if let Some(slot) = self.hold(brick) {
            return Some(Admitted { slot, evicted: None });
        }
        let (used, pinned) = (self.tick(), self.pins.contains(brick));
        let admitted = self.residents.place(Resident { brick, used, drawn_in: 0, held: true, pinned })?;
        self.held.push(admitted.slot);
        self.peak = self.peak.max(self.resident());
        self.counts.misses += 1;
        self.counts.evictions += u64::from(admitted.evicted.is_some());
        Some(admitted)
    }

    /// The round is over: no brick is held.
    pub fn end_round(&mut self) {
        for slot in std::mem::take(&mut self.held) {
            if self.residents.in_slot(slot).is_some() {
                self.residents.edit(slot, |resident| resident.held = false);
            }
        }
    }

    /// Lets a brick go whose voxels did not come, held or not, and tells which slot it had. A pinned brick stays
    /// wanted.
    pub fn remove(&mut self, brick: BrickId) -> Option<SlotId> {
        let slot = self.slot_of(brick)?;
        self.residents.vacate(slot);
        Some(slot)
    }

    /// Lets all bricks go. Pins stay wanted.
    pub fn clear(&mut self) {
        let bricks: Vec<BrickId> = self.residents().map(|(_, brick)| brick).collect();
        for brick in bricks {
            self.remove(brick);
        }
    }

    /// Leaves only the first `slots` slots, as a device does that cannot make more, and tells which bricks had to go,
    /// held and pinned ones too. Pins for which half the slots are too few are dropped.
    pub fn limit(&mut self, slots: u32) -> Vec<BrickId> {
        let gone = self.residents.limit(slots);
        let pins: Vec<BrickId> = self.pins.iter().collect();
        self.set_pinned(&pins);
        gone
    }

    /// Pins these bricks instead of those before, the first ones first, and tells how many. Half the slots stay
    /// unpinned, so that every other brick can be drawn. A pin keeps a brick in its slot; it does not keep a slot
    /// free for a brick.
    pub fn set_pinned(&mut self, bricks: &[BrickId]) -> usize {
        for brick in self.pins.replace(bricks, self.slots() as usize / 2) {
            if let Some(slot) = self.slot_of(brick) {
                let pinned = self.pins.contains(brick);
                self.residents.edit(slot, |resident| resident.pinned = pinned);
            }
        }
        self.pins.len()
    }

    /// The pinned bricks that are not resident, in the order in which they were pinned.
    pub fn missing_pinned(&self) -> impl Iterator<Item = BrickId> {
        self.pins.iter().filter(|&brick| self.slot_of(brick).is_none())
    }

    fn tick(&mut self) -> u64 {
        self.clock += 1;
        self.clock
    }
}
