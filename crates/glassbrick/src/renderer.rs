use std::time::{Duration, Instant};

use glam::UVec2;
use glassbrick_brick_store::CacheCounts;
use glassbrick_cpu::{CpuFrame, CpuScene, InstructionSet};
use glassbrick_volume::{
    BakedTransferFunction, BrickCounts, BrickSource, Camera, Frame, FramePlan, FrameRays, FrameReport, Mode,
    NearlyEmpty, RenderSettings, ResidencyCounts, Skip, StageTimes, TransferFunction, VisibleBricks,
    all_bricks, filtered_visible, without_nearly_empty,
};

use crate::{Error, Volume, process_memory};

/// Pixels along a side of a picture, at most.
const MOST_PIXELS: u32 = 32_768;

/// Memory that a pixel takes at least: colour, opacity and depth, and three bytes of its picture.
const PIXEL_BYTES: u64 = 5 * size_of::<f32>() as u64 + 3;

/// What is to be drawn, besides the volume and the camera.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderRequest {
    pub transfer_function: TransferFunction,
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// Distance of samples, in voxels of the smallest spacing.
    pub step_voxels: f64,
    pub settings: RenderSettings,
    /// Nearly empty bricks to drop, in direct volume rendering; loses something of the picture.
    pub nearly_empty: NearlyEmpty,
    pub level: LevelChoice,
    /// What the processor draws with; the best that it has where nothing is said.
    pub instruction_set: Option<InstructionSet>,
}

impl RenderRequest {
    /// The defaults for a transfer function: 512×512 pixels, one-voxel steps, everything exact.
    pub fn new(transfer_function: TransferFunction) -> Self {
        Self {
            transfer_function,
            size: [512, 512],
            step_voxels: 1.0,
            settings: RenderSettings::default(),
            nearly_empty: NearlyEmpty::KEEP,
            level: LevelChoice::Auto,
            instruction_set: None,
        }
    }
}

/// Which level of the volume to draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LevelChoice {
    /// The coarsest whose voxels are no larger than a pixel; 0 where there is but one level.
    Auto,
    Exact(u32),
}

/// A finished picture and what is said about it.
#[derive(Clone, Debug)]
pub struct Rendered {
    pub frame: Frame,
    pub report: FrameReport,
}

/// Draws pictures of one volume with one transfer function: what depends on that alone is kept.
pub struct Renderer<'a> {
    volume: &'a Volume,
    request: RenderRequest,
    transfer_function: BakedTransferFunction,
    visible: VisibleBricks,
    level: u32,
    warnings: Vec<String>,
    tables_time: Duration,
}

/// What went through a volume's memory since it was opened.
#[derive(Clone, Copy, Default)]
pub(crate) struct Counters {
    cache: CacheCounts,
    bytes_read: u64,
}

impl<'a> Renderer<'a> {
    /// Finds what the transfer function can see.
    ///
    /// # Errors
    /// When the request is impossible, or tables cannot be read.
    pub fn new(volume: &'a Volume, request: RenderRequest) -> Result<Self, Error> {
        let start = Instant::now();
        check(&request)?;
        let level = choose_level(volume, request.level)?;
        let desc = volume.desc();
        let transfer_function = request.transfer_function.bake(desc.smallest_spacing_mm());
        let visible =
            volume.threads.install(|| visible_bricks(volume, level, &request, &transfer_function))?;
        let warnings = warnings(volume, &request);
        let tables_time = volume.scan_time() + start.elapsed();
        Ok(Self { volume, request, transfer_function, visible, level, warnings, tables_time })
    }

    /// Draws the picture that a camera sees, `repeat` times for measuring (at least once).
    ///
    /// # Errors
    /// When the camera is impossible, or a brick cannot be read.
    pub fn draw(&self, camera: &Camera, repeat: usize) -> Result<Rendered, Error> {
        let mut render_all = Vec::with_capacity(repeat.max(1));
        let (first, plan_time, in_frustum) = self.draw_once(camera, &mut render_all)?;
        let (residency, load_time) = self.residency();
        for _ in 1..repeat {
            self.draw_once(camera, &mut render_all)?;
        }
        // What repeats went through is nobody's: the next report counts from here.
        self.residency();
        let bricks = self.brick_counts(&first, in_frustum);
        let mut warnings = self.warnings.clone();
        warnings.extend(self.why_nothing_is_shown(&first.frame, &bricks));
        let milliseconds = |time: Duration| time.as_secs_f64() * 1e3;
        let peaks = process_memory::peaks();
        let report = FrameReport {
            volume: self.volume.desc().clone(),
            not_finite: self.volume.source.not_finite(),
            backend: "cpu",
            adapter: format!(
                "CPU, {}, {} threads",
                self.instruction_set().name(),
                self.volume.threads.current_num_threads()
            ),
            pass: "layers",
            mode: self.request.settings.mode.name(),
            size: self.request.size,
            level: self.level,
            step: self.request.step_voxels,
            opacity_cutoff: self.request.settings.opacity_cutoff,
            alpha: self.request.nearly_empty.alpha,
            beta: self.request.nearly_empty.beta,
            bricks,
            residency,
            samples: Some(first.samples),
            complete: true,
            time_ms: StageTimes {
                open: milliseconds(self.volume.open_time),
                tables: milliseconds(self.tables_time),
                plan: milliseconds(plan_time),
                load: milliseconds(load_time),
                render: median(&render_all),
                render_all,
                encode: 0.0,
                total: milliseconds(self.volume.opened_at.elapsed()),
            },
            peak_anon_bytes: peaks.anon_bytes,
            peak_rss_bytes: peaks.rss_bytes,
            warnings,
        };
        Ok(Rendered { frame: first.frame, report })
    }

    /// Draws once; returns the frame, the time that its plan took and how many bricks it held.
    fn draw_once(
        &self,
        camera: &Camera,
        render_all: &mut Vec<f64>,
    ) -> Result<(CpuFrame, Duration, usize), Error> {
        let start = Instant::now();
        let size = UVec2::from_array(self.request.size);
        let rays = FrameRays::new(self.volume.desc(), camera, size, self.request.step_voxels)
            .map_err(Error::View)?;
        let source = &self.volume.source;
        let plan = FramePlan::new(self.level, &source.grid(self.level), &rays, &self.visible.bricks);
        let plan_time = start.elapsed();
        let scene = CpuScene {
            rays: &rays,
            plan: &plan,
            transfer_function: &self.transfer_function,
            settings: self.request.settings,
        };
        let drawn =
            self.volume.threads.install(|| glassbrick_cpu::draw(source, &scene, self.instruction_set()))?;
        render_all.push(start.elapsed().as_secs_f64() * 1e3);
        Ok((drawn, plan_time, plan.bricks()))
    }

    fn instruction_set(&self) -> InstructionSet {
        self.request.instruction_set.unwrap_or_else(InstructionSet::best)
    }

    fn brick_counts(&self, drawn: &CpuFrame, in_frustum: usize) -> BrickCounts {
        BrickCounts {
            total: self.volume.source.grid(self.level).len(),
            empty: self.visible.empty,
            filtered_visible: self.visible.bricks.len(),
            in_frustum,
            occluded: drawn.occluded,
            rendered: drawn.rendered,
            boundary_pinned: 0,
        }
    }

    /// What went through memory since the last report, and how long threads waited for bricks.
    fn residency(&self) -> (ResidencyCounts, Duration) {
        let now =
            Counters { cache: self.volume.source.counts(), bytes_read: self.volume.source.bytes_read() };
        let mut reported = self.volume.reported.lock().expect("nothing panics while it is held");
        let before = std::mem::replace(&mut *reported, now);
        let counts = ResidencyCounts {
            budget_bytes: now.cache.budget_bytes,
            peak_bytes: now.cache.peak_bytes,
            hits: now.cache.hits - before.cache.hits,
            misses: now.cache.misses - before.cache.misses,
            uploads: 0,
            bytes_uploaded: 0,
            evictions: now.cache.evictions - before.cache.evictions,
            bytes_read: now.bytes_read - before.bytes_read,
        };
        (counts, now.cache.load_time - before.cache.load_time)
    }

    /// A picture without content must not be silent about why.
    fn why_nothing_is_shown(&self, frame: &Frame, bricks: &BrickCounts) -> Option<String> {
        if frame.rgba.iter().any(|pixel| pixel[3] > 0.0) {
            return None;
        }
        let [min, max] = self.volume.value_range();
        Some(if bricks.filtered_visible == 0 {
            format!(
                "nothing is shown: the transfer function is transparent for all values of this volume, {min} to {max}"
            )
        } else if bricks.in_frustum == 0 {
            "nothing is shown: no visible brick is in the camera's view; check eye, target and field of view"
                .to_owned()
        } else {
            format!(
                "nothing is shown: no sample that the camera's rays meet is visible to the transfer function; values go from {min} to {max}"
            )
        })
    }
}

impl Volume {
    /// Draws one picture.
    ///
    /// # Errors
    /// When the request or the camera is impossible, or voxels cannot be read.
    pub fn render(&self, request: RenderRequest, camera: &Camera) -> Result<Rendered, Error> {
        Renderer::new(self, request)?.draw(camera, 1)
    }
}

fn check(request: &RenderRequest) -> Result<(), Error> {
    if request.size.iter().any(|pixels| !(1..=MOST_PIXELS).contains(pixels)) {
        return Err(Error::View("a picture has 1 to 32768 pixels on a side"));
    }
    let frame_bytes = request.size.iter().map(|&pixels| u64::from(pixels)).product::<u64>() * PIXEL_BYTES;
    if process_memory::available_bytes().is_some_and(|available| frame_bytes > available) {
        return Err(Error::View(
            "a picture of this size does not fit into the memory that is free; make it smaller",
        ));
    }
    if request.instruction_set.is_some_and(|set| !set.is_available()) {
        return Err(Error::View("this processor does not have the instructions that were asked for"));
    }
    let unit = 0.0..=1.0;
    if !unit.contains(&request.nearly_empty.alpha) || !unit.contains(&request.nearly_empty.beta) {
        return Err(Error::View("alpha and beta lie between 0 and 1"));
    }
    if request.settings.opacity_cutoff.is_nan() || request.settings.opacity_cutoff <= 0.0 {
        return Err(Error::View("the opacity cutoff lies above 0; 1 never stops"));
    }
    Ok(())
}

fn choose_level(volume: &Volume, choice: LevelChoice) -> Result<u32, Error> {
    let last = volume.source.levels() - 1;
    match choice {
        LevelChoice::Auto => Ok(0),
        LevelChoice::Exact(level) if level <= last => Ok(level),
        LevelChoice::Exact(level) => Err(Error::Level { level, last }),
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
    Ok(without_nearly_empty(visible, &tables, &bands, rescale, request.nearly_empty))
}

fn warnings(volume: &Volume, request: &RenderRequest) -> Vec<String> {
    let mut warnings = volume.notes().to_vec();
    let not_finite = volume.source.not_finite();
    if not_finite > 0 {
        warnings.push(format!("{not_finite} voxels are not finite and are read as 0"));
    }
    warnings.extend(request.transfer_function.warnings());
    if request.nearly_empty.is_lossy() {
        let NearlyEmpty { alpha, beta } = request.nearly_empty;
        warnings.push(if request.settings.mode != Mode::Dvr || request.settings.skip == Skip::None {
            "alpha and beta drop bricks in direct volume rendering only, and never with skip none: they do nothing here"
                .to_owned()
        } else {
            format!("nearly empty bricks are dropped (alpha {alpha}, beta {beta}): the picture is not exact")
        });
    }
    warnings
}

fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { (sorted[middle - 1] + sorted[middle]) / 2.0 }
}
