//! DICOM series.

use std::path::Path;

use glassbrick_volume::VolumeReader;

use crate::{FormatError, OpenOptions};

/// Opens a DICOM file or a folder of them; nothing where there is no DICOM at all.
pub(crate) fn open_path(
    _path: &Path,
    _options: &OpenOptions,
) -> Result<Option<Box<dyn VolumeReader>>, FormatError> {
    Ok(None)
}
