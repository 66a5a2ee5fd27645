use glassbrick_residency::AtlasTextures;
use wgpu::{BindingResource, ShaderStages};

use crate::GpuDevice;
use crate::bindings::{bind, layout_of, linear, volume_texture};
use crate::filter_probe::linear_sampler;

/// Where the sampler is bound, behind all textures.
const SAMPLER: u32 = 16;

/// How passes are given the atlas.
pub struct AtlasBindings {
    /// All textures, for a march.
    layout: wgpu::BindGroupLayout,
    /// One texture, for slices.
    one_layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    filters: bool,
    textures: usize,
}

impl AtlasBindings {
    /// For a march that chooses from so many textures.
    pub fn new(device: &wgpu::Device, filters: bool, textures: usize) -> Self {
        let bindings = |textures: usize| {
            let all = (0..textures as u32).map(|texture| (texture, volume_texture(filters)));
            all.chain(filters.then(|| (SAMPLER, linear()))).collect::<Vec<_>>()
        };
        Self {
            layout: layout_of(device, "atlas", ShaderStages::COMPUTE, &bindings(textures)),
            one_layout: layout_of(device, "an atlas texture", ShaderStages::FRAGMENT, &bindings(1)),
            sampler: device.create_sampler(&linear_sampler()),
            filters,
            textures,
        }
    }

    pub fn filters(&self) -> bool {
        self.filters
    }

    /// Textures that a march chooses from.
    pub fn textures(&self) -> usize {
        self.textures
    }

    pub fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    pub fn one_layout(&self) -> &wgpu::BindGroupLayout {
        &self.one_layout
    }

    /// All textures; the first again where others are not made.
    pub fn all(&self, device: &GpuDevice, atlas: &AtlasTextures) -> wgpu::BindGroup {
        let textures = atlas.textures();
        let chosen = (0..self.textures).map(|texture| textures.get(texture).unwrap_or(&textures[0]));
        self.bind(device, &self.layout, chosen)
    }

    /// Each texture for itself.
    pub fn each(&self, device: &GpuDevice, atlas: &AtlasTextures) -> Vec<wgpu::BindGroup> {
        let one = |texture| self.bind(device, &self.one_layout, std::iter::once(texture));
        atlas.textures().iter().map(one).collect()
    }

    fn bind<'a>(
        &self,
        device: &GpuDevice,
        layout: &wgpu::BindGroupLayout,
        textures: impl Iterator<Item = &'a wgpu::Texture>,
    ) -> wgpu::BindGroup {
        let views: Vec<wgpu::TextureView> =
            textures.map(|texture| texture.create_view(&Default::default())).collect();
        let mut resources: Vec<(u32, BindingResource)> = views
            .iter()
            .enumerate()
            .map(|(texture, view)| (texture as u32, BindingResource::TextureView(view)))
            .collect();
        if self.filters {
            resources.push((SAMPLER, BindingResource::Sampler(&self.sampler)));
        }
        bind(&device.device, layout, &resources)
    }
}
