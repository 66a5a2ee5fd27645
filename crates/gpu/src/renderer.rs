use std::collections::BTreeMap;
use std::sync::Arc;

use glassbrick_volume::{BrickId, BrickRange, BrickSource, Frame, PixelRect, PlannedBrick};

use crate::atlas_bindings::AtlasBindings;
use crate::frame_uniform::{Level, sign};
use crate::pixels::{Finish, pixels};
use crate::raycast::{Raycast, Waiting};
use crate::residents::Residents;
use crate::shared_buffers::SharedBuffers;
use crate::tiles::{layers_of, tiles};
use crate::{GpuDevice, GpuError, GpuFrame, GpuScene};

/// Draws frames of one source on one device; bricks stay there from frame to frame.
pub struct GpuRenderer {
    device: Arc<GpuDevice>,
    source: Arc<dyn BrickSource>,
    residents: Residents,
    atlas: AtlasBindings,
    shared: SharedBuffers,
    raycast: Raycast,
}

/// What the tiles of a frame add up to.
struct Tally {
    /// By place in the grid: whether a brick was rendered.
    rendered: Vec<u32>,
    damaged: BTreeMap<u32, String>,
    samples: Option<u64>,
    complete: bool,
    rounds: usize,
}

impl GpuRenderer {
    /// Keeps bricks in at most `budget_bytes` of the device's memory, and reads them by so many threads.
    ///
    /// # Errors
    /// When the budget does not hold one atlas texture, or the device cannot make it.
    pub fn new(
        device: Arc<GpuDevice>,
        source: Arc<dyn BrickSource>,
        budget_bytes: u64,
        threads: usize,
    ) -> Result<Self, GpuError> {
        let texels = device.tier.texels(source.desc().stored_type);
        let [min_stored, _] = stored_range(source.ranges(0));
        let residents =
            Residents::new(&device, Arc::clone(&source), texels, min_stored, budget_bytes, threads)?;
        Ok(Self {
            atlas: AtlasBindings::new(&device.device, texels.filters, device.tier.textures),
            shared: SharedBuffers::new(&device.device),
            raycast: Raycast::new(&device.device),
            device,
            source,
            residents,
        })
    }

    /// The device that draws.
    pub fn device(&self) -> &GpuDevice {
        &self.device
    }

    /// Draws until the picture is complete, in as many rounds as its bricks take.
    ///
    /// # Errors
    /// When a brick cannot be read, or the device fails.
    pub fn draw(&mut self, scene: &GpuScene) -> Result<GpuFrame, GpuError> {
        self.draw_waiting(scene, Waiting::Complete)
    }

    /// Draws what is resident without waiting for anything, and asks for what is missing: the next frames have it.
    ///
    /// # Errors
    /// When the device fails, or a brick could not be read that may not be left out.
    pub fn draw_resident(&mut self, scene: &GpuScene) -> Result<GpuFrame, GpuError> {
        self.draw_waiting(scene, Waiting::Never)
    }

    fn draw_waiting(&mut self, scene: &GpuScene, waiting: Waiting) -> Result<GpuFrame, GpuError> {
        let source = Arc::clone(&self.source);
        let number = scene.plan.level;
        let (grid, ranges) = (source.grid(number), source.ranges(number));
        let mut frame = Frame::transparent(scene.rays.size.x, scene.rays.size.y);
        self.residents.set.begin_frame();
        self.residents.reserve(&self.device, scene.plan.bricks())?;
        self.shared.write(&self.device, scene)?;
        let level = Level {
            desc: source.desc(),
            grid,
            stored_range: stored_range(ranges),
            encoding: self.residents.encoding,
            atlas: self.residents.textures.shape,
        };
        let finish = Finish {
            pixels: pixels(&scene.settings),
            rays: scene.rays,
            transfer_function: scene.transfer_function,
            rescale: level.desc.rescale,
            sign: sign(scene.settings.mode, level.desc),
        };
        let mut tally = Tally {
            rendered: vec![0; grid.len()],
            damaged: BTreeMap::new(),
            samples: Some(0),
            complete: true,
            rounds: 0,
        };
        for tile in tiles(scene.rays.size.to_array()) {
            let layers = layers_of(scene.plan, &tile);
            self.raycast_tile(
                scene, &level, ranges, &tile, &layers, waiting, &finish, &mut frame, &mut tally,
            )?;
        }
        self.device.check()?;
        let (slots, uploads) = self.residents.take_counts();
        let rendered = tally.rendered.iter().filter(|&&rendered| rendered != 0).count();
        Ok(GpuFrame {
            frame,
            samples: tally.samples,
            occluded: scene.plan.bricks() - rendered - tally.damaged.len(),
            rendered,
            complete: tally.complete && tally.damaged.is_empty(),
            damaged: tally.damaged,
            slots,
            uploads,
            peak_bytes: self.residents.peak_bytes(),
            rounds: tally.rounds,
        })
    }

    #[expect(clippy::too_many_arguments, reason = "a tile of a scene goes into a frame and its tally")]
    fn raycast_tile(
        &mut self,
        scene: &GpuScene,
        level: &Level,
        ranges: &[BrickRange],
        tile: &PixelRect,
        layers: &[Vec<PlannedBrick>],
        waiting: Waiting,
        finish: &Finish,
        frame: &mut Frame,
        tally: &mut Tally,
    ) -> Result<(), GpuError> {
        let drawn = self.raycast.draw_tile(
            &self.device,
            &self.shared,
            &mut self.atlas,
            &mut self.residents,
            scene,
            level,
            ranges,
            tile,
            &layers.concat(),
            waiting,
            finish.pixels,
        )?;
        finish.rays(frame, tile, &drawn.states);
        for (rendered, more) in tally.rendered.iter_mut().zip(&drawn.rendered) {
            *rendered |= more;
        }
        tally.damaged.extend(drawn.damaged);
        let samples: u64 = drawn.states.iter().map(|state| u64::from(state.samples)).sum();
        tally.samples = tally.samples.map(|before| before + samples);
        tally.complete &= drawn.complete;
        tally.rounds += drawn.rounds;
        Ok(())
    }

    /// Slots that there can be.
    pub fn slots(&self) -> usize {
        self.residents.slots()
    }

    /// Pins boundary bricks, the first ones first, and asks for those that are not resident; half the slots hold pinned
    /// bricks at most. Returns how many are pinned.
    pub fn pin(&mut self, bricks: &[BrickId]) -> usize {
        let pinned = self.residents.set.set_pinned(bricks);
        self.residents.ask(&[]);
        pinned
    }
}

/// Smallest and largest stored value of a level.
fn stored_range(ranges: &[BrickRange]) -> [f32; 2] {
    ranges.iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[min, max], range| {
        [min.min(range.reach[0]), max.max(range.reach[1])]
    })
}
