//! Threads that load bricks.
//!
//! A brick that was asked for goes through these states:
//!
//! ```text
//!            request           a thread is free         the source          take or
//!                              and there is room        answers             wait
//! (unknown) ─────────▶ queued ───────────────▶ loading ─────────▶ loaded ─────────▶ (unknown)
//!     ▲                  │
//!     └──────────────────┘
//!       request without it
//! ```
//!
//! - *queued*: at one or more priorities. A request puts its bricks in the place of all that are queued at its priority;
//!   a brick left out is unknown again, unless it is queued at another one. A brick is begun once, at the highest.
//! - *loading*, *loaded*: a request changes nothing of it, and it is handed out whether it is still wanted or not.
//! - Loading and loaded bricks together are at most `most_untaken`: they are all that the loader keeps in memory.
//! - A source that fails or panics gives an error in the place of voxels; the brick is loaded all the same.
//! - Queued bricks are told to the source ([`BrickSource::will_need`]) shortly before their turn, by the threads: the
//!   hint may open files, and who draws must not wait for that.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::thread::{Builder, JoinHandle};

use glassbrick_volume::{Brick, BrickId, BrickSource, ReadError};

use crate::load_queue::{Begun, LoadQueue};
use crate::{Loaded, Priority, ResidencyError};

/// Loads bricks on threads of its own, which end when it is dropped: at once, but for bricks that are being read.
///
/// Bricks are handed out in the order in which they are finished. Among them may be some that are not wanted any more.
pub struct Loader {
    shared: Arc<Shared>,
    threads: Vec<JoinHandle<()>>,
}

struct Shared {
    source: Arc<dyn BrickSource>,
    state: Mutex<State>,
    /// A brick may be begun, or the threads are to end.
    work: Condvar,
    /// A brick was finished, or none is left to wait for.
    news: Condvar,
}

struct State {
    queue: LoadQueue,
    ends: bool,
}

impl Loader {
    /// Starts `threads` threads, one at least. No more than `most_untaken` bricks (one at least) are ever being
    /// loaded or waiting to be taken; fewer than `threads` leave threads idle, twice as many keep all of them busy.
    ///
    /// # Errors
    /// When the system gives no more threads.
    pub fn new(
        source: Arc<dyn BrickSource>,
        threads: usize,
        most_untaken: usize,
    ) -> Result<Self, ResidencyError> {
        let state = Mutex::new(State { queue: LoadQueue::new(most_untaken), ends: false });
        let shared = Arc::new(Shared { source, state, work: Condvar::new(), news: Condvar::new() });
        let mut loader = Self { shared, threads: Vec::new() };
        let threads = threads.max(1);
        for number in 1..=threads {
            let shared = Arc::clone(&loader.shared);
            let thread = Builder::new().name("load bricks".to_owned()).spawn(move || shared.load_bricks());
            loader.threads.push(thread.map_err(|source| ResidencyError::NoThread {
                number,
                threads,
                source,
            })?);
        }
        Ok(loader)
    }

    /// Asks for bricks, the first ones first, in the place of those asked for before at this priority that are not
    /// begun. Bricks that are being loaded, or were and are not taken, are handed out as they are.
    pub fn request(&self, priority: Priority, bricks: &[BrickId]) {
        self.shared.lock().queue.request(priority, bricks);
        self.shared.work.notify_all();
        self.shared.news.notify_all();
    }

    /// The next brick, if one is loaded; does not wait.
    pub fn take(&self) -> Option<Loaded> {
        self.shared.take(&mut self.shared.lock())
    }

    /// The next brick; waits until one is loaded. None where none is queued, loading or loaded.
    pub fn wait(&self) -> Option<Loaded> {
        let mut state = self.shared.lock();
        loop {
            let loaded = self.shared.take(&mut state);
            if loaded.is_some() || state.queue.is_idle() {
                return loaded;
            }
            state = self.shared.news.wait(state).expect(NOTHING_PANICS);
        }
    }
}

impl Drop for Loader {
    fn drop(&mut self) {
        self.shared.lock().ends = true;
        self.shared.work.notify_all();
        for thread in self.threads.drain(..) {
            thread.join().expect("what the source does is caught");
        }
    }
}

const NOTHING_PANICS: &str = "nothing panics while it is locked";

impl Shared {
    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().expect(NOTHING_PANICS)
    }

    fn take(&self, state: &mut State) -> Option<Loaded> {
        let loaded = state.queue.take()?;
        self.work.notify_one();
        // Of several who wait, all but one may have to learn that nothing is left.
        self.news.notify_all();
        Some(loaded)
    }

    /// What each thread does.
    fn load_bricks(&self) {
        let mut state = self.lock();
        while !state.ends {
            let Some(begun) = state.queue.begin() else {
                state = self.work.wait(state).expect(NOTHING_PANICS);
                continue;
            };
            drop(state);
            let loaded = Loaded { brick: begun.brick, voxels: self.read(&begun) };
            state = self.lock();
            state.queue.finish(loaded);
            self.news.notify_all();
        }
    }

    fn read(&self, begun: &Begun) -> Result<Arc<Brick>, ReadError> {
        let read = || {
            if !begun.coming.is_empty() {
                self.source.will_need(&begun.coming);
            }
            self.source.brick(begun.brick)
        };
        catch_unwind(AssertUnwindSafe(read)).unwrap_or_else(|panic| {
            let text = panic.downcast_ref::<String>().map(String::as_str);
            let text = text.or_else(|| panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
            let BrickId { level, x, y, z } = begun.brick;
            let text = text.lines().next().unwrap_or_default();
            Err(format!(
                "brick {x},{y},{z} of level {level}: its reader broke off: {text}; report this as a fault"
            )
            .into())
        })
    }
}
