//! Tries how exact a texture unit is. Hardware mostly filters with 8 bits of a texel's width, some software drivers with
//! 8 bits of value; pictures need more, and read eight texels themselves there.

use bytemuck::cast_slice;
use glam::Vec3;
use glassbrick_residency::TexelFormat;
use glassbrick_shaders::{Pass, wgsl};
use wgpu::util::DeviceExt;

use crate::bindings::{bind, layout_of, linear, read_only, storage, volume_texture};

/// Texels along an axis of the texture that is tried.
const EDGE: u32 = 4;
/// Places that are tried.
const PLACES: u32 = 256;
/// The largest difference from the truth, of values from 0 to 1.
const TOLERANCE: f32 = 4e-6;

/// Whether texels of a format, which can be filtered, are filtered as exactly as pictures need it.
pub fn filters_exactly(device: &wgpu::Device, queue: &wgpu::Queue, format: TexelFormat) -> bool {
    let texels: Vec<f32> = (0..EDGE.pow(3)).map(|texel| (texel * 37 % 64) as f32 / 63.0).collect();
    let texels: Vec<f32> = texels.iter().map(|&value| rounded(value, format)).collect();
    let places: Vec<Vec3> = (0..PLACES).map(place).collect();
    let Some(values) = read(device, queue, format, &texels, &places) else { return false };
    let is_exact = |(value, place): (&f32, &Vec3)| (value - trilinear(&texels, *place)).abs() <= TOLERANCE;
    values.len() == places.len() && values.iter().zip(&places).all(is_exact)
}

/// A place between the texels' centres, spread by the golden ratio and its kin.
fn place(number: u32) -> Vec3 {
    let fractions = Vec3::new(0.819_172_5, 0.671_043_6, 0.549_700_5) * number as f32;
    (fractions - fractions.floor()) * (EDGE - 1) as f32
}

/// The value that a texel can have.
fn rounded(value: f32, format: TexelFormat) -> f32 {
    match format {
        TexelFormat::R8 | TexelFormat::Rg8 => (value * 255.0).round() / 255.0,
        TexelFormat::R16 => (value * 65535.0).round() / 65535.0,
        TexelFormat::R32 => value,
    }
}

fn encoded(texels: &[f32], format: TexelFormat) -> Vec<u8> {
    match format {
        TexelFormat::R8 => texels.iter().map(|&value| (value * 255.0).round() as u8).collect(),
        TexelFormat::Rg8 => texels.iter().flat_map(|&value| [(value * 255.0).round() as u8, 0]).collect(),
        TexelFormat::R16 => {
            texels.iter().flat_map(|&value| ((value * 65535.0).round() as u16).to_le_bytes()).collect()
        }
        TexelFormat::R32 => texels.iter().flat_map(|value| value.to_le_bytes()).collect(),
    }
}

fn trilinear(texels: &[f32], at: Vec3) -> f32 {
    let cell = at.floor().min(Vec3::splat((EDGE - 2) as f32));
    let t = at - cell;
    let [x, y, z] = cell.to_array().map(|c| c as usize);
    let texel = |dx, dy, dz| {
        let edge = EDGE as usize;
        texels[((z + dz) * edge + y + dy) * edge + x + dx]
    };
    let mix = |a: f32, b: f32, t: f32| a + t * (b - a);
    let row = |dy, dz| mix(texel(0, dy, dz), texel(1, dy, dz), t.x);
    mix(mix(row(0, 0), row(1, 0), t.y), mix(row(0, 1), row(1, 1), t.y), t.z)
}

fn read(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    format: TexelFormat,
    texels: &[f32],
    places: &[Vec3],
) -> Option<Vec<f32>> {
    let texture = device.create_texture_with_data(
        queue,
        &wgpu::TextureDescriptor {
            label: Some("filter probe"),
            size: wgpu::Extent3d { width: EDGE, height: EDGE, depth_or_array_layers: EDGE },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D3,
            format: format.wgpu(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &encoded(texels, format),
    );
    let coordinates: Vec<[f32; 4]> =
        places.iter().map(|&place| ((place + 0.5) / EDGE as f32).extend(0.0).to_array()).collect();
    let places = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("filter probe places"),
        contents: cast_slice(&coordinates),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let bytes = u64::from(PLACES) * 4;
    let buffer = |label, usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes,
            usage,
            mapped_at_creation: false,
        })
    };
    let values = buffer("filter probe values", wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let read = buffer("filter probe read", wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("filter probe"),
        source: wgpu::ShaderSource::Wgsl(wgsl(Pass::FilterProbe).into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("filter probe"),
        layout: Some(&layout(device)),
        module: &module,
        entry_point: None,
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let bindings = bind(
        device,
        &pipeline.get_bind_group_layout(0),
        &[
            (0, wgpu::BindingResource::TextureView(&texture.create_view(&Default::default()))),
            (1, wgpu::BindingResource::Sampler(&device.create_sampler(&linear_sampler()))),
            (2, places.as_entire_binding()),
            (3, values.as_entire_binding()),
        ],
    );
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bindings, &[]);
    pass.dispatch_workgroups(PLACES.div_ceil(64), 1, 1);
    drop(pass);
    encoder.copy_buffer_to_buffer(&values, 0, &read, 0, bytes);
    queue.submit([encoder.finish()]);
    read.map_async(wgpu::MapMode::Read, .., |_| ());
    device.poll(wgpu::PollType::wait_indefinitely()).ok()?;
    let mapped = read.get_mapped_range(..).ok()?;
    Some(bytemuck::pod_collect_to_vec(&mapped))
}

/// Between texels linearly, and held at the edges.
pub fn linear_sampler() -> wgpu::SamplerDescriptor<'static> {
    wgpu::SamplerDescriptor {
        label: Some("linear"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    }
}

fn layout(device: &wgpu::Device) -> wgpu::PipelineLayout {
    let group = layout_of(
        device,
        "filter probe",
        wgpu::ShaderStages::COMPUTE,
        &[(0, volume_texture(true)), (1, linear()), (2, read_only()), (3, storage())],
    );
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("filter probe"),
        bind_group_layouts: &[Some(&group)],
        immediate_size: 0,
    })
}
