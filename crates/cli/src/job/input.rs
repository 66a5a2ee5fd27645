use std::path::PathBuf;

use glassbrick::{BrickLayout, Endian, OpenOptions, OpenSettings, RawLayout, Rescale, Volume};

use crate::args::{EndianChoice, InputArgs, OpeningArgs, RawArgs};
use crate::progress::Progress;

/// Which volume, and how it is opened.
pub struct InputJob {
    pub path: PathBuf,
    pub settings: OpenSettings,
}

impl InputJob {
    /// The volume that was named; `memory_bytes` for its decoded bricks.
    pub fn new(args: &InputArgs, memory_bytes: Option<u64>) -> Self {
        Self { path: args.path.clone(), settings: open_settings(&args.opening, memory_bytes) }
    }

    /// Opens the volume, and shows how far that is.
    ///
    /// # Errors
    /// When it cannot be opened.
    pub fn open(&self) -> Result<Volume, glassbrick::Error> {
        let progress = Progress::start("opening");
        Volume::open(&self.path, &self.settings, |done, total| progress.bytes(done, total))
    }
}

/// How volumes are opened; `memory_bytes` for their decoded bricks.
pub fn open_settings(args: &OpeningArgs, memory_bytes: Option<u64>) -> OpenSettings {
    OpenSettings {
        format: OpenOptions { raw: raw_layout(&args.raw), time: args.time },
        layout: BrickLayout { edge: args.brick, ..BrickLayout::default() },
        memory_bytes,
        threads: args.threads.map(|threads| threads as usize),
    }
}

fn raw_layout(args: &RawArgs) -> Option<RawLayout> {
    let (extent, stored_type) = args.extent.zip(args.dtype)?;
    let [slope, intercept] = args.rescale;
    Some(RawLayout {
        extent: extent.into(),
        stored_type,
        endian: match args.endian {
            EndianChoice::Little => Endian::Little,
            EndianChoice::Big => Endian::Big,
        },
        spacing_mm: args.spacing.into(),
        offset_bytes: args.offset,
        rescale: Rescale { slope, intercept },
    })
}
