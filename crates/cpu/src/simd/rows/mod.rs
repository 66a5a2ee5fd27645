//! Frames whose rays go along the volume's rows from pixel to pixel, as from the front or above: sixteen rays side by
//! side have their samples in the same row of voxels, which is read as a whole instead of voxel by voxel.
//!
//! Such a packet goes through all its bricks at once, also where it meets several side by side. Each sample is formed in
//! the same steps as where voxels are gathered, so it is the same picture to the bit.

mod bricks;
mod frame_rows;
mod march;
mod rays;
mod registers;
mod row;
mod track;
mod voxels;

use std::ops::Range;
use std::sync::OnceLock;

use glassbrick_volume::{BrickSource, ReadError, Skip, StoredType};

use super::instruction_set::InstructionSet;
use super::packet::PACKET;
use super::projection::Projection;
use crate::executor::{CpuFrame, CpuScene, HeldBrick, Picture};
use crate::kernel::NO_SAMPLE;
use bricks::Bricks;
use frame_rows::draw_rows;
use march::MOST_ABREAST;
use rays::RowRays;
use row::{Row, Span};
use track::Track;
use voxels::{RowBrick, RowVoxel};

/// The rays of a frame if it is best drawn along rows: nothing where they do not go so, where bricks are too
/// long for it, where memory does not hold all bricks, or this processor lacks the instructions.
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
    (rays.widest(PACKET + 2, core, scene.rays.sample_count) < widest as f32).then_some(rays)
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
    let picture = Picture::new(source, scene);
    let held: Vec<HeldBrick> = (0..picture.grid.len()).map(|_| OnceLock::new()).collect();
    let bricks = Bricks::<P, V>::new(&picture, &held);
    let columns = columns(scene);
    let frame = draw_rows(scene.rays.size.to_array(), |row, rgba, depth_mm| {
        let columns = &columns[row];
        if columns.is_empty() {
            return Ok::<(), ReadError>(());
        }
        let ray = rays.rows[row];
        let is_drawn = |line| bricks.line(line).iter().any(Option::is_some);
        // SAFETY: rows are drawn only where these instructions were detected.
        let track = unsafe { Track::new(&picture.grid, ray, scene.rays.sample_count, is_drawn) };
        let drawn = Row { projection, picture: &picture, bricks: &bricks, rays, track, ray };
        let (mut state, mut samples) = (projection.start(), 0);
        for first in columns.clone().step_by(PACKET) {
            let span = Span { first, lanes: PACKET.min(columns.end - first) };
            // SAFETY: rows are drawn only where these instructions were detected.
            let Some(evaluated) = (unsafe { drawn.draw(row as u32, span, &mut state)? }) else { continue };
            samples += evaluated;
            for lane in 0..span.lanes {
                let (pixel, number) = projection.finish(&state, lane);
                rgba[first + lane] = pixel;
                if number != NO_SAMPLE {
                    depth_mm[first + lane] = scene.rays.depth_mm(number) as f32;
                }
            }
        }
        picture.add_samples(samples);
        Ok(())
    })?;
    drop(bricks);
    let loaded = held.iter().filter(|brick| brick.get().is_some()).count();
    // Where hidden bricks are not to be skipped, none counts as hidden.
    let loaded = if scene.settings.skip == Skip::All { loaded } else { scene.plan.bricks() };
    Ok(picture.finish(frame, loaded))
}

/// The columns of each row of the picture that can meet a planned brick.
fn columns(scene: &CpuScene) -> Vec<Range<usize>> {
    let mut columns = vec![0..0; scene.rays.size.y as usize];
    for brick in scene.plan.layers.iter().flat_map(|layer| &layer.bricks) {
        let [[left, top], [right, bottom]] =
            [brick.footprint.min, brick.footprint.max].map(|corner| corner.map(|at| at as usize));
        for columns in &mut columns[top..bottom] {
            let first = if columns.start == columns.end { left } else { columns.start.min(left) };
            *columns = first..columns.end.max(right);
        }
    }
    columns
}
