//! Finds the DICOM images of a path: of a file and its neighbours, or of a folder.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::image::Image;
use super::probe::{Probed, probe};
use crate::FormatError;

/// How deep below a folder without DICOM files such files are looked for.
const MAX_DEPTH: usize = 4;
/// How many files are looked at below a folder without DICOM files.
const MAX_FILES_BELOW: usize = 50_000;

/// The images of a path.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    pub images: Vec<Image>,
    /// DICOM files of other kinds.
    pub others: usize,
    /// DICOM files that cannot be read.
    pub refused: Vec<FormatError>,
}

/// Reads the headers of the DICOM files in a folder, or, if it has none, below it. Nothing where there is
/// none.
pub(super) fn gather_folder(folder: &Path) -> Result<Option<Gathered>, FormatError> {
    let entries = Entries::read(folder).map_err(|source| FormatError::io(folder, source))?;
    if let Some(gathered) = gather_files(&entries.files) {
        return Ok(Some(gathered));
    }
    let mut below = Vec::new();
    let mut folders = entries.folders;
    for _ in 0..MAX_DEPTH {
        // A folder that cannot be read is passed over like a file that is no DICOM.
        let entries: Vec<Entries> = folders.iter().filter_map(|folder| Entries::read(folder).ok()).collect();
        below.extend(entries.iter().flat_map(|entries| entries.files.iter().cloned()));
        folders = entries.into_iter().flat_map(|entries| entries.folders).collect();
        if folders.is_empty() || below.len() > MAX_FILES_BELOW {
            break;
        }
    }
    below.truncate(MAX_FILES_BELOW);
    Ok(gather_files(&below))
}

/// Reads the header of a file and of the other files of its series in the same folder.
pub(super) fn gather_series(file: &Path) -> Result<Option<Gathered>, FormatError> {
    let image = match probe(file) {
        Probed::NotDicom => return Ok(None),
        Probed::Refused(error) => return Err(error),
        Probed::NoImage => {
            let what = "this DICOM file holds no image; name a file of an image series, or its folder";
            return Err(FormatError::unsupported(file, what));
        }
        Probed::Image(image) => *image,
    };
    let folder = match file.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let mut gathered = Gathered::default();
    if image.frames.len() == 1 {
        // Without the right to list the folder, the file is still a volume of one slice.
        let entries = Entries::read(folder).unwrap_or_default();
        let siblings: Vec<PathBuf> =
            entries.files.into_iter().filter(|sibling| sibling.file_name() != file.file_name()).collect();
        gathered = gather_files(&siblings).unwrap_or_default();
        // What is known to be no slice is of no interest here; what is damaged may be one.
        gathered.refused.retain(|error| !matches!(error, FormatError::Unsupported { .. }));
        gathered.images.retain(|sibling| sibling.series.uid == image.series.uid && sibling.frames.len() == 1);
    }
    gathered.images.insert(0, image);
    Ok(Some(gathered))
}

fn gather_files(files: &[PathBuf]) -> Option<Gathered> {
    let probed: Vec<Probed> = files.par_iter().map(|file| probe(file)).collect();
    let mut gathered = Gathered::default();
    for probed in probed {
        match probed {
            Probed::NotDicom => {}
            Probed::NoImage => gathered.others += 1,
            Probed::Refused(error) => gathered.refused.push(error),
            Probed::Image(image) => gathered.images.push(*image),
        }
    }
    // A file that cannot be read at all may be of any kind.
    let is_dicom = |error: &FormatError| !matches!(error, FormatError::Io { .. });
    let any = gathered.others > 0 || gathered.refused.iter().any(is_dicom) || !gathered.images.is_empty();
    any.then_some(gathered)
}

/// What a folder holds, by name. Hidden files and links out of the folder are left out.
#[derive(Default)]
struct Entries {
    files: Vec<PathBuf>,
    folders: Vec<PathBuf>,
}

impl Entries {
    fn read(folder: &Path) -> io::Result<Self> {
        let mut entries = Self::default();
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            let name = entry.file_name();
            if name.as_encoded_bytes().starts_with(b".") || name.eq_ignore_ascii_case("DICOMDIR") {
                continue;
            }
            let kind = entry.file_type()?;
            if kind.is_dir() {
                entries.folders.push(entry.path());
            } else if kind.is_file() || (kind.is_symlink() && links_within(folder, &entry.path())) {
                entries.files.push(entry.path());
            }
        }
        entries.files.sort();
        entries.folders.sort();
        Ok(entries)
    }
}

/// Whether a link leads to a file that lies in the same folder.
fn links_within(folder: &Path, link: &Path) -> bool {
    let target = fs::canonicalize(link);
    let folder = fs::canonicalize(folder);
    target.is_ok_and(|target| target.is_file() && folder.is_ok_and(|folder| target.starts_with(folder)))
}
