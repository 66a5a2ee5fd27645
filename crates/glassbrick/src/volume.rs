use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use glassbrick_brick_store::{CachedSource, FlatSource};
use glassbrick_formats::OpenOptions;
use glassbrick_volume::{BrickLayout, BrickSource, VolumeDesc, VolumeReader, VoxelCountTable};
use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::renderer::Counters;
use crate::{Error, Histogram, process_memory};

/// How a volume is opened and held.
#[derive(Clone, Debug, Default)]
pub struct OpenSettings {
    /// What the format needs to be told.
    pub format: OpenOptions,
    /// How a source without stored bricks is cut.
    pub layout: BrickLayout,
    /// Memory for decoded bricks; a quarter of the machine's where nothing is said.
    pub memory_bytes: Option<u64>,
    /// As many as there are processors where nothing is said.
    pub threads: Option<usize>,
}

/// A volume that is ready to be drawn.
pub struct Volume {
    pub(crate) source: CachedSource<FlatSource>,
    pub(crate) threads: Arc<ThreadPool>,
    pub(crate) opened_at: Instant,
    pub(crate) open_time: Duration,
    /// What reports said already: the next one counts from here.
    pub(crate) reported: Mutex<Counters>,
    format: &'static str,
    notes: Vec<String>,
}

impl Volume {
    /// Opens a file, or a folder of slices, and scans it once.
    ///
    /// Uncompressed files are read in place, and must not be cut while the volume is open; others are read into
    /// memory, of which `progress` hears: bytes read, and of how many.
    ///
    /// # Errors
    /// When the input is no volume, is damaged, or does not fit into memory.
    pub fn open(
        path: &Path,
        settings: &OpenSettings,
        mut progress: impl FnMut(u64, u64) + Send,
    ) -> Result<Self, Error> {
        let start = Instant::now();
        process_memory::watch();
        let threads = thread_pool(settings.threads)?;
        let mut reader = glassbrick_formats::open(path, &settings.format)?;
        check_it_fits(path, reader.as_ref(), settings)?;
        let (format, notes) = (reader.format(), reader.notes().to_vec());
        let source = threads.install(|| FlatSource::open(reader.as_mut(), settings.layout, &mut progress))?;
        Self::new(source, settings, threads, format, notes, start)
    }

    /// Takes an array of stored voxels in this machine's byte order, x fastest.
    ///
    /// # Errors
    /// When the array's length is not what `desc` says.
    pub fn from_array(desc: VolumeDesc, voxels: Vec<u8>, settings: &OpenSettings) -> Result<Self, Error> {
        let start = Instant::now();
        process_memory::watch();
        let threads = thread_pool(settings.threads)?;
        let source = threads.install(|| FlatSource::from_array(desc, voxels, settings.layout))?;
        Self::new(source, settings, threads, "array", Vec::new(), start)
    }

    fn new(
        source: FlatSource,
        settings: &OpenSettings,
        threads: Arc<ThreadPool>,
        format: &'static str,
        notes: Vec<String>,
        start: Instant,
    ) -> Result<Self, Error> {
        let budget_bytes = settings.memory_bytes.unwrap_or_else(default_memory_bytes);
        let open_time = start.elapsed().saturating_sub(source.scan_time());
        let source = CachedSource::new(source, budget_bytes, threads.current_num_threads())?;
        let reported = Mutex::default();
        Ok(Self { source, threads, opened_at: start, open_time, reported, format, notes })
    }

    /// The volume's grid and place in the world.
    pub fn desc(&self) -> &VolumeDesc {
        self.source.desc()
    }

    /// The name of the format that it was opened from.
    pub fn format(&self) -> &'static str {
        self.format
    }

    /// What the user should know of how the input was understood, one sentence each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The bricks that it is cut into.
    pub fn bricks(&self) -> &dyn BrickSource {
        &self.source
    }

    /// Smallest and largest value, exact.
    pub fn value_range(&self) -> [f64; 2] {
        crate::histogram::value_range(&self.source)
    }

    /// How often values occur, estimated from a part of the voxels.
    ///
    /// # Errors
    /// When the voxels cannot be read.
    pub fn histogram(&self) -> Result<Histogram, Error> {
        // Past the cache, so that measuring leaves no trace in it.
        Ok(self.threads.install(|| Histogram::sample(self.source.source()))?)
    }

    /// The voxel-count table of every brick, by place in the grid.
    ///
    /// # Errors
    /// When the voxels cannot be read.
    pub fn voxel_count_tables(&self) -> Result<Arc<Vec<VoxelCountTable>>, Error> {
        Ok(self.threads.install(|| self.source.voxel_count_tables(0))?)
    }

    /// How long the one scan for the bricks' ranges took.
    pub fn scan_time(&self) -> Duration {
        self.source.source().scan_time()
    }
}

/// A quarter of the machine's memory.
fn default_memory_bytes() -> u64 {
    const WHERE_UNKNOWN: u64 = 4 << 30;
    process_memory::total_bytes().unwrap_or(WHERE_UNKNOWN) / 4
}

fn thread_pool(threads: Option<usize>) -> Result<Arc<ThreadPool>, Error> {
    let pool = ThreadPoolBuilder::new().num_threads(threads.unwrap_or(0)).build();
    pool.map(Arc::new).map_err(|source| Error::Threads { what: source.to_string() })
}

/// A volume that cannot be read in place must fit into memory beside its bricks.
fn check_it_fits(path: &Path, reader: &dyn VolumeReader, settings: &OpenSettings) -> Result<(), Error> {
    if reader.flat_placement().is_some() {
        return Ok(());
    }
    let needed_bytes = reader.desc().bytes();
    let Some(available_bytes) = process_memory::available_bytes() else {
        return Ok(());
    };
    if needed_bytes.saturating_add(settings.memory_bytes.unwrap_or(0)) > available_bytes {
        let path = path.to_owned();
        return Err(Error::DoesNotFit { path, needed_bytes, available_bytes });
    }
    Ok(())
}
