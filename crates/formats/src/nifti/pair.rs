//! The two files of a pair: `scan.hdr` and `scan.img`, either of them plain or `.gz`.

use std::path::{Path, PathBuf};

use crate::FormatError;

/// Whether a path ends in `.gz`.
pub(crate) fn is_gz(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gz"))
}

/// The voxels that belong to a header.
pub(crate) fn voxels_beside(header: &Path) -> Result<PathBuf, FormatError> {
    beside(header, "hdr", "img").ok_or_else(|| {
        let what = "is the header of a NIfTI pair, but its .img is not beside it; put it there";
        FormatError::malformed(header, what)
    })
}

/// The header that belongs to voxels, if there is one.
pub(crate) fn header_beside(voxels: &Path) -> Option<PathBuf> {
    beside(voxels, "img", "hdr")
}

/// The file that is named like `path`, but with extension `to` in place of `from`.
fn beside(path: &Path, from: &str, to: &str) -> Option<PathBuf> {
    let plain = if is_gz(path) { path.with_extension("") } else { path.to_owned() };
    let extension = plain.extension()?.to_str()?;
    if !extension.eq_ignore_ascii_case(from) {
        return None;
    }
    let to = if extension == from { to.to_owned() } else { to.to_uppercase() };
    let other = plain.with_extension(&to);
    [other.clone(), other.with_extension(format!("{to}.gz"))].into_iter().find(|other| other.is_file())
}
