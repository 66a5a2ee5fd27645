//! Whatever is done, working set, rounds and page table do what the plain set does.

use std::collections::BTreeSet;

use glassbrick_residency::{MISSING, NOT_PLANNED, PageTable, WorkingSet, next_round};
use glassbrick_volume::BrickId;
use proptest::prelude::*;

use crate::any::{Deed, all_bricks, deed, grid, plan};
use crate::naive_set::{NaiveSet, Place};

/// The same, done twice.
struct Both {
    set: WorkingSet,
    table: PageTable,
    naive: NaiveSet,
    planned: Vec<u32>,
    /// The table as it is on a device, to which only what is dirty is brought.
    uploaded: Vec<u32>,
    evictions: u64,
}

impl Both {
    fn new(slots: u32, planned: Vec<u32>) -> Self {
        let set = WorkingSet::new(slots);
        let table = PageTable::new(0, grid(), planned.iter().copied(), &set);
        let uploaded = vec![0; grid().len()];
        Self { set, table, naive: NaiveSet::new(slots as usize), planned, uploaded, evictions: 0 }
    }

    fn act(&mut self, deed: Deed) {
        let may_end_a_round = matches!(deed, Deed::EndRound | Deed::Round(..) | Deed::Frame(..));
        let takes_away = matches!(deed, Deed::Remove(_) | Deed::Clear | Deed::Limit(_));
        let stay = match (takes_away, may_end_a_round) {
            (true, _) => Vec::new(),
            (false, true) => self.naive.pinned(),
            (false, false) => [self.naive.pinned(), self.naive.held()].concat(),
        };
        match deed {
            Deed::BeginFrame => {
                self.set.begin_frame();
                self.naive.begin_frame();
            }
            Deed::SetDrawn(brick) => self.set_drawn(brick),
            Deed::Hold(brick) => {
                let slot = self.set.hold(brick).map(|slot| slot.index());
                assert_eq!(slot, self.naive.hold(brick));
            }
            Deed::Admit(brick) => {
                let admitted = self.set.admit(brick);
                let place = admitted.map(|admitted| (admitted.slot.index(), admitted.evicted));
                assert_eq!(place, self.naive.admit(brick));
                if let Some(admitted) = admitted {
                    self.evictions += u64::from(admitted.evicted.is_some());
                    admitted.evicted.into_iter().for_each(|evicted| self.table.set_missing(evicted));
                    self.table.set_resident(brick, admitted.slot);
                }
            }
            Deed::EndRound => {
                self.set.end_round();
                self.naive.end_round();
            }
            Deed::Remove(brick) => {
                let slot = self.set.remove(brick).map(|slot| slot.index());
                assert_eq!(slot, self.naive.remove(brick));
                self.table.set_missing(brick);
            }
            Deed::Clear => {
                self.set.clear();
                self.naive.clear();
                self.table.plan(self.planned.iter().copied(), &self.set);
            }
            Deed::Limit(slots) => {
                let gone = self.set.limit(slots);
                assert_eq!(gone, self.naive.limit(slots as usize));
                gone.into_iter().for_each(|brick| self.table.set_missing(brick));
            }
            Deed::Pin(bricks) => assert_eq!(self.set.set_pinned(&bricks), self.naive.set_pinned(&bricks)),
            Deed::Plan(planned) => {
                self.table.plan(planned.iter().copied(), &self.set);
                self.planned = planned;
            }
            Deed::Round(wanted, most_loads) => {
                self.round(&wanted, most_loads);
            }
            Deed::Frame(wanted, most_loads) => self.frame(&wanted, most_loads),
        }
        assert!(stay.iter().all(|&brick| self.set.slot_of(brick).is_some()), "no pinned or held brick goes");
    }

    fn set_drawn(&mut self, brick: BrickId) {
        self.set.set_drawn(brick);
        self.naive.set_drawn(brick);
    }

    fn round(&mut self, wanted: &[BrickId], most_loads: usize) -> usize {
        let round = next_round(&mut self.set, wanted, most_loads);
        self.table.follow(&round.loads);
        let place = |load: &glassbrick_residency::Load| (load.brick, (load.slot.index(), load.evicted));
        let loads: Vec<(BrickId, Place)> = round.loads.iter().map(place).collect();
        assert_eq!((round.taken, loads), self.naive.next_round(wanted, most_loads));
        self.evictions += round.loads.iter().filter(|load| load.evicted.is_some()).count() as u64;
        let slots: BTreeSet<u32> =
            wanted[..round.taken].iter().map(|&brick| self.set.slot_of(brick).expect("taken").0).collect();
        assert_eq!(slots.len(), round.taken, "all that is drawn at once has a slot of its own");
        round.taken
    }

    fn frame(&mut self, wanted: &[BrickId], most_loads: usize) {
        self.act(Deed::BeginFrame);
        let mut left = wanted;
        while !left.is_empty() && self.set.slots() > 0 {
            let taken = self.round(left, most_loads);
            assert!(taken > 0, "each round draws something, so that every brick is drawn in the end");
            left[..taken].iter().for_each(|&brick| self.set_drawn(brick));
            self.check();
            left = &left[taken..];
        }
    }

    fn check(&mut self) {
        let residents: Vec<(usize, BrickId)> =
            self.set.residents().map(|(slot, brick)| (slot.index(), brick)).collect();
        let bricks: BTreeSet<BrickId> = residents.iter().map(|&(_, brick)| brick).collect();
        assert_eq!(bricks.len(), residents.len(), "no brick is in two slots");
        assert!(residents.iter().all(|&(slot, _)| slot < self.set.slots() as usize));
        assert_eq!(self.set.slots() as usize, self.naive.slots());
        for brick in all_bricks() {
            assert_eq!(self.set.slot_of(brick).map(|slot| slot.index()), self.naive.slot_of(brick));
            assert_eq!(bricks.contains(&brick), self.set.slot_of(brick).is_some());
        }
        assert_eq!(self.set.resident(), residents.len());
        let safe: BTreeSet<BrickId> = self.naive.pinned().into_iter().chain(self.naive.held()).collect();
        assert_eq!(self.set.admissible(), self.naive.slots() - safe.len());
        assert!(bricks.iter().all(|&brick| self.set.may_go(brick) != safe.contains(&brick)));
        assert_eq!(self.set.missing_pinned().collect::<Vec<_>>(), self.naive.missing_pinned());
        let mut entries: Vec<u32> = (0..grid().len()).map(|index| self.distance(index)).collect();
        for &index in &self.planned {
            let slot = self.naive.slot_of(BrickId::new(0, grid().brick(index as usize)));
            entries[index as usize] = slot.map_or(MISSING, |slot| slot as u32);
        }
        assert_eq!(self.table.entries(), entries);
        if let Some(dirty) = self.table.take_dirty() {
            self.uploaded[dirty.clone()].copy_from_slice(&self.table.entries()[dirty]);
        }
        assert_eq!(self.uploaded, entries, "what is dirty is all that changed");
    }

    /// The entry of a brick that is not planned: its distance from the nearest one that is.
    fn distance(&self, index: usize) -> u32 {
        let at = |index: usize| grid().brick(index).as_ivec3();
        let apart = |&planned: &u32| (at(planned as usize) - at(index)).abs().max_element() as u32;
        NOT_PLANNED + self.planned.iter().map(apart).min().unwrap_or(1 << 20)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_is_done_the_working_set_is_what_a_plain_one_is(
        slots in prop_oneof![Just(1u32), 0..20u32],
        planned in plan(),
        deeds in proptest::collection::vec(deed(), 0..60),
    ) {
        let mut both = Both::new(slots, planned);
        both.check();
        for deed in deeds {
            both.act(deed);
            both.check();
        }
        prop_assert_eq!(both.set.take_counts().evictions, both.evictions);
        prop_assert!(both.set.peak() <= slots as usize);
    }

    #[test]
    fn rounds_depend_on_nothing_but_the_plan_and_the_slots(
        slots in 1..20u32,
        deeds in proptest::collection::vec(deed(), 0..20),
    ) {
        let [mut one, mut other] = [(); 2].map(|()| Both::new(slots, Vec::new()));
        deeds.iter().for_each(|deed| one.act(deed.clone()));
        deeds.iter().for_each(|deed| other.act(deed.clone()));
        let wanted = all_bricks();
        prop_assert_eq!(next_round(&mut one.set, &wanted, 5), next_round(&mut other.set, &wanted, 5));
    }
}
