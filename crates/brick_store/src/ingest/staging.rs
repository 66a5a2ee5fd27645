use std::ffi::OsString;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::platform;
use crate::store::{StoreError, is_store};

/// Held by the run that works in the folder.
const LOCK: &str = "ingest.lock";

/// What a stopped run has finished.
const STATE: &str = "ingest.json";

/// The folder beside the target in which a store is made. It is hidden, and the target is as it was until it takes
/// the target's place.
pub struct Staging {
    target: PathBuf,
    folder: PathBuf,
    replaced: PathBuf,
    lock: Option<File>,
}

/// How far a run is.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RunState {
    /// What the run makes of what.
    pub run: String,
    pub level: u32,
    /// Rows of shards of the level that are finished.
    pub shard_rows: u32,
    /// Voxels of level 0 that are not finite, in what is stored.
    pub not_finite: u64,
}

impl Staging {
    /// Takes the folder for a target, after what an earlier run left there was cleared or, with `resume`, taken over.
    ///
    /// # Errors
    /// When the target cannot be made or replaced, or another run makes it.
    pub fn begin(target: &Path, replace: bool, resume: bool) -> Result<Self, StoreError> {
        let (target, name) = resolve(target)?;
        let beside = |suffix: &str| {
            let mut hidden = OsString::from(".");
            hidden.push(&name);
            hidden.push(suffix);
            target.with_file_name(hidden)
        };
        let (folder, replaced) = (beside(".glassbrick-ingest"), beside(".glassbrick-replaced"));
        let mut staging = Self { target, folder, replaced, lock: None };
        fs::create_dir_all(&staging.folder).map_err(|source| staging.write_error(source))?;
        let lock = File::create(staging.folder.join(LOCK)).map_err(|source| staging.write_error(source))?;
        match lock.try_lock() {
            Ok(()) => staging.lock = Some(lock),
            Err(TryLockError::WouldBlock) => return Err(StoreError::Busy { path: staging.target.clone() }),
            // A file system without locks: two runs at once are then the user's to avoid.
            Err(TryLockError::Error(_)) => {}
        }
        let checked = staging.mend().and_then(|()| check_target(&staging.target, replace));
        if let Err(error) = checked {
            if staging.state().is_none() {
                staging.discard();
            }
            return Err(error);
        }
        if !resume || staging.state().is_none() {
            staging.clear().map_err(|source| staging.write_error(source))?;
        }
        Ok(staging)
    }

    /// That what a stopped run left is another run's.
    pub fn other_run(&self) -> StoreError {
        StoreError::OtherRun { path: self.target.clone() }
    }

    /// Where the store is made.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// How far the run was that was stopped here, if one was.
    pub fn state(&self) -> Option<RunState> {
        serde_json::from_slice(&fs::read(self.folder.join(STATE)).ok()?).ok()
    }

    /// Takes note of how far the run is.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn note(&self, state: &RunState) -> Result<(), StoreError> {
        let aside = self.folder.join("ingest.json.part");
        let text = serde_json::to_vec(state).expect("plain data becomes JSON");
        fs::write(&aside, text)
            .and_then(|()| fs::rename(&aside, self.folder.join(STATE)))
            .map_err(|source| self.write_error(source))
    }

    /// Puts the store in the target's place, and removes what stood there.
    ///
    /// # Errors
    /// When that fails; the target is then as it was.
    pub fn commit(&mut self) -> Result<(), StoreError> {
        let replaces = self.target.symlink_metadata().is_ok();
        if replaces {
            // What is removed below must not be lost for a store that the disk does not hold yet.
            sync_files(&self.folder).map_err(|source| self.write_error(source))?;
        }
        self.lock = None;
        let take_place = || {
            for own in [STATE, LOCK] {
                remove_if_there(&self.folder.join(own))?;
            }
            if !replaces {
                return fs::rename(&self.folder, &self.target);
            }
            if platform::exchange(&self.folder, &self.target).is_ok() {
                remove_left(&self.folder);
                return Ok(());
            }
            fs::rename(&self.target, &self.replaced)?;
            if let Err(error) = fs::rename(&self.folder, &self.target) {
                fs::rename(&self.replaced, &self.target)?;
                return Err(error);
            }
            remove_left(&self.replaced);
            Ok(())
        };
        take_place().map_err(|source| self.write_error(source))
    }

    /// Removes all that was made.
    pub fn discard(mut self) {
        self.lock = None;
        remove_left(&self.folder);
    }

    /// Ends what a run began that was stopped while it put its store in the target's place, where that takes two steps.
    fn mend(&self) -> Result<(), StoreError> {
        let mend = || match (self.replaced.exists(), self.target.exists()) {
            (true, true) => fs::remove_dir_all(&self.replaced),
            (true, false) => fs::rename(&self.replaced, &self.target),
            (false, _) => Ok(()),
        };
        mend().map_err(|source| self.write_error(source))
    }

    /// Removes all in the folder but the lock.
    fn clear(&self) -> io::Result<()> {
        for entry in fs::read_dir(&self.folder)? {
            let entry = entry?;
            if entry.file_name() == LOCK {
                continue;
            }
            if entry.file_type()?.is_dir() {
                fs::remove_dir_all(entry.path())?;
            } else {
                fs::remove_file(entry.path())?;
            }
        }
        Ok(())
    }

    fn write_error(&self, source: io::Error) -> StoreError {
        StoreError::Write { path: self.target.clone(), source }
    }
}

/// The folder that a target names, past links, and its name.
fn resolve(target: &Path) -> Result<(PathBuf, OsString), StoreError> {
    let refuse = |what| StoreError::Target { path: target.to_owned(), what };
    let resolved = target.canonicalize().unwrap_or_else(|_| target.to_owned());
    let name = resolved.file_name().ok_or_else(|| refuse("is not the name of a store; add one"))?.to_owned();
    let parent = resolved.parent().filter(|parent| !parent.as_os_str().is_empty());
    match parent.unwrap_or(Path::new(".")).metadata() {
        Ok(metadata) if metadata.is_dir() => Ok((resolved, name)),
        Ok(_) => Err(refuse("lies in what is no folder; give another name")),
        Err(_) => Err(refuse("lies in a folder that is not there; make it first")),
    }
}

fn check_target(target: &Path, replace: bool) -> Result<(), StoreError> {
    let Ok(metadata) = target.symlink_metadata() else { return Ok(()) };
    let path = target.to_owned();
    if !metadata.is_dir() || !is_store(target) {
        let what = "is there already and is no brick store, so it will not be replaced; give another name";
        return Err(StoreError::Target { path, what });
    }
    if replace { Ok(()) } else { Err(StoreError::Exists { path }) }
}

/// Removes what nobody needs any more. What cannot be removed is cleared by the next run.
fn remove_left(folder: &Path) {
    let _ = fs::remove_dir_all(folder);
}

fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Waits until the disk holds every file below a folder.
fn sync_files(folder: &Path) -> io::Result<()> {
    let entries = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    entries.par_iter().try_for_each(|entry| {
        if entry.file_type()?.is_dir() {
            sync_files(&entry.path())
        } else {
            File::open(entry.path())?.sync_all()
        }
    })
}
