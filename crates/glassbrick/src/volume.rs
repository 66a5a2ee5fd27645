use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use glassbrick_brick_store::{CachedSource, FlatSource, StoreDesc, StoreSource, is_zarr};
use glassbrick_formats::OpenOptions;
use glassbrick_volume::{BrickId, BrickLayout, BrickSource, VolumeDesc, VolumeReader, VoxelCountTable};
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
    pub(crate) source: Arc<CachedSource>,
    pub(crate) threads: Arc<ThreadPool>,
    pub(crate) opened_at: Instant,
    pub(crate) open_time: Duration,
    scan_time: Duration,
    /// What reports said already: the next one counts from here.
    pub(crate) reported: Mutex<Counters>,
    format: &'static str,
    notes: Vec<String>,
    store: Option<StoreDesc>,
}

impl Volume {
    /// Opens a brick store, a file or a folder of slices. All but stores are scanned once.
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
        if is_zarr(path) {
            let source = StoreSource::open(path)?;
            let store = source.store().clone();
            let (notes, scan_time) = (store.notes.clone(), Duration::ZERO);
            let volume =
                Self::new(Box::new(source), scan_time, settings, threads, STORE_FORMAT, notes, start)?;
            return Ok(Self { store: Some(store), ..volume });
        }
        let mut reader = glassbrick_formats::open(path, &settings.format)?;
        check_it_fits(path, reader.as_ref(), settings)?;
        let (format, notes) = (reader.format(), reader.notes().to_vec());
        let source = threads.install(|| FlatSource::open(reader.as_mut(), settings.layout, &mut progress))?;
        let scan_time = source.scan_time();
        Self::new(Box::new(source), scan_time, settings, threads, format, notes, start)
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
        let scan_time = source.scan_time();
        Self::new(Box::new(source), scan_time, settings, threads, "array", Vec::new(), start)
    }

    fn new(
        source: Box<dyn BrickSource>,
        scan_time: Duration,
        settings: &OpenSettings,
        threads: Arc<ThreadPool>,
        format: &'static str,
        notes: Vec<String>,
        start: Instant,
    ) -> Result<Self, Error> {
        let budget_bytes = settings.memory_bytes.unwrap_or_else(default_memory_bytes);
        let open_time = start.elapsed().saturating_sub(scan_time);
        let source = Arc::new(CachedSource::new(source, budget_bytes, threads.current_num_threads())?);
        let reported = Mutex::default();
        Ok(Self {
            source,
            threads,
            opened_at: start,
            open_time,
            scan_time,
            reported,
            format,
            notes,
            store: None,
        })
    }

    /// The volume's grid and place in the world.
    pub fn desc(&self) -> &VolumeDesc {
        self.source.desc()
    }

    /// The name of the format that it was opened from.
    pub fn format(&self) -> &'static str {
        self.format
    }

    /// What the store says of itself that it was opened from, if it was one.
    pub fn store(&self) -> Option<&StoreDesc> {
        self.store.as_ref()
    }

    /// What the user should know of how the input was understood, one sentence each.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// The bricks that it is cut into.
    pub fn bricks(&self) -> &dyn BrickSource {
        self.source.as_ref()
    }

    /// Smallest and largest value, exact.
    pub fn value_range(&self) -> [f64; 2] {
        crate::histogram::value_range(self.source.as_ref())
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

    /// Reads bricks of level 0 and measures it: bytes read from files and seconds for each, on average over a few.
    /// What threads do at once is counted as one after the other.
    ///
    /// # Errors
    /// When one cannot be read.
    pub fn measure_loading(&self, bricks: &[u32]) -> Result<(f64, f64), Error> {
        const MEASURED: usize = 16;
        let source = self.source.source();
        let chosen: Vec<u32> =
            bricks.iter().copied().step_by(bricks.len().div_ceil(MEASURED).max(1)).collect();
        if chosen.is_empty() {
            return Ok((0.0, 0.0));
        }
        let (start, read_before) = (Instant::now(), source.bytes_read());
        for &index in &chosen {
            source.brick(BrickId::new(0, source.grid(0).brick(index as usize)))?;
        }
        let per_brick = |sum: f64| sum / chosen.len() as f64;
        let read = source.bytes_read() - read_before;
        Ok((per_brick(read as f64), per_brick(start.elapsed().as_secs_f64())))
    }

    /// How many threads work on it.
    pub fn threads(&self) -> usize {
        self.threads.current_num_threads()
    }

    /// How long the one scan for the bricks' ranges took; a store has them at hand.
    pub fn scan_time(&self) -> Duration {
        self.scan_time
    }
}

/// The format's name of a brick store.
const STORE_FORMAT: &str = "brick store";

/// A quarter of the machine's memory.
fn default_memory_bytes() -> u64 {
    const WHERE_UNKNOWN: u64 = 4 << 30;
    process_memory::total_bytes().unwrap_or(WHERE_UNKNOWN) / 4
}

pub(crate) fn thread_pool(threads: Option<usize>) -> Result<Arc<ThreadPool>, Error> {
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
