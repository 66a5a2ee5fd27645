//! Whole series, written by another implementation of DICOM, as volumes.
