use std::env;

use anyhow::Result;
use glassbrick::{Backend, Gpu};

use crate::args::BackendChoice;

/// Names the adapter that a GPU is chosen by.
const ADAPTER_VARIABLE: &str = "GLASSBRICK_ADAPTER";

/// What `--backend auto` draws on, and why.
pub fn auto_backend() -> (&'static str, String) {
    match (adapter_name(), Gpu::hardware()) {
        (Some(name), _) => ("gpu", format!("{ADAPTER_VARIABLE} names an adapter, \"{name}\"")),
        (None, Some(gpu)) => ("gpu", format!("there is {gpu}")),
        (None, None) => ("cpu", "no hardware GPU is found".to_owned()),
    }
}

/// Opens what draws. A driver that computes on the CPU is taken only when it is asked for, by `gpu` or by name.
///
/// # Errors
/// When a GPU is asked for and cannot be opened.
pub fn open_backend(choice: BackendChoice) -> Result<Backend> {
    Ok(match (choice, adapter_name()) {
        (BackendChoice::Cpu, _) => Backend::Cpu,
        (BackendChoice::Auto, None) => Backend::auto(),
        (BackendChoice::Auto | BackendChoice::Gpu, _) => Backend::Gpu(open_gpu()?),
    })
}

/// Opens the GPU that is named, or else the best, a driver that computes on the CPU if there is no other.
///
/// # Errors
/// When there is none.
pub fn open_gpu() -> Result<Gpu, glassbrick::Error> {
    Gpu::open(adapter_name().as_deref())
}

fn adapter_name() -> Option<String> {
    env::var(ADAPTER_VARIABLE).ok().filter(|name| !name.is_empty())
}
