use serde::{Deserialize, Serialize};

use crate::{BudgetPoint, NearlyEmptyPoint, Run};

/// What a process of a benchmark tells the one that started it, a line of JSON each.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Record {
    Run(Box<Run>),
    Budget(Box<BudgetPoint>),
    NearlyEmpty(Box<NearlyEmptyPoint>),
}
