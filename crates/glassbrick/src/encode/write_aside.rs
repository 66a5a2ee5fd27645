//! Files that appear whole or not at all: written under a name aside, renamed over the target at the end.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process;
use std::sync::atomic::{AtomicU64, Ordering};

use crate::Error;

/// A file in the making. Until it is committed, its target is as it was; dropped without, it is gone.
pub struct AsideFile {
    named: PathBuf,
    /// The file to replace: `named`, or what it links to.
    target: PathBuf,
    aside: PathBuf,
    file: File,
}

impl AsideFile {
    /// Opens a file aside of `path`, in the same folder.
    ///
    /// # Errors
    /// When `path` could not be replaced at the end, or its folder takes no file.
    pub fn create(path: &Path) -> Result<Self, Error> {
        let target = check_target(path)?;
        let (aside, file) =
            create_beside(&target).map_err(|source| Error::Write { path: path.to_owned(), source })?;
        let aside_file = Self { named: path.to_owned(), target, aside, file };
        if let Ok(old) = fs::metadata(&aside_file.target) {
            aside_file.file.set_permissions(old.permissions()).map_err(|source| aside_file.error(source))?;
        }
        Ok(aside_file)
    }

    /// What the user named.
    pub fn path(&self) -> &Path {
        &self.named
    }

    /// A buffered writer to the file, which must be flushed before `commit`.
    pub fn writer(&self) -> Result<BufWriter<File>, Error> {
        let file = self.file.try_clone().map_err(|source| self.error(source))?;
        Ok(BufWriter::with_capacity(1 << 16, file))
    }

    /// Puts the file in its target's place.
    pub fn commit(self) -> Result<(), Error> {
        // Some file systems tell only here that they are full; the target must still stand then.
        self.file.sync_all().map_err(|source| self.error(source))?;
        fs::rename(&self.aside, &self.target).map_err(|source| self.error(source))
    }

    /// What went wrong in writing, as an error that names the target.
    pub fn error(&self, source: io::Error) -> Error {
        Error::Write { path: self.named.clone(), source }
    }
}

impl Drop for AsideFile {
    fn drop(&mut self) {
        // After a commit there is nothing of that name left, and before it nobody is left to tell.
        let _ = fs::remove_file(&self.aside);
    }
}

/// Writes a whole file by `write`, which need not flush.
pub fn write_aside(
    path: &Path,
    write: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), Error> {
    let aside = AsideFile::create(path)?;
    let mut writer = aside.writer()?;
    write(&mut writer).and_then(|()| writer.flush()).map_err(|source| aside.error(source))?;
    aside.commit()
}

/// The file that writing to `path` would replace: itself, or what it links to.
///
/// # Errors
/// When its folder is missing, or `path` is there but is no file, or a write-protected one.
pub fn check_target(path: &Path) -> Result<PathBuf, Error> {
    let refuse = |what: String| Err(Error::Output { path: path.to_owned(), what });
    let fail = |source| Error::Write { path: path.to_owned(), source };
    if path.file_name().is_none() {
        return refuse("is not the name of a file; add one".to_owned());
    }
    let is_link = path.symlink_metadata().is_ok_and(|metadata| metadata.is_symlink());
    let target = if is_link { path.canonicalize().map_err(fail)? } else { path.to_owned() };
    match fs::metadata(&target) {
        Ok(old) if old.is_dir() => refuse("is a folder; give the name of a file in it".to_owned()),
        Ok(old) if !old.is_file() => refuse("is not a regular file; give another name".to_owned()),
        Ok(old) if old.permissions().readonly() => {
            refuse("is write-protected; allow writing or give another name".to_owned())
        }
        Ok(_) => Ok(target),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            let folder = folder_of(&target);
            match fs::metadata(folder) {
                Ok(metadata) if metadata.is_dir() => Ok(target),
                Ok(_) => refuse(format!("{} is not a folder; give another name", folder.display())),
                Err(_) => refuse(format!("there is no folder {}; make it first", folder.display())),
            }
        }
        Err(error) => Err(fail(error)),
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A file of a hidden name that is nobody else's: not another writer's, nor left over from one that was killed.
fn create_beside(target: &Path) -> io::Result<(PathBuf, File)> {
    static COUNTER: AtomicU64 = AtomicU64::new(0);
    loop {
        let number = COUNTER.fetch_add(1, Ordering::Relaxed);
        let aside = target.with_file_name(format!(".glassbrick-{}-{number}.part", process::id()));
        match OpenOptions::new().write(true).create_new(true).open(&aside) {
            Ok(file) => return Ok((aside, file)),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .expect("the folder is there")
            .map(|entry| entry.expect("a name").file_name().into_string().expect("ASCII"))
            .collect();
        names.sort();
        names
    }

    fn full_disk(writer: &mut BufWriter<File>) -> io::Result<()> {
        writer.write_all(b"half of a pic")?;
        Err(io::ErrorKind::StorageFull.into())
    }

    #[test]
    fn a_failure_leaves_what_was_there_and_nothing_else() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let path = folder.path().join("out.png");
        fs::write(&path, "old").expect("a scratch file");
        let error = write_aside(&path, full_disk).expect_err("the disk is full").to_string();
        assert!(error.contains("out.png") && error.contains("cannot be written"), "{error}");
        assert_eq!(error.lines().count(), 1);
        assert_eq!(fs::read(&path).expect("still there"), b"old");
        assert_eq!(names_in(folder.path()), ["out.png"]);
    }

    #[test]
    fn a_failure_leaves_nothing_where_nothing_was() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        write_aside(&folder.path().join("out.png"), full_disk).expect_err("the disk is full");
        assert!(names_in(folder.path()).is_empty());
    }

    #[test]
    fn success_replaces_the_whole_file() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let path = folder.path().join("out.png");
        fs::write(&path, "something longer than the next").expect("a scratch file");
        write_aside(&path, |writer| writer.write_all(b"next")).expect("it can be written");
        assert_eq!(fs::read(&path).expect("there"), b"next");
        assert_eq!(names_in(folder.path()), ["out.png"]);
    }

    #[test]
    fn a_folder_a_missing_folder_and_a_protected_file_are_refused() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let protected = folder.path().join("protected.png");
        fs::write(&protected, "old").expect("a scratch file");
        let mut permissions = fs::metadata(&protected).expect("there").permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&protected, permissions).expect("ours");
        for (path, word) in [
            (folder.path().to_owned(), "is a folder"),
            (folder.path().join("none/out.png"), "there is no folder"),
            (protected.join("out.png"), "cannot be written"),
            (protected, "write-protected"),
            (PathBuf::from("/"), "not the name of a file"),
        ] {
            let error = AsideFile::create(&path).err().expect("refused").to_string();
            assert!(error.contains(word) && error.contains(&*path.to_string_lossy()), "{error}");
        }
    }

    #[test]
    fn what_a_killed_writer_left_is_no_hindrance() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        for number in 0..100 {
            let left = folder.path().join(format!(".glassbrick-{}-{number}.part", process::id()));
            fs::write(left, "half").expect("a scratch file");
        }
        let path = folder.path().join("out.png");
        write_aside(&path, |writer| writer.write_all(b"next")).expect("it can be written");
        assert_eq!(names_in(folder.path()).len(), 101);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_linking_to_the_file_that_is_replaced() {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let (file, link) = (folder.path().join("file.png"), folder.path().join("link.png"));
        fs::write(&file, "old").expect("a scratch file");
        std::os::unix::fs::symlink(&file, &link).expect("a link");
        write_aside(&link, |writer| writer.write_all(b"next")).expect("it can be written");
        assert_eq!(fs::read(&file).expect("there"), b"next");
        assert!(fs::symlink_metadata(&link).expect("there").is_symlink());
    }
}
