use std::collections::{HashSet, VecDeque};
use std::sync::Arc;

use glassbrick_volume::{Brick, BrickId, ReadError};

/// How many queued bricks, at most, the source is told of before their turn: enough that slow storage is never asked
/// for one brick at a time, and few enough that what it brings is still in memory when it is read.
const READ_AHEAD: usize = 16;

/// How soon a brick is needed. Bricks needed sooner are loaded first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Priority {
    /// The frame waits for it, or is not complete without it.
    NeededNow,
    /// A layer further on will meet it.
    NextLayers,
    /// A boundary brick, which a view from outside is likely to meet.
    Boundary,
}

/// A brick that was loaded, or why it could not be.
#[derive(Debug)]
pub struct Loaded {
    pub brick: BrickId,
    pub voxels: Result<Arc<Brick>, ReadError>,
}

/// Which bricks are queued, loading and loaded; the [`Loader`](crate::Loader) without its threads.
pub struct LoadQueue {
    /// By priority. A brick may be queued at more than one.
    queued: [Queue; 3],
    /// Loading or loaded.
    begun: HashSet<BrickId>,
    /// In the order in which they were finished.
    loaded: VecDeque<Loaded>,
    most_untaken: usize,
}

/// What a thread is to do.
#[derive(Debug, PartialEq, Eq)]
pub struct Begun {
    /// Bricks that will have their turn soon, to be told to the source before it reads; each is told once.
    pub coming: Vec<BrickId>,
    pub brick: BrickId,
}

#[derive(Default)]
struct Queue {
    /// Some may have been begun from another queue.
    order: VecDeque<BrickId>,
    waiting: HashSet<BrickId>,
    /// How many from the first on the source was told of.
    told: usize,
}

impl LoadQueue {
    /// Nothing is queued, and at most `most_untaken` bricks, but one at least, are ever loading or loaded.
    pub fn new(most_untaken: usize) -> Self {
        Self {
            queued: Default::default(),
            begun: HashSet::new(),
            loaded: VecDeque::new(),
            most_untaken: most_untaken.max(1),
        }
    }

    /// Queues bricks in the place of those queued before at this priority.
    pub fn request(&mut self, priority: Priority, bricks: &[BrickId]) {
        let queue = &mut self.queued[priority as usize];
        *queue = Queue::default();
        for &brick in bricks {
            if !self.begun.contains(&brick) && queue.waiting.insert(brick) {
                queue.order.push_back(brick);
            }
        }
    }

    /// Begins to load the brick that is needed soonest. None while nothing is queued or too many bricks are untaken.
    pub fn begin(&mut self) -> Option<Begun> {
        if self.begun.len() >= self.most_untaken {
            return None;
        }
        let brick = self.queued.iter_mut().find_map(Queue::pop)?;
        for queue in &mut self.queued {
            queue.waiting.remove(&brick);
        }
        self.begun.insert(brick);
        Some(Begun { coming: self.coming(), brick })
    }

    /// A brick that was begun is loaded.
    pub fn finish(&mut self, loaded: Loaded) {
        self.loaded.push_back(loaded);
    }

    /// Hands out the brick that was finished first, and forgets it.
    pub fn take(&mut self) -> Option<Loaded> {
        let loaded = self.loaded.pop_front()?;
        self.begun.remove(&loaded.brick);
        Some(loaded)
    }

    /// Whether no brick will be finished any more.
    pub fn is_idle(&self) -> bool {
        self.begun.len() == self.loaded.len() && self.queued.iter().all(|queue| queue.waiting.is_empty())
    }

    fn coming(&mut self) -> Vec<BrickId> {
        let mut coming = Vec::new();
        let mut ahead = READ_AHEAD;
        for queue in &mut self.queued {
            let reached = queue.order.len().min(ahead);
            let untold = queue.order.iter().take(reached).skip(queue.told);
            coming.extend(untold.filter(|brick| queue.waiting.contains(brick)));
            queue.told = queue.told.max(reached);
            ahead -= reached;
        }
        coming
    }
}

impl Queue {
    fn pop(&mut self) -> Option<BrickId> {
        while let Some(brick) = self.order.pop_front() {
            self.told = self.told.saturating_sub(1);
            if self.waiting.remove(&brick) {
                return Some(brick);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests;
