use std::fs;
use std::io;
use std::path::Path;
use std::time::UNIX_EPOCH;

use glassbrick_brick_store::{Codec, Ingested, StoreError, Verified, is_zarr};
use glassbrick_formats::OpenOptions;
use glassbrick_volume::BrickLayout;

use crate::volume::thread_pool;
use crate::{Error, process_memory};

/// How a brick store is made.
#[derive(Clone, Debug, Default)]
pub struct IngestSettings {
    /// What the volume's format needs to be told.
    pub format: OpenOptions,
    pub layout: BrickLayout,
    pub codec: Codec,
    /// Whether a store that is there already is replaced.
    pub replace: bool,
    /// Whether to go on where a run was stopped, and to keep what is done for such a run when this one fails.
    pub resume: bool,
    /// As many as there are processors where nothing is said.
    pub threads: Option<usize>,
}

/// Makes a brick store at `target` of the volume in a file or folder of slices, with levels down to one brick.
///
/// Slices are read as a stream: memory holds as many as a brick has along z, and little else. What stands at `target`
/// is untouched until the store is whole. `progress` hears how many bytes of voxels of how many are stored, all levels
/// together.
///
/// # Errors
/// When the input is no volume or is damaged, or the store cannot be written.
pub fn ingest(
    path: &Path,
    target: &Path,
    settings: &IngestSettings,
    mut progress: impl FnMut(u64, u64) + Send,
) -> Result<Ingested, Error> {
    process_memory::watch();
    if is_zarr(path) {
        let what = "it is a Zarr store already, which needs no ingest".to_owned();
        return Err(StoreError::Unstorable { what }.into());
    }
    let threads = thread_pool(settings.threads)?;
    let mut reader = glassbrick_formats::open(path, &settings.format)?;
    let store_settings = glassbrick_brick_store::IngestSettings {
        layout: settings.layout,
        codec: settings.codec,
        replace: settings.replace,
        resume: settings.resume,
        input: identity(path, &settings.format),
    };
    Ok(threads.install(|| {
        glassbrick_brick_store::ingest(reader.as_mut(), target, &store_settings, &mut progress)
    })?)
}

/// Checks every brick and table of a store. `progress` hears how many bricks of how many are done.
///
/// # Errors
/// When the store cannot be checked at all, for it does not say what it is.
pub fn verify(
    path: &Path,
    threads: Option<usize>,
    progress: impl Fn(u64, u64) + Sync,
) -> Result<Verified, Error> {
    process_memory::watch();
    let threads = thread_pool(threads)?;
    Ok(threads.install(|| glassbrick_brick_store::verify(path, &progress))?)
}

/// Bytes that the files of a store take, if they can all be looked at.
pub fn stored_bytes(path: &Path) -> io::Result<u64> {
    fs::read_dir(path)?.try_fold(0, |sum, entry| {
        let entry = entry?;
        let metadata = entry.path().symlink_metadata()?;
        Ok(sum + if metadata.is_dir() { stored_bytes(&entry.path())? } else { metadata.len() })
    })
}

/// What tells an input from another, and from itself when its files have changed.
fn identity(path: &Path, options: &OpenOptions) -> String {
    let whole_path = path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let changes = changes(path).unwrap_or_default();
    format!("{} {options:?} {changes:?}", whole_path.display())
}

/// How many files there are, how long they are together, and when the last of them was changed.
fn changes(path: &Path) -> io::Result<(u64, u64, u128)> {
    let metadata = path.metadata()?;
    if !metadata.is_dir() {
        let modified = metadata.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok());
        return Ok((1, metadata.len(), modified.map_or(0, |since| since.as_nanos())));
    }
    fs::read_dir(path)?.try_fold((0, 0, 0), |(files, bytes, last), entry| {
        let entry = entry?;
        // A link may lead in a circle.
        if entry.file_type()?.is_symlink() {
            return Ok((files + 1, bytes, last));
        }
        let (more_files, more_bytes, later) = changes(&entry.path())?;
        Ok((files + more_files, bytes + more_bytes, last.max(later)))
    })
}
