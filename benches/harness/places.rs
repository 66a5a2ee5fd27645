use std::fs;
use std::path::{Path, PathBuf};

use crate::{BenchError, Task};

/// The folder of pictures beside bench.json.
const PICTURES: &str = "pictures";

/// The folder of the same pictures for the page.
const SMALLER: &str = "smaller";

/// A benchmark's scratch folder, which its processes share, and what is where in it.
#[derive(Clone, Debug)]
pub struct Places {
    pub scratch: PathBuf,
}

impl Places {
    /// Takes a folder and makes what is needed in it.
    ///
    /// # Errors
    /// When a folder cannot be made.
    pub fn new(scratch: &Path) -> Result<Self, BenchError> {
        for folder in [PICTURES, SMALLER] {
            let path = scratch.join(folder);
            fs::create_dir_all(&path).map_err(|source| BenchError::File { path, source })?;
        }
        Ok(Self { scratch: scratch.to_owned() })
    }

    /// Where a picture waits for the benchmark's end.
    pub fn picture(&self, file: &str) -> PathBuf {
        self.scratch.join(PICTURES).join(file)
    }

    /// Where the same picture waits in half its size, for the page.
    pub fn smaller_picture(&self, file: &str) -> PathBuf {
        self.scratch.join(SMALLER).join(file)
    }

    /// Where they end up.
    pub fn pictures_in(folder: &Path) -> PathBuf {
        folder.join(PICTURES)
    }

    /// The same as results name it.
    pub fn picture_in_results(file: &str) -> String {
        format!("{PICTURES}/{file}")
    }

    /// SW's picture of a task's data set and transfer function, in a view.
    pub fn pixels_of_sw(&self, task: Task, view: usize) -> PathBuf {
        self.scratch.join(format!("sw-{}-{}-{view}.rgba", task.data_set, task.transfer_function))
    }

    /// What a task says on stderr.
    pub fn complaints(&self, task: usize) -> PathBuf {
        self.scratch.join(format!("task-{task}.txt"))
    }
}
