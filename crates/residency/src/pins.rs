use std::collections::HashSet;

use glassbrick_volume::BrickId;

/// The bricks that are to stay once they are resident, in the order in which they are wanted.
#[derive(Clone, Debug, Default)]
pub struct Pins {
    order: Vec<BrickId>,
    pinned: HashSet<BrickId>,
}

impl Pins {
    /// Pins the first `most` of these bricks instead of those before, and tells of which bricks that changed anything.
    pub fn replace(&mut self, bricks: &[BrickId], most: usize) -> Vec<BrickId> {
        let before = std::mem::take(&mut self.pinned);
        self.order.clear();
        for &brick in bricks {
            if self.order.len() == most {
                break;
            }
            if self.pinned.insert(brick) {
                self.order.push(brick);
            }
        }
        self.pinned.symmetric_difference(&before).copied().collect()
    }

    /// Whether a brick is to stay.
    pub fn contains(&self, brick: BrickId) -> bool {
        self.pinned.contains(&brick)
    }

    /// How many bricks are to stay.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Those bricks.
    pub fn iter(&self) -> impl Iterator<Item = BrickId> {
        self.order.iter().copied()
    }
}
