use std::collections::BTreeMap;

use crate::SlotId;

/// When a brick has to go for another one: the smallest turn first.
///
/// A brick that was drawn in this frame is needed in the next one at the soonest; any other brick may still be met in
/// this one. So the drawn ones go first, and among either kind the least recently used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Turn {
    pub undrawn: bool,
    /// When the brick was last used; no two bricks are used at one time.
    pub used: u64,
}

/// The slots whose bricks may go, by whose turn it is.
#[derive(Clone, Debug, Default)]
pub struct EvictionOrder(BTreeMap<Turn, SlotId>);

impl EvictionOrder {
    /// How many bricks may go.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The slot whose brick goes next.
    pub fn first(&self) -> Option<SlotId> {
        self.0.first_key_value().map(|(_, &slot)| slot)
    }

    /// Lets the brick in a slot go when its turn comes.
    pub fn insert(&mut self, turn: Turn, slot: SlotId) {
        self.0.insert(turn, slot);
    }

    /// Does not let it go, if it might.
    pub fn remove(&mut self, turn: Turn) {
        self.0.remove(&turn);
    }

    /// No brick is drawn yet.
    pub fn begin_frame(&mut self) {
        let undrawn = self.0.split_off(&Turn { undrawn: true, used: 0 });
        let drawn = std::mem::replace(&mut self.0, undrawn);
        self.0.extend(drawn.into_iter().map(|(turn, slot)| (Turn { undrawn: true, ..turn }, slot)));
    }
}
