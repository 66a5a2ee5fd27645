//! What passes are bound to, in few words.

use wgpu::{BindingType, BufferBindingType, SamplerBindingType, ShaderStages, TextureSampleType};

/// A layout of bindings, each seen by `stages`.
pub fn layout_of(
    device: &wgpu::Device,
    label: &str,
    stages: ShaderStages,
    bindings: &[(u32, BindingType)],
) -> wgpu::BindGroupLayout {
    let entries: Vec<wgpu::BindGroupLayoutEntry> = bindings
        .iter()
        .map(|&(binding, ty)| wgpu::BindGroupLayoutEntry { binding, visibility: stages, ty, count: None })
        .collect();
    device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// Things bound as a layout says.
pub fn bind(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    resources: &[(u32, wgpu::BindingResource)],
) -> wgpu::BindGroup {
    let entries: Vec<wgpu::BindGroupEntry> = resources
        .iter()
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding: *binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

pub fn uniform() -> BindingType {
    buffer(BufferBindingType::Uniform, false)
}

/// A uniform of which each draw takes its own part.
pub fn uniform_parts() -> BindingType {
    buffer(BufferBindingType::Uniform, true)
}

pub fn read_only() -> BindingType {
    buffer(BufferBindingType::Storage { read_only: true }, false)
}

pub fn storage() -> BindingType {
    buffer(BufferBindingType::Storage { read_only: false }, false)
}

fn buffer(ty: BufferBindingType, has_dynamic_offset: bool) -> BindingType {
    BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None }
}

pub fn volume_texture(filters: bool) -> BindingType {
    BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable: filters },
        view_dimension: wgpu::TextureViewDimension::D3,
        multisampled: false,
    }
}

/// A picture whose pixels are read one by one.
pub fn picture() -> BindingType {
    BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}

pub fn linear() -> BindingType {
    BindingType::Sampler(SamplerBindingType::Filtering)
}
