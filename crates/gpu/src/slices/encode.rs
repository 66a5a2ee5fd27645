use glassbrick_shaders::{DrawArgs, Pixels, QueryRange, SlicedBrick};
use glassbrick_volume::PixelRect;
use wgpu::{BufferUsages, LoadOp, Operations, StoreOp};

use super::SlicesPass;
use super::round::{Group, SLAB_CORNERS, SliceRound};
use crate::bindings::bind;
use crate::frame_uniform::FrameParts;
use crate::grown_buffer::GrownBuffer;
use crate::read_back::ReadBack;
use crate::residents::Residents;
use crate::{GpuDevice, GpuError};

/// What a round is told, in memory of the device.
pub struct RoundBuffers {
    bricks: GrownBuffer,
    ranges: GrownBuffer,
    draws: GrownBuffer,
    counts: GrownBuffer,
    queries: wgpu::QuerySet,
}

/// How a tile's rounds are drawn.
#[derive(Clone, Copy)]
pub struct Style {
    pub pixels: Pixels,
    /// Whether opaque pixels are kept in the stencil.
    pub cuts_off: bool,
    /// Whether boxes are asked about before bricks are drawn.
    pub asks: bool,
}

impl Style {
    fn is_ranked(self) -> bool {
        self.pixels == Pixels::Extremum
    }
}

impl RoundBuffers {
    pub fn new(device: &wgpu::Device) -> Self {
        let copied = BufferUsages::COPY_DST;
        Self {
            bricks: GrownBuffer::new("sliced bricks", BufferUsages::UNIFORM | copied),
            ranges: GrownBuffer::new("query ranges", BufferUsages::UNIFORM | copied),
            draws: GrownBuffer::new("draws", BufferUsages::STORAGE | BufferUsages::INDIRECT | copied),
            counts: GrownBuffer::new(
                "query counts",
                BufferUsages::STORAGE | BufferUsages::QUERY_RESOLVE | BufferUsages::COPY_SRC,
            ),
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("visible bricks"),
                ty: wgpu::QueryType::Occlusion,
                count: super::round::MOST_QUERIES as u32,
            }),
        }
    }
}

/// Bytes of a result of an occlusion query.
const RESULT_BYTES: u64 = 8;

/// A round on its way to the device.
pub struct RoundEncoder<'a> {
    pub parts: &'a FrameParts<'a>,
    pub style: Style,
    pub round: &'a SliceRound,
    /// Groups from here on are asked about and not drawn.
    pub drawn_groups: usize,
    /// Bytes from one brick to the next, and from one range.
    pub stride: u32,
    pub tile: PixelRect,
}

impl RoundEncoder<'_> {
    /// Draws only pixels of the tile that lie in a rectangle of the picture.
    fn set_scissor(&self, pass: &mut wgpu::RenderPass, rect: &PixelRect) {
        let PixelRect { min, max } = rect.in_tile(&self.tile);
        pass.set_scissor_rect(min[0], min[1], max[0] - min[0], max[1] - min[1]);
    }
}

impl SlicesPass {
    /// Draws a round in one submission; returns whether each of its bricks was visible, where that was asked.
    pub fn submit(
        &mut self,
        order: &RoundEncoder,
        residents: &Residents,
    ) -> Result<Option<Vec<bool>>, GpuError> {
        let device = order.parts.device;
        self.write(order)?;
        let bound = Bound::new(self, order, residents);
        let counts = ReadBack::new(&device.device, order.round.queries() as u64 * RESULT_BYTES);
        let mut encoder = device.device.create_command_encoder(&Default::default());
        for (number, group) in order.round.groups.iter().enumerate() {
            if order.style.asks || order.style.cuts_off {
                // What the group before drew may have become opaque; of the round before, anything.
                let changed =
                    number.checked_sub(1).map_or(&order.tile, |before| &order.round.groups[before].rect);
                self.ask(&mut encoder, order, &bound, group, changed);
            }
            if order.style.asks {
                let first = group.first_query as u32;
                encoder.resolve_query_set(
                    &self.buffers.queries,
                    first..first + group.count as u32,
                    self.buffers.counts.get(),
                    u64::from(first) * RESULT_BYTES,
                );
            }
            if number < order.drawn_groups {
                if order.style.asks {
                    self.find_visible(&mut encoder, order, &bound, number);
                }
                self.draw_group(&mut encoder, order, &bound, group);
            }
        }
        if !order.style.asks {
            device.queue.submit([encoder.finish()]);
            return Ok(None);
        }
        let bytes = order.round.queries() as u64 * RESULT_BYTES;
        if bytes == 0 {
            return Ok(Some(Vec::new()));
        }
        encoder.copy_buffer_to_buffer(self.buffers.counts.get(), 0, counts.buffer(), 0, bytes);
        device.queue.submit([encoder.finish()]);
        let visible = counts.read(device, order.round.queries(), |counts: &[u64]| {
            order.round.query_numbers().map(|query| counts[query] != 0).collect()
        })?;
        Ok(Some(visible))
    }

    /// Sends what a round is told.
    fn write(&mut self, order: &RoundEncoder) -> Result<(), GpuError> {
        let (device, round, stride) = (order.parts.device, order.round, order.stride as usize);
        let mut bricks = vec![0; stride * round.bricks.len().max(1)];
        for (part, brick) in bricks.chunks_exact_mut(stride).zip(&round.bricks) {
            part[..size_of::<SlicedBrick>()].copy_from_slice(bytemuck::bytes_of(&brick.sliced));
        }
        self.buffers.bricks.write(device, &bricks)?;
        let mut ranges = vec![0; stride * round.groups.len().max(1)];
        for (part, group) in ranges.chunks_exact_mut(stride).zip(&round.groups) {
            let range = QueryRange { first: group.first_query as u32, count: group.count as u32 };
            part[..size_of::<QueryRange>()].copy_from_slice(bytemuck::bytes_of(&range));
        }
        self.buffers.ranges.write(device, &ranges)?;
        self.buffers.draws.write(device, bytemuck::cast_slice(&round.draws()))?;
        self.buffers.counts.grow(device, round.queries() as u64 * RESULT_BYTES)
    }

    /// Finds the pixels that have become opaque, and asks about the boxes of a group.
    fn ask(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        order: &RoundEncoder,
        bound: &Bound,
        group: &Group,
        changed: &PixelRect,
    ) {
        let style = order.style;
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("boxes"),
            color_attachments: &[],
            depth_stencil_attachment: Some(self.kept(style)),
            occlusion_query_set: style.asks.then_some(&self.buffers.queries),
            ..Default::default()
        });
        pass.set_bind_group(0, &bound.frame, &[]);
        if style.cuts_off {
            pass.set_pipeline(&self.pipelines.opaque);
            pass.set_bind_group(1, &bound.accumulated, &[]);
            pass.set_stencil_reference(1);
            order.set_scissor(&mut pass, changed);
            pass.draw(0..3, 0..1);
            pass.set_stencil_reference(0);
            order.set_scissor(&mut pass, &order.tile);
        }
        if style.asks {
            pass.set_pipeline(&bound.boxes);
            for number in 0..group.count {
                pass.set_bind_group(2, &bound.bricks, &[(group.first + number) as u32 * order.stride]);
                pass.begin_occlusion_query((group.first_query + number) as u32);
                pass.draw(0..36, 0..1);
                pass.end_occlusion_query();
            }
        }
    }

    fn find_visible(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        order: &RoundEncoder,
        bound: &Bound,
        group: usize,
    ) {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&self.pipelines.find_visible);
        pass.set_bind_group(0, &bound.visible, &[group as u32 * order.stride]);
        pass.dispatch_workgroups((order.round.groups[group].count as u32).div_ceil(64), 1, 1);
    }

    /// Draws a group's slices: of layers into an image of their own, which then goes under what lies in front of it.
    fn draw_group(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        order: &RoundEncoder,
        bound: &Bound,
        group: &Group,
    ) {
        let style = order.style;
        let is_dvr = style.pixels.is_dvr();
        let target = if is_dvr { &self.targets().layer } else { &self.targets().accumulated };
        let has_depth = is_dvr || style.is_ranked();
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("slices"),
            color_attachments: &[Some(color(target, LoadOp::Load))],
            depth_stencil_attachment: has_depth.then(|| self.kept(style)),
            ..Default::default()
        });
        if is_dvr {
            // Software drivers clear whole pictures, pixel by pixel.
            pass.set_pipeline(&self.pipelines.erase);
            order.set_scissor(&mut pass, &group.rect);
            pass.draw(0..3, 0..1);
        }
        pass.set_pipeline(&bound.slices);
        pass.set_bind_group(0, &bound.frame, &[]);
        let mut texture = None;
        for number in group.first..group.first + group.count {
            let brick = &order.round.bricks[number];
            if texture.replace(brick.texture) != Some(brick.texture) {
                pass.set_bind_group(1, &bound.atlas[brick.texture as usize], &[]);
            }
            pass.set_bind_group(2, &bound.bricks, &[number as u32 * order.stride]);
            if style.asks {
                let query = (group.first_query + number - group.first) as u64;
                pass.draw_indirect(self.buffers.draws.get(), query * size_of::<DrawArgs>() as u64);
            } else {
                pass.draw(0..SLAB_CORNERS, 0..brick.slabs());
            }
        }
        drop(pass);
        if is_dvr {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("under"),
                color_attachments: &[Some(color(&self.targets().accumulated, LoadOp::Load))],
                ..Default::default()
            });
            pass.set_pipeline(&self.pipelines.under);
            pass.set_bind_group(0, &bound.layer, &[]);
            order.set_scissor(&mut pass, &group.rect);
            pass.draw(0..3, 0..1);
        }
    }

    /// Begins a tile: nothing is drawn, no pixel opaque, no value found.
    pub fn clear(&self, device: &GpuDevice, style: Style) {
        let mut encoder = device.device.create_command_encoder(&Default::default());
        let clear = LoadOp::Clear(wgpu::Color::TRANSPARENT);
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("clear"),
            color_attachments: &[Some(color(&self.targets().accumulated, clear))],
            depth_stencil_attachment: Some(self.loaded(style, LoadOp::Clear(0.0), LoadOp::Clear(0))),
            ..Default::default()
        });
        device.queue.submit([encoder.finish()]);
    }

    /// The stencil, or the ranks, which stay from pass to pass.
    fn kept(&self, style: Style) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        self.loaded(style, LoadOp::Load, LoadOp::Load)
    }

    fn loaded(
        &self,
        style: Style,
        ranks: LoadOp<f32>,
        stencil: LoadOp<u32>,
    ) -> wgpu::RenderPassDepthStencilAttachment<'_> {
        let store = StoreOp::Store;
        wgpu::RenderPassDepthStencilAttachment {
            view: if style.is_ranked() { &self.targets().ranks } else { &self.targets().stencil },
            depth_ops: style.is_ranked().then_some(Operations { load: ranks, store }),
            stencil_ops: (!style.is_ranked()).then_some(Operations { load: stencil, store }),
        }
    }
}

fn color(view: &wgpu::TextureView, load: LoadOp<wgpu::Color>) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: Operations { load, store: StoreOp::Store },
    }
}

/// What a round's passes are bound to.
struct Bound {
    frame: wgpu::BindGroup,
    bricks: wgpu::BindGroup,
    visible: wgpu::BindGroup,
    layer: wgpu::BindGroup,
    accumulated: wgpu::BindGroup,
    atlas: Vec<wgpu::BindGroup>,
    slices: wgpu::RenderPipeline,
    boxes: wgpu::RenderPipeline,
}

impl Bound {
    fn new(slices: &SlicesPass, order: &RoundEncoder, residents: &Residents) -> Self {
        let (gpu, shared, atlas) = (order.parts.device, order.parts.shared, order.parts.atlas);
        let device = &gpu.device;
        let style = order.style;
        let drawn = slices.pipelines.slices(gpu, style.pixels, atlas.filters(), atlas.one_layout());
        let boxes = slices.pipelines.boxes(gpu, style.is_ranked());
        let (pipelines, buffers, targets) = (&slices.pipelines, &slices.buffers, slices.targets());
        let picture =
            |view| bind(device, &pipelines.picture, &[(0, wgpu::BindingResource::TextureView(view))]);
        Self {
            frame: bind(
                device,
                &pipelines.frame,
                &[(0, shared.frame.as_entire_binding()), (2, shared.entries())],
            ),
            bricks: bind(
                device,
                &pipelines.brick,
                &[(0, buffers.bricks.part(size_of::<SlicedBrick>() as u64))],
            ),
            visible: bind(
                device,
                &pipelines.visible,
                &[
                    (0, buffers.ranges.part(size_of::<QueryRange>() as u64)),
                    (1, buffers.counts.binding()),
                    (2, buffers.draws.binding()),
                ],
            ),
            layer: picture(&targets.layer),
            accumulated: picture(&targets.accumulated),
            atlas: atlas.each(gpu, &residents.textures),
            slices: drawn,
            boxes,
        }
    }
}
