use std::collections::HashSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::files::table;
use super::{data, path};
use crate::binary::{glassbrick, glassbrick_in_little_memory};
use crate::robustness::{EXIT_FAILURE, refused};

#[test]
fn what_is_no_volume_or_none_that_is_read_is_refused_in_one_line() {
    let Some(data) = data() else { return };
    for name in REFUSED.lines().map(str::trim) {
        let message = refused(&glassbrick_in_little_memory("info", &[&data.join(name)]), EXIT_FAILURE);
        assert!(message.contains(name), "{message}");
    }
}

const REFUSED: &str = "README.md
    classic-volumes/SOURCE.txt
    classic-volumes/brainsmall.den
    classic-volumes/embryo-k3d-volume.vti
    classic-volumes/hydrogen.vti
    classic-volumes/neghip.slc
    classic-volumes/tooth.raw
    classic-volumes/vismale-head-256x256x128-u8.raw.bz2
    dicom-odd/ge-gantry-tilt-28.tar.xz
    microscopy-small/neubias/xyz__multiple_images.czi
    microscopy-small/neubias/xyzc_16bit__spots.tif
    microscopy-small/ome-tiff-artificial/4D-series.ome.tif
    microscopy-small/ome-tiff-artificial/test_I.tif
    nifti-odd/5D_small.nii
    nifti-odd/ct_perfusion.nii.gz
    nifti-odd/not-nifti.nii
    nrrd-meta-odd/headsq-quarter.vti
    nrrd-meta-odd/headsq-quarter/quarter.50
    ome-zarr/neuroglancer-testdata/zarr/ome_zarr/simple_0.5.zip";

/// Whoever has more data than the tables know: it may be read or refused, but not otherwise.
#[test]
fn every_other_file_is_read_or_refused_in_one_line() {
    let Some(data) = data() else { return };
    let volumes: HashSet<PathBuf> = table().map(|(name, _)| data.join(name)).collect();
    let mut others = Vec::new();
    walk(&data, &mut others);
    others.retain(|path| !volumes.contains(path));
    for path in others {
        let outcome = glassbrick("info", &[&path]);
        if outcome.code == Some(0) {
            outcome.succeeded();
            continue;
        }
        let message = refused(&outcome, EXIT_FAILURE);
        let name = path.file_name().expect("files have names").to_string_lossy();
        assert!(message.contains(&*name), "{}: {message}", path.display());
    }
}

fn walk(folder: &Path, files: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() { walk(&path, files) } else { files.push(path) }
    }
}

#[test]
fn folders_that_hold_no_volume_or_several_are_refused_in_one_line() {
    let Some(data) = data() else { return };
    for (name, words) in [
        ("mouse-brain-whole-tiff/brain-270.tar.xz:brain", "DICOM"),
        ("microscopy-small/neubias/xyz_8bit__em_volume_tiff_series", "DICOM"),
        ("nrrd-meta-odd/headsq-quarter", "DICOM"),
        ("nifti-odd/nifti_space", "NIfTI"),
        ("ome-zarr/mni152.ome.zarr", "Zarr"),
        ("ome-zarr/neuroglancer-testdata/zarr/ome_zarr/simple_0.4", "Zarr"),
        ("ome-zarr/neuroglancer-testdata/zarr/ome_zarr/simple_0.5", "brick store"),
        ("ome-zarr/neuroglancer-testdata/n5/n5_viewer_multiscale_modern", "DICOM"),
        ("dicom-odd/pydicom", "name a file"),
    ] {
        let message = refused(&glassbrick_in_little_memory("info", &[&path(&data, name)]), EXIT_FAILURE);
        assert!(message.contains(words), "{message}");
    }
}
