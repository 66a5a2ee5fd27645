use std::io::Write;
use std::path::Path;

use glassbrick::{Backend, Gpu};

use crate::measure::Measurement;
use crate::places::Places;
use crate::record::Record;
use crate::sweep::texture_bytes;
use crate::{BenchError, BenchPlan, Executor, TaskKind};

/// SW keeps the whole volume itself.
const SW_MEMORY_BYTES: u64 = 16 << 20;

/// Does one task of a plan and writes what it finds to `out`, a line each: what a process does that a benchmark started.
///
/// # Errors
/// When the task cannot be done, with the reason.
pub fn work(
    plan: &BenchPlan,
    task: usize,
    scratch: &Path,
    open_gpu: impl FnOnce() -> Result<Gpu, glassbrick::Error>,
    mut out: impl Write,
) -> Result<(), BenchError> {
    let task = plan.tasks()[task];
    let places = Places::new(scratch)?;
    let data_set = &plan.data_sets[task.data_set];
    let memory_bytes = (task.executor == Executor::Sw).then_some(SW_MEMORY_BYTES);
    let volume = data_set.open(scratch, memory_bytes)?;
    let backend = if task.executor.needs_gpu() { Backend::Gpu(open_gpu()?) } else { Backend::Cpu };
    let named = plan.transfer_functions(&volume)?.swap_remove(task.transfer_function);
    let function = named.choice.for_volume(&volume, plan.settings.mode)?;
    let request = plan.request(function, task.executor, backend);
    let measurement = Measurement { plan, task, tf: &named.name, places: &places };
    let mut tell = |record: Record| {
        let line = serde_json::to_string(&record).expect("records are plain data");
        let told = writeln!(out, "{line}").and_then(|()| out.flush());
        told.map_err(|source| BenchError::File { path: "stdout".into(), source })
    };
    match task.kind {
        TaskKind::Views => measurement.views(&volume, request, |run| tell(Record::Run(Box::new(run)))),
        TaskKind::Budgets => {
            let texture_bytes = texture_bytes(volume.desc());
            drop(volume);
            measurement.budgets(&request, texture_bytes, |point| tell(Record::Budget(Box::new(point))))
        }
        TaskKind::NearlyEmpty => {
            measurement.nearly_empty(&volume, &request, |point| tell(Record::NearlyEmpty(Box::new(point))))
        }
    }
}
