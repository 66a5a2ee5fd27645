//! Frames whose rays go along rows of voxels from pixel to pixel: sixteen rays side by side have their samples in the same row,
//! which is read as a whole instead of voxel by voxel. From the front, the back, above or below, these are rows along x. Where
//! rays go along another axis from pixel to pixel, or from one row of the picture to the next, as from all around, frame and
//! bricks are turned so that they do.
//!
//! Such a packet goes through all its bricks at once, also where it meets several side by side. Each sample is formed in
//! the same steps as where voxels are gathered, so it is the same picture to the bit.

mod bricks;
mod frame_rows;
mod interpolation;
mod march;
mod rays;
mod registers;
mod row;
mod track;
mod voxels;

use std::ops::Range;
use std::sync::OnceLock;

use glassbrick_volume::{
    BrickId, BrickSource, PixelRect, PlannedBrick, ReadError, RowAxis, Skip, StoredType,
};

use super::instruction_set::InstructionSet;
use super::packet::PACKET;
use super::projection::Projection;
use crate::executor::{CpuFrame, CpuScene, HeldBrick, Picture};
use crate::kernel::NO_SAMPLE;
use bricks::Bricks;
use frame_rows::{draw_columns, draw_rows};
use march::MOST_ABREAST;
use rays::{RowRays, Turn};
use row::{Row, Span};
use track::{Section, Track};
use voxels::{RowBrick, RowVoxel};

/// Rows of a picture that one thread draws one after the other, where a row's samples are guessed from the one above, or
/// rows of the turned picture are columns.
const ROWS_TOGETHER: usize = 8;

/// The rays of a frame if it is best drawn along rows: nothing where they do not go so, where bricks are too long for it,
/// where memory does not hold all bricks, where bricks would be turned that are loaded for the first time, or this processor lacks
/// the instructions.
pub fn suits(source: &dyn BrickSource, scene: &CpuScene, instruction_set: InstructionSet) -> Option<RowRays> {
    let grid = source.grid(scene.plan.level);
    let can_pick = instruction_set == InstructionSet::Avx512
        && is_x86_feature_detected!("avx512bw")
        && is_x86_feature_detected!("avx512vl");
    let fits = grid.layout.edge <= RowBrick::<f32>::LARGEST_EDGE;
    if !(can_pick && fits && source.can_hold(scene.plan.bricks())) {
        return None;
    }
    let rays = RowRays::new(scene.rays, PACKET)?;
    // What is as wide as so many cores meets two bricks more; footprints are a pixel larger on each side.
    let (core, widest) = (grid.layout.core(), (MOST_ABREAST as u32 - 2) * grid.layout.core());
    let is_narrow = rays.widest(PACKET + 2, core, scene.rays.sample_count) < widest as f32;
    // To turn bricks pays where they are drawn again, which a first picture does not tell.
    let pays = rays.turn.row_axis == RowAxis::X || {
        let mut bricks = scene.plan.layers.iter().flat_map(|layer| &layer.bricks);
        let id = |brick: &PlannedBrick| BrickId::new(scene.plan.level, grid.brick(brick.index as usize));
        bricks.any(|brick| source.is_kept(id(brick)))
    };
    (is_narrow && pays).then_some(rays)
}

/// Draws a frame along rows.
pub fn draw<P: Projection>(
    projection: &P,
    source: &dyn BrickSource,
    scene: &CpuScene,
    rays: &RowRays,
) -> Result<CpuFrame, ReadError> {
    match source.desc().stored_type {
        StoredType::U8 => draw_voxels::<P, u8>(projection, source, scene, rays),
        StoredType::I8 => draw_voxels::<P, i8>(projection, source, scene, rays),
        StoredType::U16 => draw_voxels::<P, u16>(projection, source, scene, rays),
        StoredType::I16 => draw_voxels::<P, i16>(projection, source, scene, rays),
        StoredType::U32 | StoredType::I32 | StoredType::F32 | StoredType::F64 => {
            draw_voxels::<P, f32>(projection, source, scene, rays)
        }
    }
}

fn draw_voxels<P: Projection, V: RowVoxel>(
    projection: &P,
    source: &dyn BrickSource,
    scene: &CpuScene,
    rays: &RowRays,
) -> Result<CpuFrame, ReadError> {
    let picture = Picture::new(source, scene, rays.turn.row_axis);
    let held: Vec<HeldBrick> = (0..picture.grid.len()).map(|_| OnceLock::new()).collect();
    let bricks = Bricks::<P, V>::new(&picture, &held);
    let size = rays.turn.of_picture(scene.rays.size.to_array());
    let columns = columns(scene, rays.turn, size[1]);
    let width = size[0] as usize;
    let drawing = Drawing { projection, picture: &picture, bricks: &bricks, rays };
    let is_together = projection.guesses() || rays.turn.is_transposed;
    let together = if is_together { ROWS_TOGETHER } else { 1 };
    let draw = |first, rgba: &mut [[f32; 4]], depth_mm: &mut [f32]| {
        let mut guesses = projection.guesses().then(|| vec![NO_SAMPLE; width]);
        let pixels = rgba.chunks_exact_mut(width).zip(depth_mm.chunks_exact_mut(width));
        for (row, (rgba, depth_mm)) in (first..).zip(pixels) {
            drawing.draw(row, columns[row].clone(), rgba, depth_mm, guesses.as_deref_mut())?;
        }
        Ok::<(), ReadError>(())
    };
    let frame = if rays.turn.is_transposed {
        draw_columns(size, together, draw)?
    } else {
        draw_rows(size, together, draw)?
    };
    drop(bricks);
    let loaded = held.iter().filter(|brick| brick.get().is_some()).count();
    // Where hidden bricks are not to be skipped, none counts as hidden.
    let loaded = if scene.settings.skip == Skip::All { loaded } else { scene.plan.bricks() };
    Ok(picture.finish(frame, loaded))
}

/// What the rows of a frame have in common.
struct Drawing<'r, 'a, P: Projection, V> {
    projection: &'r P,
    picture: &'r Picture<'a>,
    bricks: &'r Bricks<'a, P, V>,
    rays: &'r RowRays,
}

impl<P: Projection, V: RowVoxel> Drawing<'_, '_, P, V> {
    /// Draws some columns of a row. Where samples are guessed, `guesses` has those that the pixels of the row above were taken
    /// from, and gets those of this row.
    fn draw(
        &self,
        row: usize,
        columns: Range<usize>,
        rgba: &mut [[f32; 4]],
        depth_mm: &mut [f32],
        mut guesses: Option<&mut [u32]>,
    ) -> Result<(), ReadError> {
        if columns.is_empty() {
            return Ok(());
        }
        let Self { projection, picture, bricks, rays } = *self;
        let (frame_rays, ray) = (picture.scene.rays, rays.rows[row]);
        let is_drawn = |line| bricks.line(line).iter().any(Option::is_some);
        // SAFETY: rows are drawn only where these instructions were detected.
        let mut track = unsafe { Track::new(&bricks.grid, ray, frame_rays.sample_count, is_drawn) };
        if guesses.is_some() {
            track.sections.sort_by(|a, b| self.rank(b).total_cmp(&self.rank(a)));
        }
        let drawn = Row { projection, picture, bricks, rays, track, ray };
        let (mut state, mut samples) = (projection.start(), 0);
        for first in columns.clone().step_by(PACKET) {
            let span = Span { first, lanes: PACKET.min(columns.end - first) };
            // Where the row above has its extremum, this one has a value about as good.
            let guess = guesses.as_ref().map_or(NO_SAMPLE, |guesses| guesses[first + span.lanes / 2]);
            // SAFETY: rows are drawn only where these instructions were detected.
            let evaluated = unsafe { drawn.draw(row as u32, span, guess, &mut state)? };
            let Some(evaluated) = evaluated else { continue };
            samples += evaluated;
            for lane in 0..span.lanes {
                let (pixel, number) = projection.finish(&state, lane);
                rgba[first + lane] = pixel;
                if let Some(guesses) = &mut guesses {
                    guesses[first + lane] = number;
                }
                if number != NO_SAMPLE {
                    depth_mm[first + lane] = frame_rays.depth_mm(number) as f32;
                }
            }
        }
        picture.add_samples(samples);
        Ok(())
    }

    /// The best that a section's bricks have.
    fn rank(&self, section: &Section) -> f32 {
        let planned = self.bricks.line(section.line).iter().flatten();
        let reaches = planned.map(|planned| self.picture.ranges[planned.index as usize].reach);
        reaches.filter_map(|reach| self.projection.rank(reach)).fold(f32::NEG_INFINITY, f32::max)
    }
}

/// The columns of each of so many rows of the turned picture that can meet a planned brick.
fn columns(scene: &CpuScene, turn: Turn, rows: u32) -> Vec<Range<usize>> {
    let mut columns = vec![0..0; rows as usize];
    for brick in scene.plan.layers.iter().flat_map(|layer| &layer.bricks) {
        let PixelRect { min, max } = turn.rect(&brick.footprint);
        let [[left, top], [right, bottom]] = [min, max].map(|corner| corner.map(|at| at as usize));
        for columns in &mut columns[top..bottom] {
            let first = if columns.start == columns.end { left } else { columns.start.min(left) };
            *columns = first..columns.end.max(right);
        }
    }
    columns
}
