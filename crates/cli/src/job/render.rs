use std::path::{Path, PathBuf};

use anyhow::Result;
use glassbrick::{
    Backend, Background, DEFAULT_GPU_MEMORY_BYTES, GpuPass, LevelChoice, NearlyEmpty, RenderRequest,
    RenderSettings, TransferFunction, TransferFunctionChoice, check_text_file,
};

use super::output::check_nothing_read_is_overwritten;
use super::settings::{gpu_pass, idle_flags, idle_flags_on_cpu, render_settings};
use super::{InputJob, Output, View, transfer_function_choice};
use crate::args::{BackendChoice, RenderArgs};
use crate::usage::UsageError;

/// Which pictures of which volume, and where they go.
pub struct RenderJob {
    pub input: InputJob,
    pub transfer_function: TransferFunctionChoice,
    pub view: View,
    pub size: [u32; 2],
    pub step_voxels: f64,
    pub settings: RenderSettings,
    pub nearly_empty: NearlyEmpty,
    pub level: LevelChoice,
    pub allow_damaged: bool,
    pub backend: BackendChoice,
    pub pass: GpuPass,
    pub gpu_memory_bytes: u64,
    pub repeat: usize,
    pub background: Background,
    pub output: Output,
    pub report: Option<PathBuf>,
    /// What the user should know of the flags, one sentence each.
    pub warnings: Vec<String>,
    /// What the user should know of them where the CPU draws.
    pub warnings_on_cpu: Vec<String>,
}

impl RenderJob {
    /// # Errors
    /// When flags contradict each other, or a file that is named cannot be used.
    pub fn new(args: &RenderArgs) -> Result<Self> {
        let background = args.background.unwrap_or_default();
        let output = Output::new(&args.output, args.frames, background)?;
        check_report(args, &output)?;
        Ok(Self {
            input: InputJob::new(&args.input, args.drawing.memory),
            transfer_function: transfer_function_choice(&args.tf)?,
            view: View::new(&args.view)?,
            size: args.size,
            step_voxels: args.drawing.step,
            settings: render_settings(args),
            nearly_empty: NearlyEmpty { alpha: args.alpha, beta: args.beta },
            level: args.level,
            allow_damaged: args.allow_damaged,
            backend: args.backend,
            pass: gpu_pass(args),
            gpu_memory_bytes: args.drawing.gpu_memory.unwrap_or(DEFAULT_GPU_MEMORY_BYTES),
            repeat: args.repeat as usize,
            background,
            warnings: idle_flags(args, output.keeps_alpha()),
            warnings_on_cpu: idle_flags_on_cpu(args),
            output,
            report: args.report.clone(),
        })
    }

    /// What is to be drawn with a transfer function, and on what.
    pub fn request(&self, transfer_function: TransferFunction, backend: Backend) -> RenderRequest {
        RenderRequest {
            size: self.size,
            step_voxels: self.step_voxels,
            settings: self.settings,
            nearly_empty: self.nearly_empty,
            level: self.level,
            allow_damaged: self.allow_damaged,
            backend,
            pass: self.pass,
            gpu_memory_bytes: self.gpu_memory_bytes,
            ..RenderRequest::new(transfer_function)
        }
    }
}

fn check_report(args: &RenderArgs, output: &Output) -> Result<()> {
    if let Some(report) = &args.report {
        if output.files().contains(report) {
            let what =
                format!("{}: is named for the picture and for the report; name two files", report.display());
            return Err(UsageError(what).into());
        }
        check_text_file(report)?;
    }
    let read = [Some(args.input.path.as_path()), Some(Path::new(&args.tf)), args.view.camera.as_deref()];
    let read: Vec<&Path> = read.into_iter().flatten().collect();
    check_nothing_read_is_overwritten(output.files().iter().chain(&args.report), &read)
}
