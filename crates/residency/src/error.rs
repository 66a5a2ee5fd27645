use std::io;

/// Why bricks cannot be made resident.
#[derive(Debug, thiserror::Error)]
pub enum ResidencyError {
    #[error(
        "thread {number} of {threads} that load bricks cannot be started: {source}; ask for fewer threads"
    )]
    NoThread { number: usize, threads: usize, source: io::Error },
}
