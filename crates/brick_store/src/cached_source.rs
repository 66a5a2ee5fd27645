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
    kept: Cache<BrickId, Arc<Brick>, ByBytes, DefaultHashBuilder, CountEvictions>,
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

#[derive(Clone)]
struct ByBytes;

impl Weighter<BrickId, Arc<Brick>> for ByBytes {
    fn weight(&self, _id: &BrickId, brick: &Arc<Brick>) -> u64 {
        brick.bytes() as u64
    }
}

#[derive(Clone)]
struct CountEvictions(Arc<AtomicU64>);

impl Lifecycle<BrickId, Arc<Brick>> for CountEvictions {
    type RequestState = ();

    fn on_evict(&self, _state: &mut (), _id: BrickId, _brick: Arc<Brick>) {
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

    /// A brick that is kept, with its rows along an axis. It is kept once: where they lie along another, it is turned, and
    /// kept so.
    fn turned(&self, id: BrickId, brick: Arc<Brick>, row_axis: RowAxis) -> Arc<Brick> {
        if brick.row_axis == row_axis {
            return brick;
        }
        // No longer kept, it belongs to this thread alone, unless another draws it just now.
        self.kept.remove(&id);
        let turned = brick.shared_along(row_axis);
        self.kept.insert(id, Arc::clone(&turned));
        turned
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

    fn brick_along(&self, id: BrickId, row_axis: RowAxis) -> Result<Arc<Brick>, ReadError> {
        let mut missed = false;
        let brick = self.kept.get_or_insert_with(&id, || {
            missed = true;
            self.load(id).map(|brick| brick.shared_along(row_axis))
        })?;
        self.count(missed);
        Ok(self.turned(id, brick, row_axis))
    }

    /// Threads share what has to be loaded; what is kept is looked up before and put in after, one by one.
    fn bricks(&self, ids: &[BrickId]) -> Vec<Result<Arc<Brick>, ReadError>> {
        let kept = |&id: &BrickId| Some(self.turned(id, self.kept.get(&id)?, RowAxis::X));
        let kept: Vec<Option<Arc<Brick>>> = ids.iter().map(kept).collect();
        let missed: Vec<bool> = kept.iter().map(Option::is_none).collect();
        let bricks: Vec<Result<Arc<Brick>, ReadError>> =
            ids.par_iter().zip(kept).map(|(&id, kept)| kept.map_or_else(|| self.load(id), Ok)).collect();
        for ((&id, brick), missed) in ids.iter().zip(&bricks).zip(missed) {
            if let Ok(brick) = brick {
                if missed {
                    self.kept.insert(id, Arc::clone(brick));
                }
                self.count(missed);
            }
        }
        bricks
    }

    fn will_need(&self, bricks: &[BrickId]) {
        let missing: Vec<BrickId> =
            bricks.iter().copied().filter(|id| self.kept.peek(id).is_none()).collect();
        self.source.will_need(&missing);
    }

    fn can_hold(&self, bricks: usize) -> bool {
        self.brick_bytes.saturating_mul(bricks as u64) <= self.budget_bytes - self.held_bytes
    }

    fn is_kept(&self, id: BrickId) -> bool {
        self.kept.contains_key(&id)
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
        assert!(!source.is_kept(id));
        let brick = Brick::clone(&source.brick(id).expect("an array can be read"));
        assert!(source.is_kept(id));
        for row_axis in [RowAxis::Z, RowAxis::Y, RowAxis::X] {
            let turned = source.brick_along(id, row_axis).expect("an array can be read");
            assert_eq!((turned.row_axis, &*turned), (row_axis, &brick.clone().along(row_axis)));
            let again = source.brick_along(id, row_axis).expect("an array can be read");
            assert!(Arc::ptr_eq(&turned, &again), "{row_axis:?} is kept");
            let together = source.bricks(&[id]).remove(0).expect("an array can be read");
            assert_eq!(*together, brick, "after {row_axis:?}");
        }
        let CacheCounts { misses, hits, evictions, peak_bytes, .. } = source.counts();
        assert_eq!((misses, hits, evictions), (1, 9, 0));
        assert_eq!(
            peak_bytes,
            2 * brick.bytes() as u64,
            "it is kept once, and there is room for the one in use"
        );
    }

    #[test]
    fn a_turned_brick_has_its_axes_swapped() {
        let turned =
            cached(3).brick_along(BrickId::new(0, UVec3::ZERO), RowAxis::Z).expect("an array can be read");
        let Voxels::U8(voxels) = &turned.voxels else { panic!("the voxels have the array's type") };
        // Behind the halo and one voxel along z, of which a slab has 16.
        assert_eq!(voxels[(2 * 8 + 2) * 8 + 3], 16);
    }
}
