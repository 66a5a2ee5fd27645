//! The slices pass: layers front to back, and in each the slices of its bricks back to front.
//!
//! Per layer, boxes of bricks are asked about against the stencil of opaque pixels; the answers become indirect draws
//! without being read back; visible bricks' slices are blended into an image of the layer, which then goes under what lies
//! in front of it. Where a frame has more bricks than slots it takes several rounds, and between them it is read back which
//! of the bricks that are left can be seen at all: the others are never loaded.
//!
//! Projections have no order: bricks with the best values come first, the depth buffer holds each pixel's best, and bricks
//! are asked about against that. Means add up.

mod encode;
mod geometry;
mod parts;
mod pipelines;
mod round;
mod targets;

use bytemuck::Zeroable;
use glassbrick_residency::SlotId;
use glassbrick_shaders::{Pixels, SlicedBrick};
use glassbrick_volume::{BrickId, PixelRect, PlannedBrick, Skip};

use crate::frame_uniform::{FrameParts, cell_question, frame_uniform, rank_from_stored};
use crate::read_back::ReadBack;
use crate::residents::Residents;
use crate::slot_cells::{CellLayout, CellQuestion};
use crate::tiles::Taken;
use crate::waiting::Waiting;
use crate::{GpuDevice, GpuError};
use encode::{RoundBuffers, RoundEncoder, Style};
use geometry::SliceGeometry;
use parts::{BrickPart, PARTS, parts};
use pipelines::{READ_FORMAT, SlicePipelines};
use round::{MOST_QUERIES, RoundBrick, SliceRound, most_bricks};
use targets::SliceTargets;

/// Bricks of a projection that are asked about at one time.
const RANKED_GROUP: usize = 16;

/// What the slices pass keeps between frames.
pub struct SlicesPass {
    pipelines: SlicePipelines,
    buffers: RoundBuffers,
    targets: Option<SliceTargets>,
}

/// A brick that waits to be drawn.
#[derive(Clone, Copy)]
struct Waited {
    /// Bricks of one group are neighbours and share this.
    group: usize,
    planned: PlannedBrick,
    best: f32,
}

impl SlicesPass {
    pub fn new(device: &GpuDevice) -> Self {
        Self {
            pipelines: SlicePipelines::new(device),
            buffers: RoundBuffers::new(&device.device),
            targets: None,
        }
    }

    fn targets(&self) -> &SliceTargets {
        self.targets.as_ref().expect("a tile's targets are made before it is drawn")
    }

    /// Draws the slices of a tile, and returns what they added up to, row by row. `layers` are the bricks that it can meet, front to back.
    pub fn draw_tile(
        &mut self,
        parts: &FrameParts,
        residents: &mut Residents,
        tile: &PixelRect,
        layers: &[Vec<PlannedBrick>],
    ) -> Result<(Vec<[f32; 4]>, Taken), GpuError> {
        let style = style(parts);
        let size = [tile.max[0] - tile.min[0], tile.max[1] - tile.min[1]];
        self.make_targets(parts.device, size, style)?;
        self.clear(parts.device, style);
        let uniform = frame_uniform(parts, CellLayout::NONE, tile);
        parts.device.queue.write_buffer(&parts.shared.frame, 0, bytemuck::bytes_of(&uniform));
        let scene = parts.scene;
        let level_desc = parts.level.desc.level(scene.plan.level).desc;
        let geometry = SliceGeometry::new(scene.rays, &level_desc, parts.level.grid, tile);
        let id = |planned: &PlannedBrick| {
            BrickId::new(scene.plan.level, parts.level.grid.brick(planned.index as usize))
        };
        let mut waiting = waiting_bricks(parts, layers, style);
        let mut missing = Vec::new();
        if parts.waiting == Waiting::Never {
            let (here, away) =
                waiting.into_iter().partition(|brick| residents.set.slot_of(id(&brick.planned)).is_some());
            (waiting, missing) = (here, away);
        }
        let question = cell_question(parts);
        let mut result = Taken::default();
        loop {
            let groups = waiting.chunk_by(|a, b| a.group == b.group);
            let most = most_bricks(groups.map(<[Waited]>::len), if question.is_some() { PARTS } else { 1 });
            let wanted: Vec<BrickId> = waiting.iter().take(most).map(|brick| id(&brick.planned)).collect();
            let most_loads = residents.textures.shape.slots_per_cube() as usize;
            let loaded = residents.load_round(parts.device, &wanted, most_loads, scene.allow_damaged)?;
            for (brick, why) in loaded.damaged {
                result.damaged.insert(parts.level.grid.index(brick.place()) as u32, why);
            }
            let taken: Vec<Waited> = waiting.drain(..loaded.taken).collect();
            let mut round = SliceRound::default();
            for group in taken.chunk_by(|a, b| a.group == b.group) {
                round.add(group.iter().flat_map(|brick| {
                    let slot = residents.set.slot_of(id(&brick.planned));
                    slot.map_or(Vec::new(), |slot| drawn_parts(brick, slot, residents, &geometry, &question))
                }));
            }
            let (drawn_groups, drawn_bricks) = (round.groups.len(), round.bricks.len());
            let left = if waiting.is_empty() { &mut missing } else { &mut waiting };
            let asked = if style.asks { ask_about(&mut round, left, &geometry) } else { 0 };
            let order = RoundEncoder {
                parts,
                style,
                round: &round,
                drawn_groups,
                tile: *tile,
                stride: parts.device.uniform_stride(size_of::<SlicedBrick>()),
            };
            let visible = self.submit(&order, residents)?;
            let is_visible = |number: usize| visible.as_ref().is_none_or(|visible| visible[number]);
            for (number, brick) in round.bricks[..drawn_bricks].iter().enumerate() {
                if is_visible(number) {
                    result.rendered.insert(brick.planned.index);
                }
                residents.set.set_drawn(id(&brick.planned));
            }
            keep_visible(left, asked, &round.bricks[drawn_bricks..], |number| {
                is_visible(drawn_bricks + number)
            });
            if waiting.is_empty() {
                break;
            }
        }
        residents.set.end_round();
        result.missing = missing.iter().map(|brick| id(&brick.planned)).collect();
        Ok((self.read(parts.device, style)?, result))
    }

    fn make_targets(&mut self, device: &GpuDevice, size: [u32; 2], style: Style) -> Result<(), GpuError> {
        let format = accumulated_format(device, style);
        let fits =
            |targets: &SliceTargets| targets.size == size && targets.accumulated_texture().format() == format;
        if !self.targets.as_ref().is_some_and(fits) {
            self.targets = None;
            self.targets = Some(SliceTargets::new(device, size, format)?);
        }
        Ok(())
    }

    /// Reads what was accumulated.
    fn read(&self, device: &GpuDevice, style: Style) -> Result<Vec<[f32; 4]>, GpuError> {
        let targets = self.targets();
        let [width, height] = targets.size;
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let copied = (accumulated_format(device, style) != READ_FORMAT)
            .then(|| self.pipelines.copied(device, &mut encoder, targets));
        let texture = copied.as_ref().unwrap_or(targets.accumulated_texture());
        let row_bytes = (width * 16).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let read = ReadBack::new(&device.device, u64::from(row_bytes) * u64::from(height));
        encoder.copy_texture_to_buffer(
            texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: read.buffer(),
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(row_bytes),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        device.queue.submit([encoder.finish()]);
        let row_pixels = row_bytes as usize / 16;
        read.read(device, row_pixels * height as usize, |pixels: &[[f32; 4]]| {
            pixels.chunks_exact(row_pixels).flat_map(|row| &row[..width as usize]).copied().collect()
        })
    }
}

/// How the rounds of a frame are drawn.
fn style(parts: &FrameParts) -> Style {
    let settings = &parts.scene.settings;
    let cuts_off = parts.pixels.is_dvr() && settings.effective_cutoff().is_finite();
    let can_hide = cuts_off || parts.pixels == Pixels::Extremum;
    Style { pixels: parts.pixels, cuts_off, asks: can_hide && settings.skip == Skip::All }
}

fn accumulated_format(device: &GpuDevice, style: Style) -> wgpu::TextureFormat {
    if style.pixels.is_dvr() { device.tier.blend_format() } else { READ_FORMAT }
}

/// The bricks in the order in which they are drawn: layer by layer, or the best values first.
fn waiting_bricks(parts: &FrameParts, layers: &[Vec<PlannedBrick>], style: Style) -> Vec<Waited> {
    let ranks =
        rank_from_stored(parts.level.stored_range, parts.scene.settings.mode.sign(parts.level.desc.rescale));
    let best = |planned: &PlannedBrick| {
        let [low, high] = parts.ranges[planned.index as usize].reach;
        (ranks[0] * low + ranks[1]).max(ranks[0] * high + ranks[1])
    };
    let in_layers = layers
        .iter()
        .enumerate()
        .flat_map(|(group, layer)| layer.iter().map(move |&planned| Waited { group, planned, best: 0.0 }));
    let mut bricks: Vec<Waited> =
        in_layers.map(|brick| Waited { best: best(&brick.planned), ..brick }).collect();
    if style.pixels == Pixels::Extremum {
        bricks.sort_by(|a, b| b.best.total_cmp(&a.best));
    }
    if !style.pixels.is_dvr() {
        for (number, brick) in bricks.iter_mut().enumerate() {
            brick.group = number / RANKED_GROUP;
        }
    }
    bricks
}

/// What is drawn of a brick in a slot: its parts where something is asked of its cells, else the whole.
fn drawn_parts(
    brick: &Waited,
    slot: SlotId,
    residents: &Residents,
    geometry: &SliceGeometry,
    question: &Option<CellQuestion>,
) -> Vec<RoundBrick> {
    let (index, place) = (brick.planned.index, residents.textures.shape.place(slot));
    let cells = residents.cells.of(slot);
    let drawn = match (question, cells) {
        (Some(question), Some(cells)) => parts(&geometry.place(index), cells, question),
        _ => vec![geometry.whole(index, brick.best)],
    };
    let sliced = |part: &BrickPart| {
        let (sliced, slices) = geometry.of(index, Some(place), part)?;
        Some(RoundBrick { planned: brick.planned, sliced, slices, texture: place.texture })
    };
    drawn.iter().filter_map(sliced).collect()
}

/// Asks at the end of a round about bricks that are left; returns about how many.
fn ask_about(round: &mut SliceRound, left: &[Waited], geometry: &SliceGeometry) -> usize {
    let room = MOST_QUERIES.saturating_sub(round.queries());
    let asked = left.len().min(room);
    round.add(left.iter().take(asked).map(|brick| {
        let whole = geometry.whole(brick.planned.index, brick.best);
        let (sliced, slices) =
            geometry.of(brick.planned.index, None, &whole).unwrap_or((SlicedBrick::zeroed(), 0));
        RoundBrick { planned: brick.planned, sliced, slices, texture: 0 }
    }));
    asked
}

/// Drops those of the first `asked` bricks that cannot be seen.
fn keep_visible(
    left: &mut Vec<Waited>,
    asked: usize,
    bricks: &[RoundBrick],
    is_visible: impl Fn(usize) -> bool,
) {
    let mut number = 0;
    left.retain(|_| {
        let keeps = number >= asked || is_visible(number) && bricks[number].slices > 0;
        number += 1;
        keeps
    });
}
