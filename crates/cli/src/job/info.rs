use crate::args::InfoArgs;
use crate::job::{InputJob, transfer_function_choice};
use glassbrick::TransferFunctionChoice;

/// What is to be told of which volume.
pub struct InfoJob {
    pub input: InputJob,
    pub json: bool,
    pub transfer_function: Option<TransferFunctionChoice>,
}

impl InfoJob {
    /// # Errors
    /// When a file that is named cannot be used.
    pub fn new(args: &InfoArgs) -> anyhow::Result<Self> {
        Ok(Self {
            input: InputJob::new(&args.input, None),
            json: args.json,
            transfer_function: args.tf.as_deref().map(transfer_function_choice).transpose()?,
        })
    }
}
