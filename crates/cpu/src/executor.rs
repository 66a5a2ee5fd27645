use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock};

use glassbrick_volume::{
    BakedTransferFunction, Brick, BrickGrid, BrickId, BrickRange, BrickSource, Frame, FramePlan, FrameRays,
    PlannedBrick, ReadError, RenderSettings, RowAxis, Skip,
};

use crate::kernel::{BrickView, Kernel};
use crate::simd::ShownCells;
use crate::{by_blocks, by_layers};

/// What is to be drawn.
pub struct CpuScene<'a> {
    pub rays: &'a FrameRays,
    pub plan: &'a FramePlan,
    pub transfer_function: &'a BakedTransferFunction,
    pub settings: RenderSettings,
    /// What other frames of the same source, level and transfer function found.
    pub shown_cells: &'a ShownCells,
    /// Whether bricks that cannot be read are left out; else the first one ends the drawing.
    pub allow_damaged: bool,
}

/// A finished frame and what it took.
pub struct CpuFrame {
    pub frame: Frame,
    /// Samples evaluated.
    pub samples: u64,
    /// Planned bricks that could not change the picture any more when their turn came; they were not loaded.
    pub occluded: usize,
    /// Planned bricks of which at least one sample was evaluated.
    pub rendered: usize,
    /// Why bricks were left out that could not be read, by place in the grid.
    pub damaged: BTreeMap<u32, String>,
}

/// Draws a planned frame with one kernel: block by block of the picture where all its bricks can be held at once, else
/// layer by layer, so that each brick is loaded once. Both draw the same picture; of projections, whose bricks come in
/// another order by blocks, they count other samples.
pub fn draw_with<K: Kernel>(
    kernel: &K,
    source: &dyn BrickSource,
    scene: &CpuScene,
) -> Result<CpuFrame, ReadError> {
    let picture = Picture::new(source, scene, RowAxis::X);
    if picture.can_be_held() { by_blocks::draw(kernel, picture) } else { by_layers::draw(kernel, picture) }
}

/// A brick, once it was asked for; nothing of a damaged one that is left out.
pub type HeldBrick = OnceLock<Result<Option<Arc<Brick>>, ReadError>>;

/// A picture under way.
pub struct Picture<'a> {
    pub scene: &'a CpuScene<'a>,
    pub ranges: &'a [BrickRange],
    pub grid: BrickGrid,
    /// The axis along which the rows of bricks lie that are held.
    pub row_axis: RowAxis,
    source: &'a dyn BrickSource,
    samples: AtomicU64,
    /// By place in the grid.
    is_rendered: Vec<AtomicBool>,
    damaged: Mutex<BTreeMap<u32, String>>,
}

impl<'a> Picture<'a> {
    pub fn new(source: &'a dyn BrickSource, scene: &'a CpuScene<'a>, row_axis: RowAxis) -> Self {
        let grid = source.grid(scene.plan.level);
        Self {
            scene,
            ranges: source.ranges(scene.plan.level),
            grid,
            row_axis,
            source,
            samples: AtomicU64::new(0),
            is_rendered: (0..grid.len()).map(|_| AtomicBool::new(false)).collect(),
            damaged: Mutex::default(),
        }
    }

    /// Whether memory holds all bricks of the frame at once.
    pub fn can_be_held(&self) -> bool {
        self.source.can_hold(self.scene.plan.bricks())
    }

    /// Whether nothing in a brick can change the pixels of some tiles that its footprint names.
    pub fn is_hidden<K: Kernel>(
        &self,
        kernel: &K,
        brick: &PlannedBrick,
        mut tiles: impl Iterator<Item = impl Deref<Target = K::Tile>>,
    ) -> bool {
        let reach = self.ranges[brick.index as usize].reach;
        self.scene.settings.skip == Skip::All
            && tiles.all(|tile| kernel.is_unchanged_by(&tile, &brick.footprint, reach))
    }

    /// The voxels of a planned brick; nothing of a damaged one that may be left out.
    fn load(&self, brick: &PlannedBrick) -> Result<Option<Arc<Brick>>, ReadError> {
        self.unless_damaged(brick, self.source.brick_along(self.id(brick), self.row_axis))
    }

    /// The voxels of a planned brick that is held until the picture is finished. It is loaded once, however many threads come
    /// to it at the same time.
    pub fn hold<'b>(
        &self,
        brick: &PlannedBrick,
        held: &'b HeldBrick,
    ) -> Result<Option<&'b Brick>, ReadError> {
        match held.get_or_init(|| self.load(brick)) {
            Ok(voxels) => Ok(voxels.as_deref()),
            Err(error) => Err(ReadError::from(error.to_string())),
        }
    }

    /// The voxels of several planned bricks, each once.
    pub fn load_all(&self, bricks: &[&PlannedBrick]) -> Result<Vec<Option<Arc<Brick>>>, ReadError> {
        let ids: Vec<BrickId> = bricks.iter().map(|brick| self.id(brick)).collect();
        let loaded = self.source.bricks(&ids);
        bricks.iter().zip(loaded).map(|(brick, voxels)| self.unless_damaged(brick, voxels)).collect()
    }

    fn unless_damaged(
        &self,
        brick: &PlannedBrick,
        voxels: Result<Arc<Brick>, ReadError>,
    ) -> Result<Option<Arc<Brick>>, ReadError> {
        match voxels {
            Ok(voxels) => Ok(Some(voxels)),
            Err(error) if self.scene.allow_damaged => {
                let mut damaged = self.damaged.lock().expect("nothing panics while it is held");
                damaged.entry(brick.index).or_insert_with(|| error.to_string());
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// Tells the source which bricks may be loaded soon.
    pub fn will_need<'b>(&self, bricks: impl Iterator<Item = &'b PlannedBrick>) {
        let ids: Vec<BrickId> = bricks.map(|brick| self.id(brick)).collect();
        self.source.will_need(&ids);
    }

    fn id(&self, brick: &PlannedBrick) -> BrickId {
        BrickId::new(self.scene.plan.level, self.grid.brick(brick.index as usize))
    }

    /// A brick in its place in the frame.
    pub fn view<'b>(&self, planned: &PlannedBrick, brick: &'b Brick) -> BrickView<'b> {
        BrickView::new(brick, planned, &self.grid, &self.ranges[planned.index as usize])
    }

    /// Takes note of samples that were evaluated in a brick.
    pub fn count(&self, brick: &PlannedBrick, samples: u64) {
        if samples > 0 {
            self.add_samples(samples);
            self.is_rendered_if(brick, true);
        }
    }

    /// Takes note of samples that were evaluated.
    pub fn add_samples(&self, samples: u64) {
        self.samples.fetch_add(samples, Ordering::Relaxed);
    }

    /// Takes note of whether a sample of a brick was evaluated.
    pub fn is_rendered_if(&self, brick: &PlannedBrick, is_rendered: bool) {
        let flag = &self.is_rendered[brick.index as usize];
        // Looked at first: many threads write the same.
        if is_rendered && !flag.load(Ordering::Relaxed) {
            flag.store(true, Ordering::Relaxed);
        }
    }

    /// The finished frame, for which so many of the planned bricks were loaded.
    pub fn finish(self, frame: Frame, loaded: usize) -> CpuFrame {
        CpuFrame {
            occluded: self.scene.plan.bricks() - loaded,
            rendered: self.is_rendered.iter().filter(|flag| flag.load(Ordering::Relaxed)).count(),
            samples: self.samples.into_inner(),
            damaged: self.damaged.into_inner().expect("nothing panics while it is held"),
            frame,
        }
    }
}
