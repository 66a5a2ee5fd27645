use std::collections::BTreeMap;
use std::sync::Arc;

use glassbrick_volume::{BrickId, BrickRange, BrickSource, Frame, Mode, PixelRect};

use crate::atlas_bindings::AtlasBindings;
use crate::frame_uniform::{FrameParts, Level};
use crate::pixels::{Finish, pixels};
use crate::raycast::Raycast;
use crate::residents::Residents;
use crate::shared_buffers::SharedBuffers;
use crate::slices::SlicesPass;
use crate::tiles::{Taken, layers_of, tiles};
use crate::waiting::Waiting;
use crate::{GpuDevice, GpuError, GpuFrame, GpuPass, GpuScene};

/// Draws frames of one source on one device; bricks stay there from frame to frame.
pub struct GpuRenderer {
    device: Arc<GpuDevice>,
    source: Arc<dyn BrickSource>,
    residents: Residents,
    atlas: AtlasBindings,
    shared: SharedBuffers,
    raycast: Raycast,
    /// Made when it is first drawn with.
    slices: Option<SlicesPass>,
    /// Bricks that could not be read when they were not waited for, and why.
    unreadable: BTreeMap<BrickId, String>,
}

/// Bricks that are uploaded for one frame that waits for none.
const MOST_UPLOADS: usize = 16;

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
            slices: None,
            device,
            source,
            residents,
            unreadable: BTreeMap::new(),
        })
    }

    /// Draws until the picture is complete, in as many rounds as its bricks take.
    ///
    /// # Errors
    /// When a brick cannot be read, or the device fails.
    pub fn draw(&mut self, scene: &GpuScene) -> Result<GpuFrame, GpuError> {
        self.draw_waiting(scene, Waiting::Complete).map_err(|error| self.device.lost_or(error))
    }

    /// Draws what is resident without waiting for anything, and asks for what is missing: the next frames have it.
    ///
    /// # Errors
    /// When the device fails, or a brick could not be read that may not be left out.
    pub fn draw_resident(&mut self, scene: &GpuScene) -> Result<GpuFrame, GpuError> {
        self.draw_at_once(scene).map_err(|error| self.device.lost_or(error))
    }

    fn draw_at_once(&mut self, scene: &GpuScene) -> Result<GpuFrame, GpuError> {
        // What the last frame drew is in use: it goes no sooner than what lies idle.
        self.residents.set.begin_frame();
        for (brick, why) in self.residents.take_loaded(&self.device, MOST_UPLOADS)? {
            if !scene.allow_damaged {
                return Err(why.into());
            }
            self.unreadable.insert(brick, why.to_string());
        }
        self.draw_waiting(scene, Waiting::Never)
    }

    fn draw_waiting(&mut self, scene: &GpuScene, waiting: Waiting) -> Result<GpuFrame, GpuError> {
        let source = Arc::clone(&self.source);
        let number = scene.plan.level;
        let (grid, ranges) = (source.grid(number), source.ranges(number));
        let mut frame = Frame::transparent(scene.rays.size.x, scene.rays.size.y);
        let troubles = self.device.troubles();
        self.residents.set.begin_frame();
        self.residents.reserve(&self.device, scene.plan.bricks())?;
        self.shared.write(&self.device, scene);
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
            sign: scene.settings.mode.sign(level.desc.rescale),
        };
        let pass = pass_of(scene, &self.device);
        let mut taken = Taken::default();
        let mut samples = 0;
        let parts = FrameParts {
            device: &self.device,
            shared: &self.shared,
            atlas: &self.atlas,
            scene,
            level: &level,
            ranges,
            pixels: finish.pixels,
            waiting,
        };
        for tile in tiles(scene.rays.size.to_array()) {
            let mut layers = layers_of(scene.plan, &tile);
            if waiting == Waiting::Never && !self.unreadable.is_empty() {
                let id = |index: u32| BrickId::new(scene.plan.level, grid.brick(index as usize));
                for layer in &mut layers {
                    layer.retain(|brick| {
                        let why = self.unreadable.get(&id(brick.index));
                        taken.damaged.extend(why.map(|why| (brick.index, why.clone())));
                        why.is_none()
                    });
                }
            }
            match pass {
                GpuPass::Raycast => {
                    let planned = layers.concat();
                    let met = planned.iter().map(|brick| brick.footprint).reduce(PixelRect::union);
                    let Some(met) = met.map(|met| met.intersection(tile)) else { continue };
                    let (raycast, residents) = (&mut self.raycast, &mut self.residents);
                    let more = raycast.draw_tile(&parts, residents, &met, &planned, |states| {
                        finish.rays(&mut frame, &met, states);
                        samples += states.iter().map(|state| u64::from(state.samples)).sum::<u64>();
                    })?;
                    taken.add(more);
                }
                GpuPass::Slices => {
                    let slices = self.slices.get_or_insert_with(|| SlicesPass::new(&self.device));
                    let (gathered, more) = slices.draw_tile(&parts, &mut self.residents, &tile, &layers)?;
                    finish.slices(&mut frame, &tile, &gathered);
                    taken.add(more);
                }
            }
        }
        self.device.check_since(troubles)?;
        if waiting == Waiting::Never {
            self.residents.ask(&taken.missing);
        }
        let (slots, uploads) = self.residents.take_counts();
        let Taken { rendered, damaged, missing } = taken;
        Ok(GpuFrame {
            frame,
            pass,
            samples: (pass == GpuPass::Raycast).then_some(samples),
            occluded: scene.plan.bricks() - rendered.len() - damaged.len() - missing.len(),
            rendered: rendered.len(),
            complete: missing.is_empty() && damaged.is_empty(),
            damaged,
            slots,
            uploads,
            peak_bytes: self.residents.peak_bytes(),
        })
    }

    /// Slots that there can be.
    pub fn slots(&self) -> usize {
        self.residents.slots()
    }

    /// Pins boundary bricks, the first ones first, and asks for those that are not resident; half the slots hold pinned
    /// bricks at most. Returns how many are pinned.
    ///
    /// # Errors
    /// When the device has no memory at all, or is lost.
    pub fn pin(&mut self, bricks: &[BrickId]) -> Result<usize, GpuError> {
        let reserved = self.residents.reserve(&self.device, 2 * bricks.len());
        reserved.map_err(|error| self.device.lost_or(error))?;
        let pinned = self.residents.set.set_pinned(bricks);
        self.residents.ask(&[]);
        Ok(pinned)
    }
}

/// The pass that draws a scene: rays where the device cannot draw slices into f32, or cannot blend the sums of a mean.
fn pass_of(scene: &GpuScene, device: &GpuDevice) -> GpuPass {
    let tier = &device.tier;
    let can = tier.draws_f32 && (scene.settings.mode != Mode::Mean || tier.blends_f32);
    if can { scene.pass } else { GpuPass::Raycast }
}

/// Smallest and largest stored value of a level.
fn stored_range(ranges: &[BrickRange]) -> [f32; 2] {
    ranges.iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[min, max], range| {
        [min.min(range.reach[0]), max.max(range.reach[1])]
    })
}
