use glassbrick_shaders::{Pass, Pixels};
use wgpu::{
    BlendComponent, BlendFactor, BlendOperation, BlendState, ColorTargetState, ColorWrites, CompareFunction,
    DepthBiasState, DepthStencilState, Face, FrontFace, PrimitiveState, ShaderStages, StencilFaceState,
    StencilOperation, StencilState, TextureFormat,
};

use super::targets::{RANK_FORMAT, STENCIL_FORMAT, SliceTargets};
use crate::GpuDevice;
use crate::bindings::{bind, layout_of, picture, read_only, storage, uniform, uniform_parts};

/// The layouts and pipelines of the slices pass.
pub struct SlicePipelines {
    /// What all draws read.
    pub frame: wgpu::BindGroupLayout,
    /// A brick, at an offset of its own.
    pub brick: wgpu::BindGroupLayout,
    /// A picture that is read.
    pub picture: wgpu::BindGroupLayout,
    pub visible: wgpu::BindGroupLayout,
    pub under: wgpu::RenderPipeline,
    /// Empties a layer's image where the layer is drawn.
    pub erase: wgpu::RenderPipeline,
    /// Copies a picture of another format into one that is read back.
    pub copy: wgpu::RenderPipeline,
    pub opaque: wgpu::RenderPipeline,
    pub find_visible: wgpu::ComputePipeline,
}

/// What a picture is read back in.
pub const READ_FORMAT: TextureFormat = TextureFormat::Rgba32Float;

impl SlicePipelines {
    pub fn new(gpu: &GpuDevice) -> Self {
        let (device, blend_format) = (&gpu.device, gpu.tier.blend_format());
        let frame = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame of slices"),
            entries: &[(0, uniform(), ShaderStages::VERTEX_FRAGMENT), (2, picture(), ShaderStages::FRAGMENT)]
                .map(|(binding, ty, visibility)| wgpu::BindGroupLayoutEntry {
                    binding,
                    visibility,
                    ty,
                    count: None,
                }),
        });
        let brick = layout_of(device, "brick", ShaderStages::VERTEX_FRAGMENT, &[(0, uniform_parts())]);
        let picture_layout = layout_of(device, "picture", ShaderStages::FRAGMENT, &[(0, picture())]);
        let visible = layout_of(
            device,
            "visible",
            ShaderStages::COMPUTE,
            &[(0, uniform_parts()), (1, read_only()), (2, storage())],
        );
        let full_screen = |pass, groups: &[Option<&wgpu::BindGroupLayout>], stencil, target: Option<_>| {
            Drawn { pass, groups, stencil, targets: target.as_slice(), cull: None }.pipeline(gpu)
        };
        let under = full_screen(
            Pass::Under,
            &[Some(&picture_layout)],
            None,
            Some(blended(blend_format, BlendFactor::OneMinusDstAlpha, BlendFactor::One)),
        );
        let erase = full_screen(Pass::Erase, &[], Some(ignores_stencil()), Some(plain(blend_format)));
        let copy = full_screen(Pass::Under, &[Some(&picture_layout)], None, Some(plain(READ_FORMAT)));
        let opaque =
            full_screen(Pass::Opaque, &[Some(&frame), Some(&picture_layout)], Some(sets_stencil()), None);
        Self {
            find_visible: gpu.compute_pipeline(Pass::Visible, &[Some(&visible)]),
            frame,
            brick,
            picture: picture_layout,
            visible,
            under,
            erase,
            copy,
            opaque,
        }
    }

    /// Draws slices of bricks in an atlas texture.
    pub fn slices(
        &self,
        gpu: &GpuDevice,
        pixels: Pixels,
        filters: bool,
        atlas: &wgpu::BindGroupLayout,
    ) -> wgpu::RenderPipeline {
        let (stencil, target) = match pixels {
            Pixels::Dvr | Pixels::DvrShaded => (
                Some(where_not_opaque()),
                blended(gpu.tier.blend_format(), BlendFactor::One, BlendFactor::OneMinusSrcAlpha),
            ),
            Pixels::Extremum => (Some(where_better(true)), plain(READ_FORMAT)),
            Pixels::Mean => (None, blended(READ_FORMAT, BlendFactor::One, BlendFactor::One)),
        };
        let groups = &[Some(&self.frame), Some(atlas), Some(&self.brick)];
        let pass = Pass::Slices { pixels, filters };
        Drawn { pass, groups, stencil, targets: &[target], cull: None }.pipeline(gpu)
    }

    /// Asks about boxes of bricks: ranked ones against the ranks that there are, others against the stencil.
    pub fn boxes(&self, gpu: &GpuDevice, ranked: bool) -> wgpu::RenderPipeline {
        let stencil = Some(if ranked { where_better(false) } else { where_not_opaque() });
        let groups = &[Some(&self.frame), None, Some(&self.brick)];
        Drawn { pass: Pass::Boxes { ranked }, groups, stencil, targets: &[], cull: Some(Face::Front) }
            .pipeline(gpu)
    }

    /// A copy of what is accumulated, in the format that is read back.
    pub fn copied(
        &self,
        gpu: &GpuDevice,
        encoder: &mut wgpu::CommandEncoder,
        targets: &SliceTargets,
    ) -> wgpu::Texture {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("copy"),
            size: targets.accumulated_texture().size(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: READ_FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&Default::default());
        let accumulated = wgpu::BindingResource::TextureView(&targets.accumulated);
        let bindings = bind(&gpu.device, &self.picture, &[(0, accumulated)]);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("copy"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.copy);
        pass.set_bind_group(0, &bindings, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        texture
    }
}

/// A pipeline that draws.
struct Drawn<'a> {
    pass: Pass,
    groups: &'a [Option<&'a wgpu::BindGroupLayout>],
    stencil: Option<DepthStencilState>,
    targets: &'a [ColorTargetState],
    cull: Option<Face>,
}

impl Drawn<'_> {
    fn pipeline(&self, gpu: &GpuDevice) -> wgpu::RenderPipeline {
        let format = self.targets.first().map(|target| target.format);
        gpu.render_pipeline(self.pass, format, || self.make(gpu))
    }

    fn make(&self, gpu: &GpuDevice) -> wgpu::RenderPipeline {
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.pass.name()),
            bind_group_layouts: self.groups,
            immediate_size: 0,
        });
        let module = gpu.module(self.pass);
        let targets: Vec<Option<ColorTargetState>> = self.targets.iter().cloned().map(Some).collect();
        let has_fragments = self.pass != Pass::Boxes { ranked: false };
        let fragment = has_fragments.then(|| wgpu::FragmentState {
            module: &module,
            entry_point: None,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        });
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.pass.name()),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: None,
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: PrimitiveState {
                front_face: FrontFace::Cw,
                cull_mode: self.cull,
                ..PrimitiveState::default()
            },
            depth_stencil: self.stencil.clone(),
            multisample: wgpu::MultisampleState::default(),
            fragment,
            multiview_mask: None,
            cache: None,
        })
    }
}

fn plain(format: TextureFormat) -> ColorTargetState {
    ColorTargetState { format, blend: None, write_mask: ColorWrites::ALL }
}

fn blended(format: TextureFormat, src_factor: BlendFactor, dst_factor: BlendFactor) -> ColorTargetState {
    let component = BlendComponent { src_factor, dst_factor, operation: BlendOperation::Add };
    let blend = Some(BlendState { color: component, alpha: component });
    ColorTargetState { format, blend, write_mask: ColorWrites::ALL }
}

/// Only pixels that are not opaque, whose stencil is 0.
fn where_not_opaque() -> DepthStencilState {
    with_stencil(CompareFunction::Equal, StencilOperation::Keep, 0)
}

/// All pixels.
fn ignores_stencil() -> DepthStencilState {
    with_stencil(CompareFunction::Always, StencilOperation::Keep, 0)
}

/// Marks pixels as opaque.
fn sets_stencil() -> DepthStencilState {
    with_stencil(CompareFunction::Always, StencilOperation::Replace, !0)
}

fn with_stencil(compare: CompareFunction, pass_op: StencilOperation, write_mask: u32) -> DepthStencilState {
    let face = StencilFaceState {
        compare,
        fail_op: StencilOperation::Keep,
        depth_fail_op: StencilOperation::Keep,
        pass_op,
    };
    DepthStencilState {
        format: STENCIL_FORMAT,
        depth_write_enabled: None,
        depth_compare: None,
        stencil: StencilState { front: face, back: face, read_mask: !0, write_mask },
        bias: DepthBiasState::default(),
    }
}

/// Only where a rank is higher than what is there.
fn where_better(writes: bool) -> DepthStencilState {
    DepthStencilState {
        format: RANK_FORMAT,
        depth_write_enabled: Some(writes),
        depth_compare: Some(CompareFunction::Greater),
        stencil: StencilState::default(),
        bias: DepthBiasState::default(),
    }
}
