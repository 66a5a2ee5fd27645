use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use glam::UVec2;
use glassbrick_cpu::ShownCells;
use glassbrick_volume::{
    BakedTransferFunction, BrickSource, Camera, Mode, Skip, VisibleBricks, all_bricks, filtered_visible,
    without_nearly_empty,
};
use rayon::prelude::*;

use crate::{Error, LevelChoice, RenderRequest, Volume};

/// Bricks that a thread looks up in their tables before it takes more.
const BRICKS_AT_ONCE: usize = 4096;

/// What a transfer function can see of each level, found when the level is first drawn.
pub struct VisibleLevels {
    found: Mutex<Found>,
}

/// What a transfer function can see of a level.
pub struct VisibleLevel {
    pub bricks: VisibleBricks,
    /// Found brick by brick, as they are drawn.
    pub cells: ShownCells,
}

#[derive(Default)]
struct Found {
    levels: BTreeMap<u32, Arc<VisibleLevel>>,
    time: Duration,
}

impl VisibleLevels {
    /// Nothing is known of any level.
    pub fn new() -> Self {
        Self { found: Mutex::default() }
    }

    /// The bricks of a level that are worth drawing.
    ///
    /// # Errors
    /// When tables cannot be read.
    pub fn at(
        &self,
        volume: &Volume,
        level: u32,
        request: &RenderRequest,
        transfer_function: &BakedTransferFunction,
    ) -> Result<Arc<VisibleLevel>, Error> {
        let mut found = self.found.lock().expect("nothing panics while it is held");
        if let Some(visible) = found.levels.get(&level) {
            return Ok(Arc::clone(visible));
        }
        let start = Instant::now();
        let bricks = volume.threads.install(|| visible_bricks(volume, level, request, transfer_function))?;
        let cells = ShownCells::new(volume.source.grid(level).len());
        let visible = Arc::new(VisibleLevel { bricks, cells });
        found.levels.insert(level, Arc::clone(&visible));
        found.time += start.elapsed();
        Ok(visible)
    }

    /// How long finding took so far.
    pub fn time(&self) -> Duration {
        self.found.lock().expect("nothing panics while it is held").time
    }
}

/// The level that a camera's picture is drawn of.
///
/// # Errors
/// When the volume does not have the level that was asked for, or the camera is impossible.
pub fn choose_level(volume: &Volume, request: &RenderRequest, camera: &Camera) -> Result<u32, Error> {
    let levels = volume.source.levels();
    match request.level {
        LevelChoice::Auto => {
            let size = UVec2::from_array(request.size);
            volume.desc().auto_level(camera, size, levels).map_err(Error::View)
        }
        LevelChoice::Exact(level) if level < levels => Ok(level),
        LevelChoice::Exact(level) => Err(Error::Level { level, last: levels - 1 }),
    }
}

/// The bricks worth drawing. A projection shows values, not opacities: there every brick counts.
fn visible_bricks(
    volume: &Volume,
    level: u32,
    request: &RenderRequest,
    transfer_function: &BakedTransferFunction,
) -> Result<VisibleBricks, Error> {
    let source = &volume.source;
    if request.settings.mode != Mode::Dvr || request.settings.skip == Skip::None {
        return Ok(all_bricks(&source.grid(level)));
    }
    let (bands, rescale) = (transfer_function.bands(), source.desc().rescale);
    let visible = filtered_visible(source.ranges(level), &bands, rescale);
    if !request.nearly_empty.is_lossy() {
        return Ok(visible);
    }
    let tables = source.voxel_count_tables(level)?;
    let parts: Vec<VisibleBricks> = visible
        .bricks
        .par_chunks(BRICKS_AT_ONCE)
        .map(|bricks| {
            let part = VisibleBricks { bricks: bricks.to_vec(), ..VisibleBricks::default() };
            without_nearly_empty(part, &tables, &bands, rescale, request.nearly_empty)
        })
        .collect();
    Ok(VisibleBricks {
        empty: visible.empty,
        nearly_empty: parts.iter().map(|part| part.nearly_empty).sum(),
        bricks: parts.into_iter().flat_map(|part| part.bricks).collect(),
    })
}
