//! Pictures in linear light as files, for one process to compare with another's: red, green, blue and alpha of each pixel,
//! as little-endian `f32`.

use std::fs;
use std::path::Path;

use crate::BenchError;

pub fn write(path: &Path, pixels: &[[f32; 4]]) -> Result<(), BenchError> {
    let bytes: Vec<u8> = pixels.as_flattened().iter().flat_map(|channel| channel.to_le_bytes()).collect();
    fs::write(path, bytes).map_err(|source| BenchError::File { path: path.to_owned(), source })
}

/// The pixels, if there are as many as are expected.
pub fn read(path: &Path, pixels: usize) -> Option<Vec<[f32; 4]>> {
    let bytes = fs::read(path).ok()?;
    let channels: Vec<f32> =
        bytes.as_chunks::<4>().0.iter().map(|&channel| f32::from_le_bytes(channel)).collect();
    let found = channels.as_chunks::<4>().0.to_vec();
    (found.len() == pixels).then_some(found)
}
