//! Measures glassbrick end to end: what `glassbrick bench` runs and writes.

mod results;

pub use results::{
    BenchResults, BenchSettings, BrickFractions, BrickStages, BudgetPoint, DataSetRecord, Difference,
    ExecutorRecord, Machine, NearlyEmptyPoint, Provenance, Residency, Run, SCHEMA, Spread, StageMs,
};
