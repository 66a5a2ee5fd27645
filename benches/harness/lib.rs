//! Measures glassbrick end to end: what `glassbrick bench` runs and writes.
//!
//! A benchmark is a [`BenchPlan`]: data sets × transfer functions × views × executors, as data. A [`Runner`] does its tasks
//! one by one, each in a process of its own, which calls [`work`], so that the peak of memory is one executor's and a
//! driver that dies takes one task with it. What they find is a [`BenchResults`], which [`write_results`] writes as JSON,
//! CSV, plots and a page, and [`compare`] holds against another.
//!
//! This crate draws through `glassbrick` as its users do; only [`plain_caster`] forms a picture itself.

mod compare;
mod difference;
mod error;
mod executor;
mod frame_file;
mod machine;
mod measure;
mod output;
mod places;
pub mod plain_caster;
mod plan;
mod record;
mod results;
mod runner;
mod sweep;
mod view;
mod worker;
mod write;

pub use compare::{
    CompareError, Compared, ComparedGroup, ComparedTime, Comparison, NoLongerRun, TimeChange, compare,
    comparison_table,
};
pub use difference::difference;
pub use error::BenchError;
pub use executor::Executor;
pub use machine::provenance;
pub use output::{PagePicture, Plot, aligned, count, csv, page, plots, table};
pub use plan::{
    BenchPlan, DataSet, NamedTransferFunction, Origin, PAPER_EXTENTS, QUICK_EXTENTS, Task, TaskKind,
    in_file_names, with_distinct_names,
};
pub use runner::Runner;
pub use view::{View, views};
pub use worker::work;
pub use write::{check_folder, read_results, write_results};

pub use results::{
    BenchResults, BenchSettings, BrickFractions, BrickStages, BudgetPoint, DataSetRecord, Difference,
    ExecutorRecord, Machine, NearlyEmptyPoint, Provenance, Residency, Run, SCHEMA, Spread, StageMs,
};
