//! Writes a phantom to a file, slab by slab, under its name only when it is whole.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::Phantom;

/// Memory of one slab of voxels; there are two.
const SLAB_BYTES: usize = 16 << 20;

impl Phantom {
    /// Writes an attached NRRD of little-endian shorts in Hounsfield units.
    ///
    /// `progress` is told the share that is done, from 0 to 1, after each slab.
    ///
    /// # Errors
    ///
    /// Where the file cannot be made, written or renamed; nothing half-written is left, and a file that had the
    /// name is kept.
    pub fn write_nrrd(&self, path: &Path, progress: impl FnMut(f32)) -> io::Result<()> {
        self.write(path, self.nrrd_header().as_bytes(), i16::to_le_bytes, progress)
    }

    /// Writes the voxels alone, as little-endian 16-bit integers in Hounsfield units.
    ///
    /// # Errors
    ///
    /// As [`write_nrrd`](Self::write_nrrd).
    pub fn write_raw(&self, path: &Path, progress: impl FnMut(f32)) -> io::Result<()> {
        self.write(path, &[], i16::to_le_bytes, progress)
    }

    /// Writes the voxels alone, as little-endian unsigned 16-bit integers: Hounsfield units + 1024.
    ///
    /// # Errors
    ///
    /// As [`write_nrrd`](Self::write_nrrd).
    pub fn write_raw_u16(&self, path: &Path, progress: impl FnMut(f32)) -> io::Result<()> {
        self.write(path, &[], |hu| (hu + 1024).to_le_bytes(), progress)
    }

    fn nrrd_header(&self) -> String {
        let [nx, ny, nz] = self.extent;
        let [sx, sy, sz] = self.spacing_mm();
        let [ox, oy, oz] = self.origin_mm();
        format!(
            "NRRD0005\n\
             type: short\n\
             dimension: 3\n\
             space: left-posterior-superior\n\
             sizes: {nx} {ny} {nz}\n\
             space directions: ({sx},0,0) (0,{sy},0) (0,0,{sz})\n\
             kinds: domain domain domain\n\
             endian: little\n\
             encoding: raw\n\
             space origin: ({ox},{oy},{oz})\n\n"
        )
    }

    fn write(
        &self,
        path: &Path,
        header: &[u8],
        bytes_of: impl Fn(i16) -> [u8; 2] + Sync,
        mut progress: impl FnMut(f32),
    ) -> io::Result<()> {
        let [nx, ny, nz] = self.extent;
        let row_voxels = nx as usize;
        let rows = u64::from(ny) * u64::from(nz);
        let rows_per_slab = ((SLAB_BYTES / (2 * row_voxels)).max(1) as u64).min(rows);
        let scan = self.scan();
        let fill = |first_row: u64, slab: &mut Vec<i16>| {
            let count = rows_per_slab.min(rows.saturating_sub(first_row));
            slab.resize(count as usize * row_voxels, 0);
            scan.fill_rows(first_row, slab);
        };

        let mut partial = PartialFile::beside(path)?;
        partial.file.write_all(header)?;
        let (mut slab, mut next_slab) = (Vec::new(), Vec::new());
        let mut row = 0;
        fill(row, &mut slab);
        while row < rows {
            let next_row = row + rows_per_slab;
            // One slab is written while the next is computed.
            let (written, ()) = rayon::join(
                || write_voxels(&mut partial.file, &slab, &bytes_of),
                || {
                    if next_row < rows {
                        fill(next_row, &mut next_slab)
                    }
                },
            );
            written?;
            std::mem::swap(&mut slab, &mut next_slab);
            row = next_row;
            progress((row.min(rows) as f64 / rows as f64) as f32);
        }
        partial.finish(path)
    }
}

fn write_voxels(file: &mut File, slab: &[i16], bytes_of: impl Fn(i16) -> [u8; 2]) -> io::Result<()> {
    const VOXELS: usize = 1 << 19;
    let mut bytes = vec![0; 2 * VOXELS.min(slab.len())];
    for voxels in slab.chunks(VOXELS) {
        let bytes = &mut bytes[..2 * voxels.len()];
        for (pair, &hu) in bytes.chunks_exact_mut(2).zip(voxels) {
            pair.copy_from_slice(&bytes_of(hu));
        }
        file.write_all(bytes)?;
    }
    Ok(())
}

/// A file under a temporary name, removed unless it is finished.
struct PartialFile {
    file: File,
    path: PathBuf,
    finished: bool,
}

impl PartialFile {
    fn beside(path: &Path) -> io::Result<Self> {
        let name = path.file_name().ok_or_else(|| {
            io::Error::new(io::ErrorKind::InvalidInput, "the output path names no file; give it a file name")
        })?;
        let mut partial_name = std::ffi::OsString::from(".");
        partial_name.push(name);
        partial_name.push(format!(".{}.partial", std::process::id()));
        let path = path.with_file_name(partial_name);
        Ok(Self { file: File::create_new(&path)?, path, finished: false })
    }

    fn finish(mut self, path: &Path) -> io::Result<()> {
        self.file.flush()?;
        fs::rename(&self.path, path)?;
        self.finished = true;
        Ok(())
    }
}

impl Drop for PartialFile {
    fn drop(&mut self) {
        if !self.finished {
            // Nothing can be done for a file that cannot be removed.
            let _ = fs::remove_file(&self.path);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A folder of its own for one test, removed at its end.
    struct Folder(PathBuf);

    impl Folder {
        fn new(test: &str) -> Self {
            let path = std::env::temp_dir().join(format!("glassbrick-phantom-{}-{test}", std::process::id()));
            fs::create_dir_all(&path).unwrap();
            Self(path)
        }

        fn names(&self) -> Vec<String> {
            let name = |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
            fs::read_dir(&self.0).unwrap().map(name).collect()
        }
    }

    impl Drop for Folder {
        fn drop(&mut self) {
            fs::remove_dir_all(&self.0).unwrap();
        }
    }

    #[test]
    fn a_nrrd_says_where_the_voxels_lie_and_holds_them() {
        let folder = Folder::new("nrrd");
        let phantom = Phantom::new([24, 16, 20], 5);
        let mut shares = Vec::new();
        phantom.write_nrrd(&folder.0.join("body.nrrd"), |share| shares.push(share)).unwrap();
        let file = fs::read(folder.0.join("body.nrrd")).unwrap();
        let end = file.windows(2).position(|pair| pair == b"\n\n").unwrap();
        let header = std::str::from_utf8(&file[..end]).unwrap();
        let lines: Vec<_> = header.lines().collect();
        assert_eq!(lines[0], "NRRD0005");
        let [sx, sy, sz] = phantom.spacing_mm();
        let [ox, oy, oz] = phantom.origin_mm();
        for line in [
            "type: short",
            "dimension: 3",
            "space: left-posterior-superior",
            "sizes: 24 16 20",
            &format!("space directions: ({sx},0,0) (0,{sy},0) (0,0,{sz})"),
            "endian: little",
            "encoding: raw",
            &format!("space origin: ({ox},{oy},{oz})"),
        ] {
            assert!(lines.contains(&line), "{line} is missing in {header}");
        }
        let mut voxels = vec![0; 24 * 16 * 20];
        phantom.fill_slices(0, &mut voxels);
        let bytes: Vec<u8> = voxels.iter().flat_map(|hu| hu.to_le_bytes()).collect();
        assert_eq!(file[end + 2..], bytes);
        assert_eq!(shares.last(), Some(&1.0));
        assert_eq!(folder.names(), ["body.nrrd"]);
    }

    #[test]
    fn raw_u16_is_hounsfield_units_plus_1024() {
        let folder = Folder::new("raw");
        let phantom = Phantom::new([16, 12, 9], 5);
        let path = folder.0.join("body.raw");
        let words = |path: &Path| -> Vec<u16> {
            fs::read(path)
                .unwrap()
                .chunks_exact(2)
                .map(|pair| u16::from_le_bytes([pair[0], pair[1]]))
                .collect()
        };
        phantom.write_raw(&path, |_| {}).unwrap();
        let signed = words(&path);
        phantom.write_raw_u16(&path, |_| {}).unwrap();
        let unsigned = words(&path);
        assert_eq!(unsigned.len(), 16 * 12 * 9);
        assert!(signed.iter().zip(&unsigned).all(|(&s, &u)| i32::from(s as i16) + 1024 == i32::from(u)));
    }

    #[test]
    fn a_failed_write_leaves_what_was_there() {
        let folder = Folder::new("failed");
        let taken = folder.0.join("taken");
        fs::create_dir(&taken).unwrap();
        fs::write(taken.join("kept"), "kept").unwrap();
        let phantom = Phantom::new([4, 4, 4], 0);
        assert!(phantom.write_nrrd(&taken, |_| {}).is_err());
        assert!(phantom.write_nrrd(&folder.0.join("no folder").join("body.nrrd"), |_| {}).is_err());
        assert_eq!(folder.names(), ["taken"]);
        assert_eq!(fs::read_to_string(taken.join("kept")).unwrap(), "kept");
    }
}
