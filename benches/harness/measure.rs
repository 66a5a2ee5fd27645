//! Draws every view by one executor and tells what each took.

use std::time::{Duration, Instant};

use glam::Vec4;
use glassbrick::{
    Background, BrickCounts, Camera, Frame, FrameReport, RenderRequest, Rendered, Renderer, ResidencyCounts,
    Volume, memory_peaks, report_json, write_picture,
};

use crate::difference::difference;
use crate::places::Places;
use crate::plain_caster::{self, PlainVolume};
use crate::{
    BenchError, BenchPlan, BrickStages, Executor, Residency, Run, Spread, StageMs, Task, View, frame_file,
};

/// A view is not drawn again once its frames took this long.
const ENOUGH_TIME: Duration = Duration::from_secs(2);

/// One executor at one data set and transfer function.
pub struct Measurement<'a> {
    pub plan: &'a BenchPlan,
    pub task: Task,
    /// The transfer function's name.
    pub tf: &'a str,
    pub places: &'a Places,
}

/// A view as it was drawn, by whatever drew it.
struct DrawnView {
    pixels: Vec<[f32; 4]>,
    times_ms: Vec<f64>,
    stage_ms: StageMs,
    bricks: Option<BrickStages>,
    residency: Option<Residency>,
    samples: Option<u64>,
    complete: bool,
    picture: Option<String>,
}

impl Measurement<'_> {
    /// Draws every view; `tell` hears of each.
    ///
    /// # Errors
    /// When the volume cannot be drawn, a file not be written, or nobody listens.
    pub fn views(
        &self,
        volume: &Volume,
        request: RenderRequest,
        mut tell: impl FnMut(Run) -> Result<(), BenchError>,
    ) -> Result<(), BenchError> {
        if self.task.executor == Executor::Sw {
            let opening = Instant::now();
            let plain = PlainVolume::read(volume)?;
            let open_ms = milliseconds(opening);
            for (index, view) in self.plan.views.iter().enumerate() {
                let drawn = self.plain_view(&plain, open_ms, &request, volume, index)?;
                tell(self.run(index, view, drawn)?)?;
            }
            return Ok(());
        }
        let renderer = Renderer::new(volume, request)?;
        for (index, view) in self.plan.views.iter().enumerate() {
            let drawn = self.bricked_view(&renderer, &view.camera(volume.desc()), index)?;
            tell(self.run(index, view, drawn)?)?;
        }
        Ok(())
    }

    fn bricked_view(
        &self,
        renderer: &Renderer,
        camera: &Camera,
        view: usize,
    ) -> Result<DrawnView, BenchError> {
        let first = renderer.draw(camera, 1)?;
        let times_ms = times_again(renderer, camera, self.plan.repeat)?;
        let (picture, encode) = self.keep_picture(view, &first.frame, &first.report)?;
        let Rendered { frame, report } = first;
        Ok(DrawnView {
            pixels: frame.rgba,
            times_ms,
            stage_ms: StageMs { encode, ..stage_ms(&report) },
            bricks: Some(stages(&report.bricks)),
            residency: Some(residency(&report.residency)),
            samples: report.samples,
            complete: report.complete,
            picture,
        })
    }

    fn plain_view(
        &self,
        plain: &PlainVolume,
        open_ms: f64,
        request: &RenderRequest,
        volume: &Volume,
        view: usize,
    ) -> Result<DrawnView, BenchError> {
        let camera = self.plan.views[view].camera(volume.desc());
        let draw = || {
            let start = Instant::now();
            plain_caster::draw(plain, request, &camera).map(|drawn| (drawn, milliseconds(start)))
        };
        let ((frame, samples), first_render) = draw()?;
        let times_ms = repeated(self.plan.repeat, || draw().map(|(_, time)| time))?;
        let (picture, encode) = self.keep_plain_picture(view, &frame)?;
        Ok(DrawnView {
            pixels: frame.rgba,
            times_ms,
            stage_ms: StageMs { open: open_ms, tables: 0.0, plan: 0.0, load: 0.0, first_render, encode },
            bricks: None,
            residency: None,
            samples: Some(samples),
            complete: true,
            picture,
        })
    }

    /// What is told of a view. SW's pixels are left for those that follow.
    fn run(&self, index: usize, view: &View, drawn: DrawnView) -> Result<Run, BenchError> {
        let peaks = memory_peaks();
        let of_sw = self.places.pixels_of_sw(self.task, index);
        let difference = if self.task.executor == Executor::Sw {
            frame_file::write(&of_sw, &drawn.pixels)?;
            None
        } else {
            frame_file::read(&of_sw, drawn.pixels.len()).map(|pixels| difference(&drawn.pixels, &pixels))
        };
        let render_ms = Spread::of(&drawn.times_ms);
        Ok(Run {
            data_set: self.plan.data_sets[self.task.data_set].name.clone(),
            tf: self.tf.to_owned(),
            executor: self.task.executor.name().to_owned(),
            view: view.name.clone(),
            fps: render_ms.per_second(),
            render_ms,
            render_all_ms: drawn.times_ms,
            stage_ms: drawn.stage_ms,
            fractions: drawn.bricks.map(|bricks| bricks.fractions()),
            bricks: drawn.bricks,
            residency: drawn.residency,
            samples: drawn.samples,
            complete: drawn.complete,
            peak_anon_bytes: peaks.anon_bytes,
            peak_rss_bytes: peaks.rss_bytes,
            difference,
            picture: drawn.picture,
        })
    }
}

/// Keeping pictures: of every executor the first view's, of one all of them.
impl Measurement<'_> {
    fn keeps(&self, view: usize) -> Option<String> {
        let is_kept = view == 0 || self.plan.gallery_executor() == Some(self.task.executor);
        let name = &self.plan.data_sets[self.task.data_set].name;
        let view = &self.plan.views[view].name;
        is_kept.then(|| format!("{name}-{}-{}-{view}.png", self.tf, self.task.executor.name()))
    }

    fn keep_picture(
        &self,
        view: usize,
        frame: &Frame,
        report: &FrameReport,
    ) -> Result<(Option<String>, f64), BenchError> {
        self.write_picture(view, frame, &report_json(report).to_string())
    }

    fn keep_plain_picture(&self, view: usize, frame: &Frame) -> Result<(Option<String>, f64), BenchError> {
        let report = format!("{{\"executor\":\"sw\",\"version\":\"{}\"}}", env!("CARGO_PKG_VERSION"));
        self.write_picture(view, frame, &report)
    }

    /// Writes a picture if it is one to keep; returns where it will be, and how many milliseconds that took.
    fn write_picture(
        &self,
        view: usize,
        frame: &Frame,
        report: &str,
    ) -> Result<(Option<String>, f64), BenchError> {
        let Some(file) = self.keeps(view) else { return Ok((None, 0.0)) };
        let start = Instant::now();
        write_picture(&self.places.picture(&file), frame, Background::default(), report)?;
        let encode_ms = milliseconds(start);
        write_picture(&self.places.smaller_picture(&file), &halved(frame), Background::default(), report)?;
        Ok((Some(Places::picture_in_results(&file)), encode_ms))
    }
}

/// A picture of half the size, each pixel the mean of four; a last odd column or row is left out.
fn halved(frame: &Frame) -> Frame {
    let [width, height] = [frame.width, frame.height].map(|pixels| (pixels / 2).max(1));
    let mut smaller = Frame::transparent(width, height);
    let at = |column: u32, row: u32| {
        let (column, row) = (column.min(frame.width - 1), row.min(frame.height - 1));
        Vec4::from(frame.rgba[(row * frame.width + column) as usize])
    };
    for (place, pixel) in smaller.rgba.iter_mut().enumerate() {
        let (column, row) = (2 * (place as u32 % width), 2 * (place as u32 / width));
        let sum = at(column, row) + at(column + 1, row) + at(column, row + 1) + at(column + 1, row + 1);
        *pixel = (sum / 4.0).to_array();
    }
    smaller
}

/// The times of the same picture drawn again and again.
pub fn times_again(renderer: &Renderer, camera: &Camera, repeat: usize) -> Result<Vec<f64>, BenchError> {
    repeated(repeat, || Ok(renderer.draw(camera, 1)?.report.time_ms.render))
}

/// What a closure measures, `repeat` times at most and once at least.
fn repeated(
    repeat: usize,
    mut measure: impl FnMut() -> Result<f64, BenchError>,
) -> Result<Vec<f64>, BenchError> {
    let start = Instant::now();
    let mut times = vec![measure()?];
    while times.len() < repeat && start.elapsed() < ENOUGH_TIME {
        times.push(measure()?);
    }
    Ok(times)
}

fn stage_ms(report: &FrameReport) -> StageMs {
    let times = &report.time_ms;
    StageMs {
        open: times.open,
        tables: times.tables,
        plan: times.plan,
        load: times.load,
        first_render: times.render,
        encode: times.encode,
    }
}

/// What each stage left of a frame's bricks.
pub fn stages(bricks: &BrickCounts) -> BrickStages {
    BrickStages {
        total: bricks.total,
        non_empty: bricks.total - bricks.empty,
        filtered_visible: bricks.filtered_visible,
        in_frustum: bricks.in_frustum,
        not_occluded: bricks.in_frustum - bricks.occluded,
        rendered: bricks.rendered,
    }
}

/// The report's counts, in the words of results.
pub fn residency(counts: &ResidencyCounts) -> Residency {
    let ResidencyCounts {
        budget_bytes,
        peak_bytes,
        hits,
        misses,
        uploads,
        bytes_uploaded,
        evictions,
        bytes_read,
    } = *counts;
    Residency { budget_bytes, peak_bytes, hits, misses, uploads, bytes_uploaded, evictions, bytes_read }
}

fn milliseconds(since: Instant) -> f64 {
    since.elapsed().as_secs_f64() * 1e3
}
