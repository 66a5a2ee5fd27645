use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};

use glassbrick_phantom::Phantom;

use crate::places::Places;
use crate::plan::Origin;
use crate::record::Record;
use crate::{
    BenchError, BenchPlan, BenchResults, BenchSettings, DataSet, DataSetRecord, Executor, ExecutorRecord,
    Provenance, SCHEMA, Task,
};

/// Runs a plan, each task in a process of its own.
pub struct Runner<'a> {
    pub plan: &'a BenchPlan,
    /// A folder that is there, for files that are not kept; its pictures are moved to where results are written.
    pub scratch: &'a Path,
    /// Why no GPU executor can run here, if so.
    pub no_gpu: Option<String>,
    /// The command that does a task by [`work`](crate::work).
    pub worker: &'a dyn Fn(usize) -> Command,
    /// Hears what is done, and which share of all is, where that can be told.
    pub progress: &'a dyn Fn(&str, Option<f32>),
}

impl Runner<'_> {
    /// Measures everything. What an executor cannot do, or not of a data set, is said in its record, and the others go on.
    ///
    /// # Errors
    /// When a data set that is named cannot be opened, which is found out before anything is measured.
    pub fn run(&self, provenance: Provenance) -> Result<BenchResults, BenchError> {
        let places = Places::new(self.scratch)?;
        let mut results = BenchResults {
            schema: SCHEMA,
            provenance,
            settings: self.settings(),
            data_sets: Vec::new(),
            executors: Executor::ALL.map(|executor| self.executor_record(executor)).to_vec(),
            runs: Vec::new(),
            budgets: Vec::new(),
            nearly_empty: Vec::new(),
        };
        let mut described = Vec::new();
        for data_set in &self.plan.data_sets {
            described.push(match data_set.origin {
                Origin::File(_) => Some(self.describe(data_set)?),
                Origin::Generated(_) => None,
            });
        }
        let tasks: Vec<(usize, Task)> = self.plan.tasks().into_iter().enumerate().collect();
        let mut done =
            Done { results: 0, of: tasks.iter().map(|&(_, task)| self.plan.results_of(task)).sum() };
        for (index, (data_set, described)) in self.plan.data_sets.iter().zip(described).enumerate() {
            let tasks = tasks.iter().filter(|(_, task)| task.data_set == index).copied();
            let measured = self.describe_made(data_set, described).and_then(|described| {
                self.measure(data_set, described, tasks, &places, &mut results, &mut done)
            });
            if let Err(error) = measured {
                // What was measured of others is not lost for that.
                for &executor in self.plan.executors.iter().filter(|&&executor| self.can_run(executor)) {
                    let reasons = &mut results.executors[executor as usize].reasons;
                    reasons.push(format!("{}: {error}", data_set.name));
                }
            }
        }
        in_the_order_of_executors(&mut results);
        for record in &mut results.executors {
            record.ran = results.runs.iter().any(|run| run.executor == record.name);
        }
        Ok(results)
    }

    /// What a data set is; it is made before if it is generated.
    fn describe_made(
        &self,
        data_set: &DataSet,
        described: Option<Described>,
    ) -> Result<Described, BenchError> {
        if let Some(described) = described {
            return Ok(described);
        }
        if let Origin::Generated(phantom) = &data_set.origin {
            self.generate(phantom, data_set)?;
        }
        self.describe(data_set)
    }

    /// Does the tasks of a data set, and removes what was generated for it.
    fn measure(
        &self,
        data_set: &DataSet,
        Described { record, threads }: Described,
        tasks: impl Iterator<Item = (usize, Task)>,
        places: &Places,
        results: &mut BenchResults,
        done: &mut Done,
    ) -> Result<(), BenchError> {
        let names = record.transfer_functions.clone();
        results.settings.threads = threads;
        results.data_sets.push(record);
        for (number, task) in tasks {
            if self.can_run(task.executor) {
                let function = &names[task.transfer_function];
                let what = format!("{} {function} {}", data_set.name, task.executor.name());
                let told = |of_task| (self.progress)(&what, Some(done.share(of_task)));
                if let Err(why) = self.do_task(number, places, results, &told) {
                    results.executors[task.executor as usize].reasons.push(format!("{what}: {why}"));
                }
            }
            done.results += self.plan.results_of(task);
        }
        self.clear(data_set)
    }

    fn can_run(&self, executor: Executor) -> bool {
        self.no_gpu.is_none() || !executor.needs_gpu()
    }

    fn settings(&self) -> BenchSettings {
        let plan = self.plan;
        BenchSettings {
            size: plan.size,
            step: plan.step_voxels,
            opacity_cutoff: plan.settings.opacity_cutoff,
            mode: plan.settings.mode.name().to_owned(),
            shading: if plan.settings.shading.is_some() { "phong" } else { "off" }.to_owned(),
            repeat: plan.repeat,
            threads: 0,
            gpu_memory_bytes: plan.gpu_memory_bytes,
        }
    }

    fn executor_record(&self, executor: Executor) -> ExecutorRecord {
        let reason = if !self.plan.executors.contains(&executor) {
            Some(NOT_ASKED_FOR.to_owned())
        } else {
            self.no_gpu.clone().filter(|_| executor.needs_gpu())
        };
        ExecutorRecord {
            name: executor.name().to_owned(),
            summary: executor.summary().to_owned(),
            ran: false,
            reasons: reason.into_iter().collect(),
        }
    }

    fn generate(&self, phantom: &Phantom, data_set: &DataSet) -> Result<(), BenchError> {
        let path = data_set.path(self.scratch);
        let what = format!("making {}", data_set.name);
        let made = phantom.write_nrrd(&path, |_| (self.progress)(&what, None));
        made.map_err(|source| BenchError::File { path, source })
    }

    fn describe(&self, data_set: &DataSet) -> Result<Described, BenchError> {
        (self.progress)(&format!("opening {}", data_set.name), None);
        let volume = data_set.open(self.scratch, None)?;
        let desc = volume.desc();
        let functions = self.plan.transfer_functions(&volume)?;
        let source = match &data_set.origin {
            Origin::Generated(phantom) => format!("generated body, seed {}", phantom.seed),
            Origin::File(path) => format!("{} ({})", path.display(), volume.format()),
        };
        let record = DataSetRecord {
            name: data_set.name.clone(),
            source,
            extent: desc.extent.to_array(),
            spacing_mm: desc.spacing_mm.to_array(),
            dtype: desc.stored_type.name().to_owned(),
            bytes: desc.bytes(),
            bricks: volume.bricks().grid(0).len(),
            transfer_functions: functions.into_iter().map(|function| function.name).collect(),
        };
        Ok(Described { record, threads: volume.threads() })
    }

    /// Does a task in a process of its own, and takes in what that tells.
    fn do_task(
        &self,
        number: usize,
        places: &Places,
        results: &mut BenchResults,
        told: &dyn Fn(usize),
    ) -> Result<(), String> {
        told(0);
        let complaints_path = places.complaints(number);
        let complaints = File::create(&complaints_path).map_err(|error| error.to_string())?;
        let mut command = (self.worker)(number);
        let process = command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(complaints).spawn();
        let mut process = process.map_err(|error| format!("its process cannot be started: {error}"))?;
        let stdout = process.stdout.take().ok_or("its process has no stdout")?;
        // Drivers may print what they like between records: bytes that are no text, too.
        let records = BufReader::new(stdout).split(b'\n').map_while(Result::ok);
        let records = records.filter_map(|line| serde_json::from_slice(&line).ok());
        for (of_task, record) in records.enumerate() {
            match record {
                Record::Run(run) => results.runs.push(*run),
                Record::Budget(point) => results.budgets.push(*point),
                Record::NearlyEmpty(point) => results.nearly_empty.push(*point),
            }
            told(of_task + 1);
        }
        let status = process.wait().map_err(|error| error.to_string())?;
        if status.success() {
            return Ok(());
        }
        let complaints = fs::read_to_string(&complaints_path).unwrap_or_default();
        let last = complaints.lines().rfind(|line| !line.trim().is_empty());
        Err(match last {
            Some(last) => last.trim_start_matches("error: ").to_owned(),
            None => format!("its process ended with {status}"),
        })
    }

    /// Removes what a data set left behind that no other needs.
    fn clear(&self, data_set: &DataSet) -> Result<(), BenchError> {
        let generated = matches!(data_set.origin, Origin::Generated(_)).then(|| data_set.path(self.scratch));
        let entries = fs::read_dir(self.scratch).into_iter().flatten().flatten().map(|entry| entry.path());
        let of_sw = entries.filter(|path| path.extension().is_some_and(|extension| extension == "rgba"));
        for path in generated.into_iter().chain(of_sw) {
            fs::remove_file(&path).map_err(|source| BenchError::File { path, source })?;
        }
        Ok(())
    }
}

/// What a data set is.
struct Described {
    record: DataSetRecord,
    /// That work on it.
    threads: usize,
}

/// How many of a benchmark's results are there.
struct Done {
    results: usize,
    of: usize,
}

impl Done {
    /// The share that is done with so many of a task's.
    fn share(&self, of_task: usize) -> f32 {
        (self.results + of_task) as f32 / self.of.max(1) as f32
    }
}

/// Runs are done with SW first, and told with the executors in their own order.
fn in_the_order_of_executors(results: &mut BenchResults) {
    let place = |run: &crate::Run| {
        let data_set = results.data_sets.iter().position(|record| record.name == run.data_set);
        let functions = data_set.map(|place| &results.data_sets[place].transfer_functions);
        let function = functions.and_then(|names| names.iter().position(|name| *name == run.tf));
        (data_set, function, Executor::ALL.iter().position(|executor| executor.name() == run.executor))
    };
    results.runs.sort_by_cached_key(place);
}

/// The reason of executors that were left out on purpose.
pub const NOT_ASKED_FOR: &str = "not asked for";
