use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use glassbrick_volume::{
    Brick, BrickGrid, BrickId, BrickRange, BrickSource, ReadError, RowAxis, VolumeDesc, VoxelCountTable,
};
use quick_cache::sync::Cache;
use quick_cache::{DefaultHashBuilder, Lifecycle, OptionsBuilder, Weighter};
use rayon::prelude::*;

use crate::SourceError;
use crate::decode::brick_bytes;

/// A source whose bricks are kept in memory up to a byte budget, shared by all threads.
///
/// The budget holds the bricks that threads work on as well as those that are kept: each thread holds one brick at
/// a time.
pub struct CachedSource {
    source: Box<dyn BrickSource>,
    kept: Cache<KeptId, Arc<Brick>, ByBytes, DefaultHashBuilder, CountEvictions>,
    evictions: Arc<AtomicU64>,
    budget_bytes: u64,
    /// Of one brick.
    brick_bytes: u64,
    /// Of the bricks that threads work on.
    held_bytes: u64,
    peak_kept_bytes: AtomicU64,
    hits: AtomicU64,
    misses: AtomicU64,
    load_nanos: AtomicU64,
}

/// What went through a cache so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CacheCounts {
    pub budget_bytes: u64,
    pub peak_bytes: u64,
    pub hits: u64,
    pub misses: u64,
    pub evictions: u64,
    /// Summed over threads.
    pub load_time: Duration,
}

/// A brick may be kept along several axes.
type KeptId = (BrickId, RowAxis);

#[derive(Clone)]
struct ByBytes;

impl Weighter<KeptId, Arc<Brick>> for ByBytes {
    fn weight(&self, _id: &KeptId, brick: &Arc<Brick>) -> u64 {
        brick.bytes() as u64
    }
}

#[derive(Clone)]
struct CountEvictions(Arc<AtomicU64>);

impl Lifecycle<KeptId, Arc<Brick>> for CountEvictions {
    type RequestState = ();

    fn on_evict(&self, _state: &mut (), _id: KeptId, _brick: Arc<Brick>) {
        self.0.fetch_add(1, Ordering::Relaxed);
    }
}

impl CachedSource {
    /// Keeps at most `budget_bytes` of bricks for `threads` threads.
    ///
    /// # Errors
    /// When the budget does not hold a brick for each thread.
    pub fn new(source: Box<dyn BrickSource>, budget_bytes: u64, threads: usize) -> Result<Self, SourceError> {
        let layout = source.grid(0).layout;
        let one_brick = brick_bytes(source.desc().stored_type, layout);
        let held_bytes = one_brick * threads as u64;
        let Some(kept_bytes) = budget_bytes.checked_sub(held_bytes) else {
            return Err(SourceError::BudgetTooSmall { budget: budget_bytes, threads, needed: held_bytes });
        };
        let evictions = Arc::new(AtomicU64::new(0));
        let options = OptionsBuilder::new()
            .shards(1)
            .estimated_items_capacity((kept_bytes / one_brick).clamp(1, 1 << 20) as usize)
            .weight_capacity(kept_bytes)
            .build()
            .expect("all required options are set");
        let lifecycle = CountEvictions(Arc::clone(&evictions));
        Ok(Self {
            kept: Cache::with_options(options, ByBytes, DefaultHashBuilder::default(), lifecycle),
            source,
            evictions,
            budget_bytes,
            brick_bytes: one_brick,
            held_bytes,
            peak_kept_bytes: AtomicU64::new(0),
            hits: AtomicU64::new(0),
            misses: AtomicU64::new(0),
            load_nanos: AtomicU64::new(0),
        })
    }

    /// Where the bricks come from.
    pub fn source(&self) -> &dyn BrickSource {
        self.source.as_ref()
    }

    /// What went through the cache so far.
    pub fn counts(&self) -> CacheCounts {
        let get = |counter: &AtomicU64| counter.load(Ordering::Relaxed);
        let misses = get(&self.misses);
        CacheCounts {
            budget_bytes: self.budget_bytes,
            peak_bytes: get(&self.peak_kept_bytes) + if misses > 0 { self.held_bytes } else { 0 },
            hits: get(&self.hits),
            misses,
            evictions: get(&self.evictions),
            load_time: Duration::from_nanos(get(&self.load_nanos)),
        }
    }
}

impl CachedSource {
    fn load(&self, id: BrickId) -> Result<Arc<Brick>, ReadError> {
        let start = Instant::now();
        let brick = self.source.brick(id);
        self.load_nanos.fetch_add(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
        brick
    }

    /// Takes note of a brick that was asked for.
    fn count(&self, missed: bool) {
        if missed {
            self.misses.fetch_add(1, Ordering::Relaxed);
            self.peak_kept_bytes.fetch_max(self.kept.weight(), Ordering::Relaxed);
        } else {
            self.hits.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl BrickSource for CachedSource {
    fn desc(&self) -> &VolumeDesc {
        self.source.desc()
    }

    fn levels(&self) -> u32 {
        self.source.levels()
    }

    fn grid(&self, level: u32) -> BrickGrid {
        self.source.grid(level)
    }

    fn ranges(&self, level: u32) -> &[BrickRange] {
        self.source.ranges(level)
    }

    fn voxel_count_tables(&self, level: u32) -> Result<Arc<Vec<VoxelCountTable>>, ReadError> {
        self.source.voxel_count_tables(level)
    }

    fn brick(&self, id: BrickId) -> Result<Arc<Brick>, ReadError> {
        self.brick_along(id, RowAxis::X)
    }

    /// A brick that is kept along x is turned, not loaded again.
    fn brick_along(&self, id: BrickId, row_axis: RowAxis) -> Result<Arc<Brick>, ReadError> {
        let mut missed = false;
        let brick = self.kept.get_or_insert_with(&(id, row_axis), || {
            let kept = if row_axis == RowAxis::X { None } else { self.kept.get(&(id, RowAxis::X)) };
            missed = kept.is_none();
            let brick = kept.map_or_else(|| self.load(id), Ok)?;
            if brick.row_axis == row_axis {
                return Ok(brick);
            }
            Ok::<_, ReadError>(Arc::new(Arc::unwrap_or_clone(brick).along(row_axis)))
        })?;
        self.count(missed);
        Ok(brick)
    }

    /// Threads share what has to be loaded; what is kept is looked up before and put in after, one by one.
    fn bricks(&self, ids: &[BrickId]) -> Vec<Result<Arc<Brick>, ReadError>> {
        let kept: Vec<Option<Arc<Brick>>> = ids.iter().map(|&id| self.kept.get(&(id, RowAxis::X))).collect();
        let missed: Vec<bool> = kept.iter().map(Option::is_none).collect();
        let bricks: Vec<Result<Arc<Brick>, ReadError>> =
            ids.par_iter().zip(kept).map(|(&id, kept)| kept.map_or_else(|| self.load(id), Ok)).collect();
        for ((&id, brick), missed) in ids.iter().zip(&bricks).zip(missed) {
            if let Ok(brick) = brick {
                if missed {
                    self.kept.insert((id, RowAxis::X), Arc::clone(brick));
                }
                self.count(missed);
            }
        }
        bricks
    }

    fn will_need(&self, bricks: &[BrickId]) {
        let is_missing =
            |id: &BrickId| RowAxis::ALL.iter().all(|&axis| self.kept.peek(&(*id, axis)).is_none());
        let missing: Vec<BrickId> = bricks.iter().copied().filter(is_missing).collect();
        self.source.will_need(&missing);
    }

    fn can_hold(&self, bricks: usize) -> bool {
        self.brick_bytes.saturating_mul(bricks as u64) <= self.budget_bytes - self.held_bytes
    }

    fn not_finite(&self) -> u64 {
        self.source.not_finite()
    }

    fn bytes_read(&self) -> u64 {
        self.source.bytes_read()
    }
}

#[cfg(test)]
mod tests {
    use glam::UVec3;
    use glassbrick_volume::{BrickLayout, StoredType, Voxels};

    use super::*;
    use crate::FlatSource;

    /// One brick of 4³ voxels that count on, with memory for so many of its kind besides the one in use.
    fn cached(bricks: u64) -> CachedSource {
        let (layout, desc) =
            (BrickLayout { edge: 8, halo: 2 }, VolumeDesc::new(UVec3::splat(4), StoredType::U8));
        let source = FlatSource::from_array(desc, (0..64).collect(), layout).expect("a sound array");
        let budget = (bricks + 1) * brick_bytes(StoredType::U8, layout);
        CachedSource::new(Box::new(source), budget, 1).expect("there is room for a brick")
    }

    #[test]
    fn a_brick_that_is_kept_is_turned_and_not_loaded_again() {
        let source = cached(3);
        let id = BrickId::new(0, UVec3::ZERO);
        let brick = source.brick(id).expect("an array can be read");
        for row_axis in RowAxis::ALL {
            let turned = source.brick_along(id, row_axis).expect("an array can be read");
            assert_eq!(turned.row_axis, row_axis);
            assert_eq!(*turned, Brick::clone(&brick).along(row_axis));
            let again = source.brick_along(id, row_axis).expect("an array can be read");
            assert!(Arc::ptr_eq(&turned, &again), "{row_axis:?} is kept");
        }
        assert_eq!((source.counts().misses, source.counts().hits), (1, 6));
    }

    #[test]
    fn a_brick_that_is_asked_for_turned_is_kept_turned_only() {
        let source = cached(3);
        let id = BrickId::new(0, UVec3::ZERO);
        let turned = source.brick_along(id, RowAxis::Z).expect("an array can be read");
        let Voxels::U8(voxels) = &turned.voxels else { panic!("the voxels have the array's type") };
        // Behind the halo and one voxel along z, of which a slab has 16.
        assert_eq!(voxels[(2 * 8 + 2) * 8 + 3], 16);
        let again = source.brick_along(id, RowAxis::Z).expect("an array can be read");
        assert!(Arc::ptr_eq(&turned, &again));
        let CacheCounts { misses, peak_bytes, .. } = source.counts();
        assert_eq!((misses, peak_bytes), (1, 2 * turned.bytes() as u64), "it, and room for the one in use");
    }
}
