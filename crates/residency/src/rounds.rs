use glassbrick_volume::BrickId;

use crate::{SlotId, WorkingSet};

/// A part of a frame that is drawn at one go.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Round {
    /// How many of the wanted bricks it draws, from the first on.
    pub taken: usize,
    /// Those of them that must be loaded first, in the order of the plan.
    pub loads: Vec<Load>,
}

/// A brick that is to be loaded into a slot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Load {
    pub brick: BrickId,
    pub slot: SlotId,
    /// The brick that was there, and is not resident any more.
    pub evicted: Option<BrickId>,
}

/// Plans the next round of a frame, which ends the round before it: as many of the wanted bricks (each named once) as
/// the slots hold at once and `most_loads` loads allow, from the first on, and at least one if any slot is not pinned.
/// They are held until the round ends.
///
/// Bricks of the round that are resident stay: none is let go for another one of the same round.
pub fn next_round(set: &mut WorkingSet, wanted: &[BrickId], most_loads: usize) -> Round {
    set.end_round();
    let mut taken = 0;
    let mut missing = Vec::new();
    for &brick in wanted {
        let is_load = set.slot_of(brick).is_none();
        // A resident brick that might have gone for one that is loaded takes its place as well.
        let is_full = missing.len() == set.admissible() && (is_load || set.may_go(brick));
        if is_full || is_load && missing.len() == most_loads.max(1) {
            break;
        }
        if set.hold(brick).is_none() {
            missing.push(brick);
        }
        taken += 1;
    }
    let load = |brick| {
        let admitted = set.admit(brick).expect("there was room for each of them");
        Load { brick, slot: admitted.slot, evicted: admitted.evicted }
    };
    Round { taken, loads: missing.into_iter().map(load).collect() }
}
