use std::sync::mpsc::{Receiver, Sender, channel, sync_channel};
use std::thread;

use glassbrick_volume::VolumeReader;

use super::slice_window::SliceFeed;
use crate::StoreError;

/// Slices that are read at once take this much, if one is not more, and are no more than so many.
const RUN_BYTES: u64 = 16 << 20;
const RUN_SLICES: u64 = 16;

/// Runs that are read before they are asked for.
const RUNS_AHEAD: usize = 1;

/// Calls `work` with the slices of a reader, which are read on a thread of their own while it works.
pub fn with_read_ahead<R>(
    reader: &mut dyn VolumeReader,
    work: impl FnOnce(&mut dyn SliceFeed) -> Result<R, StoreError>,
) -> Result<R, StoreError> {
    let (give_back, used) = channel();
    let (give, read) = sync_channel(RUNS_AHEAD);
    thread::scope(|scope| {
        scope.spawn(move || {
            let slice_bytes = reader.desc().slice_bytes();
            let most_slices = (RUN_BYTES / slice_bytes).clamp(1, RUN_SLICES);
            let mut left = u64::from(reader.desc().extent.z);
            while left > 0 {
                let slices = left.min(most_slices);
                let memory = used.try_recv().unwrap_or_default();
                let run = read_run(reader, memory, slices * slice_bytes);
                left -= slices;
                let has_failed = run.is_err();
                // Nobody listens any more after another failure.
                if give.send(run).is_err() || has_failed {
                    return;
                }
            }
        });
        work(&mut ReadAhead { read, give_back })
    })
}

fn read_run(reader: &mut dyn VolumeReader, mut run: Vec<u8>, bytes: u64) -> Result<Vec<u8>, StoreError> {
    let missing = || StoreError::Unstorable {
        what: format!("a slice needs {bytes} bytes, which this machine does not give"),
    };
    let bytes = usize::try_from(bytes).map_err(|_| missing())?;
    run.try_reserve_exact(bytes.saturating_sub(run.len())).map_err(|_| missing())?;
    run.resize(bytes, 0);
    reader.read_slices(&mut run).map_err(StoreError::Input)?;
    Ok(run)
}

struct ReadAhead {
    read: Receiver<Result<Vec<u8>, StoreError>>,
    give_back: Sender<Vec<u8>>,
}

impl SliceFeed for ReadAhead {
    fn next_slices(&mut self) -> Result<Vec<u8>, StoreError> {
        self.read.recv().expect("no more slices are asked for than there are")
    }

    fn give_back(&mut self, used: Vec<u8>) {
        // When all is read, nobody waits for memory.
        let _ = self.give_back.send(used);
    }
}
