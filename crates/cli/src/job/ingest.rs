use std::path::PathBuf;

use glassbrick::{BrickLayout, Codec, IngestSettings};

use crate::args::{CodecChoice, IngestArgs};
use crate::job::InputJob;

/// Which store is made of which volume.
pub struct IngestJob {
    pub input: PathBuf,
    pub output: PathBuf,
    pub settings: IngestSettings,
}

impl IngestJob {
    /// What the flags ask for.
    pub fn new(args: &IngestArgs) -> Self {
        let input = InputJob::new(&args.input, None);
        Self {
            output: args.output.clone(),
            settings: IngestSettings {
                format: input.settings.format,
                layout: BrickLayout { edge: args.input.opening.brick, halo: args.halo },
                codec: match args.codec {
                    CodecChoice::None => Codec::None,
                    CodecChoice::Lz4 => Codec::Lz4,
                    CodecChoice::Zstd => Codec::Zstd,
                },
                replace: args.force,
                resume: args.resume,
                threads: input.settings.threads,
            },
            input: input.path,
        }
    }
}
