use std::path::Path;

use crate::FormatError;

/// Which of several volumes in the same files is meant.
///
/// Their voxels take turns: `run_bytes` of the first, of the second, and so on, then again of the first. Where the
/// run is the whole volume they follow each other; where it is one voxel they are interleaved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Steps {
    pub count: u64,
    pub index: u64,
    pub run_bytes: u64,
}

impl Steps {
    /// The only volume there is.
    pub fn single(volume_bytes: u64) -> Self {
        Self { count: 1, index: 0, run_bytes: volume_bytes }
    }

    /// The step of `count` that the user asks for, with a note on what was chosen where there was a choice.
    pub fn choose(
        path: &Path,
        count: u64,
        run_bytes: u64,
        time: Option<u32>,
        notes: &mut Vec<String>,
    ) -> Result<Self, FormatError> {
        let index = u64::from(time.unwrap_or(0));
        if index >= count {
            let what = match count {
                0 => "the header claims no volume at all; it is damaged".to_owned(),
                1 => format!("there is no time step {index}: the file holds one volume; leave --time away"),
                _ => format!("there is no time step {index}: --time may be 0 to {}", count - 1),
            };
            return Err(FormatError::unsupported(path, what));
        }
        if count > 1 && time.is_none() {
            notes.push(format!("the file holds {count} volumes; this is the first, --time chooses another"));
        } else if count > 1 {
            notes.push(format!("this is volume {index} of {count}, counted from 0"));
        }
        Ok(Self { count, index, run_bytes })
    }

    /// Whether the volumes lie one after the other, so that this one is a single stretch.
    pub fn follow_each_other(self, volume_bytes: u64) -> bool {
        self.count == 1 || self.run_bytes == volume_bytes
    }

    /// How many bytes from `position` on are of one kind, and whether they belong to this volume.
    pub fn stretch(self, position: u64) -> (u64, bool) {
        let (run, within) = (position / self.run_bytes % self.count, position % self.run_bytes);
        let left = self.run_bytes - within;
        let others = |runs: u64| left + (runs - 1) * self.run_bytes;
        match run.cmp(&self.index) {
            std::cmp::Ordering::Less => (others(self.index - run), false),
            std::cmp::Ordering::Equal => (left, true),
            std::cmp::Ordering::Greater => (others(self.count - run), false),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_follow_the_chosen_runs() {
        let steps = Steps { count: 4, index: 1, run_bytes: 10 };
        assert_eq!(steps.stretch(0), (10, false));
        assert_eq!(steps.stretch(13), (7, true));
        assert_eq!(steps.stretch(21), (19, false));
        assert_eq!(steps.stretch(45), (5, false));
        assert_eq!(Steps::single(10).stretch(4), (6, true));
    }

    #[test]
    fn a_step_that_is_not_there_is_refused() {
        let mut notes = Vec::new();
        let mut choose = |count, time| Steps::choose(Path::new("a"), count, 8, time, &mut notes);
        assert!(choose(0, None).unwrap_err().to_string().contains("no volume"));
        assert!(choose(1, Some(1)).unwrap_err().to_string().contains("one volume"));
        assert!(choose(3, Some(3)).unwrap_err().to_string().contains("0 to 2"));
        assert_eq!(choose(1, Some(0)).unwrap().count, 1);
        assert_eq!(choose(3, None).unwrap().index, 0);
        assert_eq!(notes.len(), 1);
    }
}
