use std::fs;
use std::path::Path;

use serde_json::Value;

use super::{StoreDesc, StoreError, documents};

/// The group's own metadata.
pub const METADATA: &str = "zarr.json";

/// Metadata is no longer than this.
const MOST_METADATA_BYTES: u64 = 16 << 20;

/// Reads what a store says of itself, and how many bytes that took.
///
/// # Errors
/// When it is no brick store, of another version, or damaged.
pub fn read_desc(root: &Path) -> Result<(StoreDesc, u64), StoreError> {
    let path = root.join(METADATA);
    let not_a_store = |what: &str| StoreError::NotAStore { path: root.to_owned(), what: what.to_owned() };
    if !root.metadata().map_err(|source| StoreError::Read { path: root.to_owned(), source })?.is_dir() {
        return Err(not_a_store("it is a file; glassbrick ingest makes a store of a volume"));
    }
    if !path.exists() {
        return Err(not_a_store(
            "it has no zarr.json, as Zarr version 3 asks for; make it again if it was one",
        ));
    }
    let (mut group, bytes_read) = read_json(&path)?;
    match group["attributes"].get_mut("glassbrick").map(Value::take) {
        Some(attributes) => Ok((StoreDesc::from_attributes(attributes, &path)?, bytes_read)),
        None => Err(not_a_store(
            "its zarr.json is another program's; give a volume, or a store that glassbrick ingest made",
        )),
    }
}

/// Checks that every array and group is what the store's attributes ask for; returns how many bytes that took.
/// `damaged` hears what is wrong, and says whether to go on.
///
/// # Errors
/// What `damaged` returns.
pub fn check_documents(
    root: &Path,
    store: &StoreDesc,
    mut damaged: impl FnMut(StoreError) -> Result<(), StoreError>,
) -> Result<u64, StoreError> {
    let mut bytes_read = 0;
    for (name, expected) in documents(store) {
        match check_document(&root.join(name), expected) {
            Ok(bytes) => bytes_read += bytes,
            Err(error) => damaged(error)?,
        }
    }
    Ok(bytes_read)
}

fn check_document(path: &Path, mut expected: Value) -> Result<u64, StoreError> {
    let (mut found, bytes_read) = read_json(path)?;
    // Attributes are free for others to write; ours carry a checksum.
    for document in [&mut found, &mut expected] {
        document.as_object_mut().map(|document| document.remove("attributes"));
    }
    if found == expected {
        return Ok(bytes_read);
    }
    let what = "does not describe the array or group that the store's attributes ask for".to_owned();
    Err(StoreError::Damaged { path: path.to_owned(), what })
}

fn read_json(path: &Path) -> Result<(Value, u64), StoreError> {
    let reading = |source| StoreError::reading(path, source);
    let damaged = |what: String| StoreError::Damaged { path: path.to_owned(), what };
    if path.metadata().map_err(reading)?.len() > MOST_METADATA_BYTES {
        return Err(damaged("is too long for metadata".to_owned()));
    }
    let text = fs::read(path).map_err(reading)?;
    let value: Value =
        serde_json::from_slice(&text).map_err(|error| damaged(format!("is no JSON: {error}")))?;
    if !value.is_object() {
        return Err(damaged("is no JSON object".to_owned()));
    }
    Ok((value, text.len() as u64))
}
