use std::collections::BTreeMap;
use std::time::{Duration, Instant};

use glam::UVec2;
use glassbrick_brick_store::CacheCounts;
use glassbrick_cpu::{CpuFrame, CpuScene, InstructionSet};
use glassbrick_volume::{
    BakedTransferFunction, BrickCounts, BrickSource, Camera, Frame, FramePlan, FrameRays, FrameReport, Mode,
    NearlyEmpty, ResidencyCounts, Skip, StageTimes, VisibleBricks,
};

use crate::visible_levels::{VisibleLevel, VisibleLevels, choose_level};
use crate::{Error, RenderRequest, Volume, process_memory};

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
    visible: VisibleLevels,
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
    /// Bakes the transfer function; what it can see of a level is found when that is first drawn.
    ///
    /// # Errors
    /// When the request is impossible.
    pub fn new(volume: &'a Volume, request: RenderRequest) -> Result<Self, Error> {
        let start = Instant::now();
        request.check()?;
        let transfer_function = request.transfer_function.bake(volume.desc().smallest_spacing_mm());
        let warnings = warnings(volume, &request);
        let tables_time = volume.scan_time() + start.elapsed();
        let visible = VisibleLevels::new();
        Ok(Self { volume, request, transfer_function, visible, warnings, tables_time })
    }

    /// Draws the picture that a camera sees, `repeat` times for measuring (at least once).
    ///
    /// # Errors
    /// When the camera or the level is impossible, or a brick or table cannot be read.
    pub fn draw(&self, camera: &Camera, repeat: usize) -> Result<Rendered, Error> {
        let level = choose_level(self.volume, &self.request, camera)?;
        let visible = self.visible.at(self.volume, level, &self.request, &self.transfer_function)?;
        let mut render_all = Vec::with_capacity(repeat.max(1));
        let (first, plan_time, in_frustum) = self.draw_once(camera, level, &visible, &mut render_all)?;
        let (residency, load_time) = self.residency();
        for _ in 1..repeat {
            self.draw_once(camera, level, &visible, &mut render_all)?;
        }
        // What repeats went through is nobody's: the next report counts from here.
        self.residency();
        let bricks = self.brick_counts(&first, level, &visible.bricks, in_frustum);
        let mut warnings = self.warnings.clone();
        warnings.extend(left_out(&first.damaged));
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
            level,
            step: self.request.step_voxels,
            opacity_cutoff: self.request.settings.opacity_cutoff,
            alpha: self.request.nearly_empty.alpha,
            beta: self.request.nearly_empty.beta,
            bricks,
            residency,
            samples: Some(first.samples),
            complete: first.damaged.is_empty(),
            time_ms: StageTimes {
                open: milliseconds(self.volume.open_time),
                tables: milliseconds(self.tables_time + self.visible.time()),
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
        level: u32,
        visible: &VisibleLevel,
        render_all: &mut Vec<f64>,
    ) -> Result<(CpuFrame, Duration, usize), Error> {
        let start = Instant::now();
        let size = UVec2::from_array(self.request.size);
        let rays = FrameRays::new(&self.volume.desc().level(level), camera, size, self.request.step_voxels)
            .map_err(Error::View)?;
        let source = &self.volume.source;
        let plan = FramePlan::new(level, &source.grid(level), &rays, &visible.bricks.bricks);
        let plan_time = start.elapsed();
        let scene = CpuScene {
            rays: &rays,
            plan: &plan,
            transfer_function: &self.transfer_function,
            settings: self.request.settings,
            shown_cells: &visible.cells,
            allow_damaged: self.request.allow_damaged,
        };
        let drawn =
            self.volume.threads.install(|| glassbrick_cpu::draw(source, &scene, self.instruction_set()))?;
        render_all.push(start.elapsed().as_secs_f64() * 1e3);
        Ok((drawn, plan_time, plan.bricks()))
    }

    fn instruction_set(&self) -> InstructionSet {
        self.request.instruction_set.unwrap_or_else(InstructionSet::best)
    }

    fn brick_counts(
        &self,
        drawn: &CpuFrame,
        level: u32,
        visible: &VisibleBricks,
        in_frustum: usize,
    ) -> BrickCounts {
        BrickCounts {
            total: self.volume.source.grid(level).len(),
            empty: visible.empty,
            filtered_visible: visible.bricks.len(),
            in_frustum,
            occluded: drawn.occluded,
            rendered: drawn.rendered,
            boundary_pinned: 0,
            damaged: drawn.damaged.len(),
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

/// Which bricks were left out, for the first of them.
fn left_out(damaged: &BTreeMap<u32, String>) -> Vec<String> {
    const NAMED: usize = 10;
    let mut told: Vec<String> =
        damaged.values().take(NAMED).map(|why| format!("a brick is left out: {why}")).collect();
    if damaged.len() > NAMED {
        told.push(format!("{} more bricks are left out", damaged.len() - NAMED));
    }
    told
}

fn median(times: &[f64]) -> f64 {
    let mut sorted = times.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { (sorted[middle - 1] + sorted[middle]) / 2.0 }
}
