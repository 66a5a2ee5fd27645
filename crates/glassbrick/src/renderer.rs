use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use glam::UVec2;
use glassbrick_brick_store::CacheCounts;
use glassbrick_volume::{
    BakedTransferFunction, BrickCounts, BrickId, BrickSource, Camera, Frame, FramePlan, FrameRays,
    FrameReport, Mode, NearlyEmpty, ResidencyCounts, Skip, StageTimes, VisibleBricks, boundary_bricks,
};

use crate::executor::{Drawn, Executor, Waiting};
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
    executor: Executor,
    visible: VisibleLevels,
    warnings: Vec<String>,
    tables_time: Duration,
    boundary_pinned: AtomicUsize,
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
    /// When the request is impossible, or the GPU that it names has no room.
    pub fn new(volume: &'a Volume, request: RenderRequest) -> Result<Self, Error> {
        let start = Instant::now();
        request.check()?;
        let transfer_function = request.transfer_function.bake(volume.desc().smallest_spacing_mm());
        let warnings = warnings(volume, &request);
        let tables_time = volume.scan_time() + start.elapsed();
        let executor = Executor::new(volume, &request)?;
        Ok(Self {
            volume,
            request,
            transfer_function,
            executor,
            visible: VisibleLevels::new(),
            warnings,
            tables_time,
            boundary_pinned: AtomicUsize::new(0),
        })
    }

    /// Prefetches boundary bricks of the level that a camera's picture is drawn of, and keeps them on the GPU: a view from
    /// outside meets them first, whatever its direction. Worth its while for many views, not for a single picture.
    /// Nothing is waited for; returns how many bricks are kept.
    ///
    /// # Errors
    /// When the camera or the level is impossible, or tables cannot be read.
    pub fn pin_boundary(&self, camera: &Camera) -> Result<usize, Error> {
        let level = choose_level(self.volume, &self.request, camera)?;
        let visible = self.visible.at(self.volume, level, &self.request, &self.transfer_function)?;
        let grid = self.volume.source.grid(level);
        let id = |index: u32| BrickId::new(level, grid.brick(index as usize));
        let pinned = self
            .executor
            .pin(|slots| boundary_bricks(&visible.bricks, &grid, slots).into_iter().map(id).collect())?;
        self.boundary_pinned.store(pinned, Ordering::Relaxed);
        Ok(pinned)
    }

    /// Draws what is resident of the picture that a camera sees, without waiting for bricks: those that are missing are
    /// asked for, and repeated calls converge to the whole picture. The report says whether this one is complete. The CPU
    /// waits for its bricks, and its pictures are always complete.
    ///
    /// # Errors
    /// As of [`Renderer::draw`].
    pub fn draw_resident(&self, camera: &Camera) -> Result<Rendered, Error> {
        self.draw_waiting(camera, 1, Waiting::Never)
    }

    /// Draws the picture that a camera sees, `repeat` times for measuring (at least once).
    ///
    /// # Errors
    /// When the camera or the level is impossible, or a brick or table cannot be read.
    pub fn draw(&self, camera: &Camera, repeat: usize) -> Result<Rendered, Error> {
        self.draw_waiting(camera, repeat, Waiting::Complete)
    }

    fn draw_waiting(&self, camera: &Camera, repeat: usize, waiting: Waiting) -> Result<Rendered, Error> {
        let level = choose_level(self.volume, &self.request, camera)?;
        let visible = self.visible.at(self.volume, level, &self.request, &self.transfer_function)?;
        let mut render_all = Vec::with_capacity(repeat.max(1));
        let (first, plan_time, in_frustum) =
            self.draw_once(camera, level, &visible, waiting, &mut render_all)?;
        let (residency, load_time) = self.residency(&first);
        for _ in 1..repeat {
            self.draw_once(camera, level, &visible, waiting, &mut render_all)?;
        }
        // What repeats went through is nobody's: the next report counts from here.
        self.residency(&first);
        let bricks = self.brick_counts(&first, level, &visible.bricks, in_frustum);
        let mut warnings = self.warnings.clone();
        warnings.extend(left_out(&first.damaged));
        warnings.extend(self.another_pass(&first));
        warnings.extend(self.why_nothing_is_shown(&first.frame, &bricks));
        let milliseconds = |time: Duration| time.as_secs_f64() * 1e3;
        let peaks = process_memory::peaks();
        let report = FrameReport {
            volume: self.volume.desc().clone(),
            not_finite: self.volume.source.not_finite(),
            backend: self.executor.backend(),
            adapter: self.executor.adapter(self.volume),
            pass: first.pass,
            mode: self.request.settings.mode.name(),
            size: self.request.size,
            level,
            step: self.request.step_voxels,
            opacity_cutoff: self.request.settings.opacity_cutoff,
            alpha: self.request.nearly_empty.alpha,
            beta: self.request.nearly_empty.beta,
            bricks,
            residency,
            samples: first.samples,
            complete: first.complete,
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
        waiting: Waiting,
        render_all: &mut Vec<f64>,
    ) -> Result<(Drawn, Duration, usize), Error> {
        let start = Instant::now();
        let size = UVec2::from_array(self.request.size);
        let rays = FrameRays::new(&self.volume.desc().level(level), camera, size, self.request.step_voxels)
            .map_err(Error::View)?;
        let source = &self.volume.source;
        let plan = FramePlan::new(level, &source.grid(level), &rays, &visible.bricks.bricks);
        let plan_time = start.elapsed();
        let drawn = self.executor.draw(
            self.volume,
            &self.request,
            &self.transfer_function,
            &rays,
            &plan,
            visible,
            waiting,
        )?;
        render_all.push(start.elapsed().as_secs_f64() * 1e3);
        Ok((drawn, plan_time, plan.bricks()))
    }

    fn brick_counts(
        &self,
        drawn: &Drawn,
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
            boundary_pinned: self.boundary_pinned.load(Ordering::Relaxed),
            damaged: drawn.damaged.len(),
        }
    }

    /// What went through memory since the last report, and how long threads waited for bricks.
    fn residency(&self, drawn: &Drawn) -> (ResidencyCounts, Duration) {
        let now =
            Counters { cache: self.volume.source.counts(), bytes_read: self.volume.source.bytes_read() };
        let mut reported = self.volume.reported.lock().expect("nothing panics while it is held");
        let before = std::mem::replace(&mut *reported, now);
        let in_ram = ResidencyCounts {
            budget_bytes: now.cache.budget_bytes,
            peak_bytes: now.cache.peak_bytes,
            hits: now.cache.hits - before.cache.hits,
            misses: now.cache.misses - before.cache.misses,
            uploads: 0,
            bytes_uploaded: 0,
            evictions: now.cache.evictions - before.cache.evictions,
            bytes_read: now.bytes_read - before.bytes_read,
        };
        let counts = drawn
            .residency
            .map_or(in_ram, |on_gpu| ResidencyCounts { bytes_read: in_ram.bytes_read, ..on_gpu });
        (counts, now.cache.load_time - before.cache.load_time)
    }

    /// A GPU may not be able to draw as it was asked to.
    fn another_pass(&self, drawn: &Drawn) -> Option<String> {
        let asked = self.request.pass.name();
        let is_another = self.executor.backend() == "gpu" && drawn.pass != asked;
        is_another.then(|| format!("this GPU cannot draw this by {asked}: {} drew it", drawn.pass))
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
