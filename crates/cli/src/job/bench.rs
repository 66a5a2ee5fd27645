use std::path::PathBuf;

use anyhow::Result;
use glassbrick::{DEFAULT_GPU_MEMORY_BYTES, Mode, RenderSettings};
use glassbrick_benches::{
    BenchPlan, DataSet, Executor, NamedTransferFunction, PAPER_EXTENTS, QUICK_EXTENTS, in_file_names, views,
    with_distinct_names,
};

use super::input::open_settings;
use super::settings::{mode, shading};
use super::transfer_function_choice;
use crate::args::{BenchArgs, ExecutorChoice};
use crate::usage::UsageError;

/// What is to be measured or compared.
pub enum BenchJob {
    Measure {
        plan: BenchPlan,
        folder: PathBuf,
    },
    /// One task of a plan, for the process that measures all of it.
    Task {
        plan: BenchPlan,
        task: usize,
        scratch: PathBuf,
    },
    Compare {
        old: PathBuf,
        new: PathBuf,
        tolerance: f64,
    },
}

/// What times of one machine differ by, from one hour to the next.
const DEFAULT_TOLERANCE: f64 = 0.1;

/// How much is measured where flags do not say it.
struct Scale {
    extents: [[u32; 3]; 3],
    size: [u32; 2],
    views: u32,
    repeat: u32,
}

const FULL: Scale = Scale { extents: PAPER_EXTENTS, size: [512, 512], views: 8, repeat: 5 };
const QUICK: Scale = Scale { extents: QUICK_EXTENTS, size: [256, 256], views: 4, repeat: 3 };

impl BenchJob {
    /// # Errors
    /// When flags contradict each other, or a file that is named cannot be used.
    pub fn new(args: &BenchArgs) -> Result<Self> {
        if let Some([old, new]) = args.compare.as_deref() {
            let tolerance = args.tolerance.unwrap_or(DEFAULT_TOLERANCE);
            return Ok(Self::Compare { old: old.clone(), new: new.clone(), tolerance });
        }
        if args.tolerance.is_some() {
            return Err(UsageError("--tolerance concerns --compare alone".to_owned()).into());
        }
        let plan = plan(args)?;
        if let Some((task, scratch)) = args.task.zip(args.scratch.clone()) {
            if task >= plan.tasks().len() {
                return Err(UsageError(format!("--task {task}: the plan has no such task")).into());
            }
            return Ok(Self::Task { plan, task, scratch });
        }
        let folder = args.output.clone().unwrap_or_default();
        Ok(Self::Measure { plan, folder })
    }
}

fn plan(args: &BenchArgs) -> Result<BenchPlan> {
    let scale = if args.quick { QUICK } else { FULL };
    let mode = mode(args.drawing.mode);
    let shading = shading(args.drawing.shading);
    if shading.is_some() && mode != Mode::Dvr {
        return Err(UsageError("--shading concerns mode dvr alone".to_owned()).into());
    }
    let opacity_cutoff = args.drawing.opacity_cutoff;
    Ok(BenchPlan {
        data_sets: data_sets(args, &scale),
        transfer_functions: transfer_functions(args)?,
        executors: executors(&args.executors),
        views: views(args.views.unwrap_or(scale.views)),
        size: args.size.unwrap_or(scale.size),
        step_voxels: args.drawing.step,
        settings: RenderSettings { mode, shading, opacity_cutoff, ..RenderSettings::default() },
        gpu_memory_bytes: args.drawing.gpu_memory.unwrap_or(DEFAULT_GPU_MEMORY_BYTES),
        repeat: args.repeat.unwrap_or(scale.repeat) as usize,
    })
}

fn data_sets(args: &BenchArgs, scale: &Scale) -> Vec<DataSet> {
    let settings = open_settings(&args.opening, args.drawing.memory);
    let extents = if args.inputs.is_empty() && args.phantom.is_empty() {
        scale.extents.to_vec()
    } else {
        args.phantom.clone()
    };
    // What is generated says itself what it is.
    let mut of_generated = settings.clone();
    (of_generated.format.raw, of_generated.format.time) = (None, None);
    let files = args.inputs.iter().map(|path| DataSet::file(path, settings.clone()));
    let generated = extents.into_iter().map(|extent| DataSet::generated(extent, of_generated.clone()));
    with_distinct_names(files.chain(generated).collect())
}

fn transfer_functions(args: &BenchArgs) -> Result<Option<Vec<NamedTransferFunction>>> {
    let named = |name: &String| {
        let stem = PathBuf::from(name).file_stem().map(|stem| in_file_names(&stem.to_string_lossy()));
        let choice = transfer_function_choice(name)?;
        Ok(NamedTransferFunction { name: stem.unwrap_or_else(|| name.clone()), choice })
    };
    let mut functions = args.tf.iter().map(named).collect::<Result<Vec<_>>>()?;
    for index in 1..functions.len() {
        let (before, rest) = functions.split_at_mut(index);
        if before.iter().any(|other| other.name == rest[0].name) {
            rest[0].name = format!("{}-{}", rest[0].name, index + 1);
        }
    }
    Ok((!functions.is_empty()).then_some(functions))
}

fn executors(choices: &[ExecutorChoice]) -> Vec<Executor> {
    let executor = |choice: &ExecutorChoice| match choice {
        ExecutorChoice::Hw => Executor::Hw,
        ExecutorChoice::Sw => Executor::Sw,
        ExecutorChoice::Slices => Executor::Slices,
        ExecutorChoice::Raycast => Executor::Raycast,
        ExecutorChoice::Cpu => Executor::Cpu,
    };
    let chosen: Vec<Executor> = choices.iter().map(executor).collect();
    Executor::ALL.into_iter().filter(|executor| chosen.is_empty() || chosen.contains(executor)).collect()
}
