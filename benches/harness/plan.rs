use std::path::{Path, PathBuf};

use glassbrick::{
    Backend, LevelChoice, Mode, OpenSettings, RenderRequest, RenderSettings, TransferFunction,
    TransferFunctionChoice, Volume, has_hounsfield_units,
};
use glassbrick_phantom::Phantom;

use crate::sweep::{CPU_BUDGETS_BYTES, NEARLY_EMPTY, TEXTURE_COUNTS};
use crate::{BenchError, Executor, View};

/// The phantoms of the paper's three sizes (Xie, Yang and Zhu 2007).
pub const PAPER_EXTENTS: [[u32; 3]; 3] = [[512, 512, 426], [512, 512, 512], Phantom::VISIBLE_HUMAN];

/// Quarters of them, for a first look.
pub const QUICK_EXTENTS: [[u32; 3]; 3] = [[128, 128, 107], [128, 128, 128], [128, 76, 432]];

const SEED: u64 = 1;

/// The transfer functions of a CT in Hounsfield units: opaque bone, opaque skin, see-through.
const CT: [&str; 3] = ["ct-bone", "ct-skin", "haze"];

/// Those of anything else: made from its histogram, see-through, and as grey as the value is high.
const ANY: [&str; 3] = ["auto", "mr", "grey"];

/// What is measured, as data: every process of a benchmark makes the same plan of the same command.
#[derive(Clone, Debug)]
pub struct BenchPlan {
    pub data_sets: Vec<DataSet>,
    /// In place of those that suit each data set.
    pub transfer_functions: Option<Vec<NamedTransferFunction>>,
    /// In the order of [`Executor::ALL`].
    pub executors: Vec<Executor>,
    pub views: Vec<View>,
    pub size: [u32; 2],
    pub step_voxels: f64,
    pub settings: RenderSettings,
    pub gpu_memory_bytes: u64,
    /// How often a picture is drawn for its times, at most, after the first.
    pub repeat: usize,
}

/// A volume to draw.
#[derive(Clone, Debug)]
pub struct DataSet {
    /// Unlike any other's, and sound as a part of a file's name.
    pub name: String,
    pub origin: Origin,
    pub settings: OpenSettings,
}

/// Where a volume comes from.
#[derive(Clone, Debug)]
pub enum Origin {
    Generated(Phantom),
    File(PathBuf),
}

/// A transfer function and what it is called in results.
#[derive(Clone, Debug)]
pub struct NamedTransferFunction {
    pub name: String,
    pub choice: TransferFunctionChoice,
}

/// What one process measures, and nothing else, so that its memory is that of it alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Task {
    /// Places in the plan.
    pub data_set: usize,
    pub transfer_function: usize,
    pub executor: Executor,
    pub kind: TaskKind,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TaskKind {
    /// Every view.
    Views,
    /// The first view with memories of several sizes.
    Budgets,
    /// The first view with several α and β.
    NearlyEmpty,
}

impl DataSet {
    /// A body of so many voxels.
    pub fn generated(extent: [u32; 3], settings: OpenSettings) -> Self {
        let [x, y, z] = extent;
        let origin = Origin::Generated(Phantom::new(extent, SEED));
        Self { name: format!("phantom-{x}x{y}x{z}"), origin, settings }
    }

    /// A volume from a file, folder or store.
    pub fn file(path: &Path, settings: OpenSettings) -> Self {
        let name = path.file_stem().map_or_else(|| "volume".into(), |stem| stem.to_string_lossy());
        Self { name: in_file_names(&name), origin: Origin::File(path.to_owned()), settings }
    }

    /// Where its voxels are, in a benchmark whose scratch files are in `scratch`.
    pub fn path(&self, scratch: &Path) -> PathBuf {
        match &self.origin {
            Origin::Generated(_) => scratch.join(format!("{}.nrrd", self.name)),
            Origin::File(path) => path.clone(),
        }
    }

    /// Opens it.
    ///
    /// # Errors
    /// When it cannot be opened.
    pub fn open(&self, scratch: &Path, memory_bytes: Option<u64>) -> Result<Volume, BenchError> {
        let memory_bytes = memory_bytes.or(self.settings.memory_bytes);
        let settings = OpenSettings { memory_bytes, ..self.settings.clone() };
        Ok(Volume::open(&self.path(scratch), &settings, |_, _| ())?)
    }
}

/// Gives data sets of one name numbers.
pub fn with_distinct_names(mut data_sets: Vec<DataSet>) -> Vec<DataSet> {
    for index in 1..data_sets.len() {
        let (before, rest) = data_sets.split_at_mut(index);
        let is_taken = |name: &str| before.iter().any(|other| other.name == name);
        let plain = rest[0].name.clone();
        let mut number = 2;
        while is_taken(&rest[0].name) {
            rest[0].name = format!("{plain}-{number}");
            number += 1;
        }
    }
    data_sets
}

/// A name with what file systems and pages may take amiss replaced.
pub fn in_file_names(name: &str) -> String {
    let sound = |c: char| if c.is_ascii_alphanumeric() || "._-".contains(c) { c } else { '_' };
    let name: String = name.chars().map(sound).collect();
    let name = name.trim_start_matches('.');
    if name.is_empty() { "volume".to_owned() } else { name.to_owned() }
}

impl BenchPlan {
    /// Every task, in the order in which they are done: of each picture, SW's first, for the others are compared with it.
    pub fn tasks(&self) -> Vec<Task> {
        let mut tasks = Vec::new();
        let sw_first = |executor: &Executor| *executor != Executor::Sw;
        let mut executors = self.executors.clone();
        executors.sort_by_key(sw_first);
        let last = self.transfer_functions_each() - 1;
        for data_set in 0..self.data_sets.len() {
            for transfer_function in 0..=last {
                let mut add = |executor, kind| {
                    tasks.push(Task { data_set, transfer_function, executor, kind });
                };
                for &executor in &executors {
                    add(executor, TaskKind::Views);
                }
                // An opaque picture and a see-through one.
                let with_budgets = executors.iter().filter(|executor| {
                    matches!(executor, Executor::Slices | Executor::Raycast | Executor::Cpu)
                });
                if transfer_function == 0 || transfer_function == last {
                    with_budgets.for_each(|&executor| add(executor, TaskKind::Budgets));
                }
                if self.settings.mode == Mode::Dvr && executors.contains(&Executor::Cpu) {
                    add(Executor::Cpu, TaskKind::NearlyEmpty);
                }
            }
        }
        tasks
    }

    /// How many transfer functions each data set is drawn with.
    fn transfer_functions_each(&self) -> usize {
        match &self.transfer_functions {
            Some(functions) => functions.len(),
            None if self.settings.mode == Mode::Dvr => CT.len(),
            None => 1,
        }
    }

    /// The transfer functions for a volume.
    ///
    /// # Errors
    /// When its voxels cannot be read.
    pub fn transfer_functions(&self, volume: &Volume) -> Result<Vec<NamedTransferFunction>, BenchError> {
        if let Some(functions) = &self.transfer_functions {
            return Ok(functions.clone());
        }
        let names: &[&str] = match self.settings.mode {
            Mode::Dvr if has_hounsfield_units(&volume.histogram()?) => &CT,
            Mode::Dvr => &ANY,
            Mode::Mip | Mode::Minip | Mode::Mean => &[TransferFunctionChoice::AUTO],
        };
        let named = |name: &&str| NamedTransferFunction {
            name: (*name).to_owned(),
            choice: TransferFunctionChoice::named(name).expect("the names above are of presets"),
        };
        Ok(names.iter().map(named).collect())
    }

    /// What an executor draws.
    pub fn request(
        &self,
        transfer_function: TransferFunction,
        executor: Executor,
        backend: Backend,
    ) -> RenderRequest {
        let request = RenderRequest {
            size: self.size,
            step_voxels: self.step_voxels,
            settings: self.settings,
            level: LevelChoice::Exact(0),
            gpu_memory_bytes: self.gpu_memory_bytes,
            ..RenderRequest::new(transfer_function)
        };
        executor.request(request, backend)
    }

    /// The executor of which every view's picture is kept; of the others, the first view's.
    pub fn gallery_executor(&self) -> Option<Executor> {
        [Executor::Cpu, Executor::Raycast, Executor::Slices, Executor::Sw, Executor::Hw]
            .into_iter()
            .find(|executor| self.executors.contains(executor))
    }

    /// How many results a task gives.
    pub fn results_of(&self, task: Task) -> usize {
        match task.kind {
            TaskKind::Views => self.views.len(),
            TaskKind::Budgets if task.executor == Executor::Cpu => CPU_BUDGETS_BYTES.len(),
            TaskKind::Budgets => TEXTURE_COUNTS.len(),
            TaskKind::NearlyEmpty => NEARLY_EMPTY.len(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::views;

    fn plan() -> BenchPlan {
        BenchPlan {
            data_sets: QUICK_EXTENTS
                .map(|extent| DataSet::generated(extent, OpenSettings::default()))
                .to_vec(),
            transfer_functions: None,
            executors: Executor::ALL.to_vec(),
            views: views(2),
            size: [64, 64],
            step_voxels: 1.0,
            settings: RenderSettings::default(),
            gpu_memory_bytes: 1 << 26,
            repeat: 1,
        }
    }

    #[test]
    fn what_others_are_compared_with_is_drawn_before_them() {
        let tasks = plan().tasks();
        for (place, task) in tasks.iter().enumerate().filter(|(_, task)| task.executor != Executor::Sw) {
            let its_sw = Task { executor: Executor::Sw, kind: TaskKind::Views, ..*task };
            assert!(tasks[..place].contains(&its_sw), "{task:?}");
        }
        assert_eq!(tasks.iter().filter(|task| task.kind == TaskKind::Views).count(), 3 * 3 * 5);
    }

    #[test]
    fn projections_have_one_transfer_function_and_nothing_to_drop() {
        let settings = RenderSettings { mode: Mode::Mip, ..RenderSettings::default() };
        let tasks = BenchPlan { settings, ..plan() }.tasks();
        assert!(tasks.iter().all(|task| task.transfer_function == 0 && task.kind != TaskKind::NearlyEmpty));
    }

    #[test]
    fn files_of_one_name_are_told_apart() {
        let file = |path| DataSet::file(Path::new(path), OpenSettings::default());
        let named =
            with_distinct_names(vec![file("a/x.nrrd"), file("b/x.nii"), file("c/x.zarr"), file("x-2.raw")]);
        let names: Vec<&str> = named.iter().map(|data_set| data_set.name.as_str()).collect();
        assert_eq!(names, ["x", "x-2", "x-3", "x-2-2"]);
    }

    #[test]
    fn names_cannot_leave_their_folder() {
        assert_eq!(in_file_names("../../<b>"), "_..__b_");
        assert_eq!(in_file_names(".."), "volume");
    }
}
