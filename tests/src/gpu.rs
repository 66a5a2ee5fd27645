//! The GPU that tests draw on.

use std::env;
use std::sync::OnceLock;

use glassbrick::Gpu;

use crate::skipped::skipped;

/// Names the adapter, as it does for the command.
pub const ADAPTER_VARIABLE: &str = "GLASSBRICK_ADAPTER";

/// The adapter that `GLASSBRICK_ADAPTER` names, or else the best, drivers that compute on the CPU included. Where there
/// is none, the test that asks says that it is skipped, and fails in CI.
///
/// Opening takes a third of a second, so it is done once, and all tests draw on the same device, at once. What a driver
/// complains of, one of those tests is told by an error that it does not expect.
///
/// # Panics
/// When the adapter that is named cannot be opened; without any in CI.
pub fn gpu() -> Option<&'static Gpu> {
    static OPENED: OnceLock<Result<Gpu, String>> = OnceLock::new();
    let name = env::var(ADAPTER_VARIABLE).ok().filter(|name| !name.is_empty());
    let opened = OPENED.get_or_init(|| Gpu::open(name.as_deref()).map_err(|error| error.to_string()));
    match opened {
        Ok(gpu) => Some(gpu),
        Err(missing) => {
            assert!(name.is_none(), "{missing}");
            skipped(missing);
            None
        }
    }
}
