//! The GPU gives the picture that the reference gives, by rays and by slices, through as little memory as there is, and
//! says what that took.
//!
//! What wgpu's validation finds wrong with a pass comes back as an error of the frame, so `expect` is all that it takes
//! to hold that passes are sound.

mod agreement;
mod command;
mod cutoff;
mod damage;
mod interactive;
mod lost;
mod real_volumes;
mod reports;
mod skipping;
mod tiers;

use std::sync::OnceLock;

use glassbrick::{
    Backend, BrickLayout, Camera, Gpu, GpuPass, OpenSettings, RenderRequest, Rendered, Renderer, Volume,
};
use glassbrick_tests::drawing::{camera, desc, native_bytes, request};
use glassbrick_tests::reference::{ReferenceFrame, render};
use glassbrick_tests::scenes::{Scene, scenes};
use glassbrick_tests::tolerance::{Difference, compare};

const PASSES: [GpuPass; 2] = [GpuPass::Raycast, GpuPass::Slices];

/// Bricks of which an atlas texture of 256³ has 8 slots: the scenes have more.
const FEW_SLOTS: BrickLayout = BrickLayout { edge: 100, halo: 30 };
/// Bricks of which an atlas texture of 256³ has one slot.
const ONE_SLOT: BrickLayout = BrickLayout { edge: 140, halo: 40 };

/// How much a GPU may keep.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Memory {
    /// So many atlas textures of 256³.
    Textures(u64),
    /// More than any scene needs.
    Plenty,
}

const ONE_TEXTURE: Memory = Memory::Textures(1);
const PLENTY_BYTES: u64 = 512 << 20;

impl Memory {
    fn bytes(self, gpu: &Gpu, volume: &Volume) -> u64 {
        match self {
            Self::Plenty => PLENTY_BYTES,
            Self::Textures(textures) => textures * texture_bytes(gpu, volume),
        }
    }
}

/// Bytes of an atlas texture of a volume, which are as many as the refusal of too little memory says: how voxels are
/// kept depends on what the GPU can filter.
pub fn texture_bytes(gpu: &Gpu, volume: &Volume) -> u64 {
    let request = on(gpu, GpuPass::Raycast, request(&scenes()[0]));
    let refused = Renderer::new(volume, RenderRequest { gpu_memory_bytes: 1, ..request });
    needed_bytes(&refused.err().expect("one byte holds no texture").to_string())
}

/// What the refusal of too little memory says that is needed: its last number.
#[track_caller]
fn needed_bytes(refusal: &str) -> u64 {
    let mut from_the_end = refusal.rsplit(' ').filter_map(|word| word.parse().ok());
    from_the_end.next().unwrap_or_else(|| panic!("no number: {refusal}"))
}

/// A request, to be drawn on the GPU.
pub fn on(gpu: &Gpu, pass: GpuPass, request: RenderRequest) -> RenderRequest {
    RenderRequest { backend: Backend::Gpu(gpu.clone()), pass, ..request }
}

/// A scene's volume from an array in memory.
fn volume(scene: &Scene, layout: BrickLayout) -> Volume {
    let settings = OpenSettings { layout, threads: Some(2), ..OpenSettings::default() };
    Volume::from_array(desc(scene), native_bytes(scene), &settings).expect("a scene's array is sound")
}

/// A scene's request, to be drawn on the GPU with so much memory for bricks.
fn request_on(gpu: &Gpu, pass: GpuPass, memory: Memory, scene: &Scene, volume: &Volume) -> RenderRequest {
    RenderRequest { gpu_memory_bytes: memory.bytes(gpu, volume), ..on(gpu, pass, request(scene)) }
}

/// Draws a scene on the GPU, so that nothing stops early, with the request changed as is wanted.
fn draw(
    gpu: &Gpu,
    pass: GpuPass,
    (layout, memory): (BrickLayout, Memory),
    scene: &Scene,
    change: impl Fn(&mut RenderRequest),
) -> Rendered {
    let volume = volume(scene, layout);
    let mut request = request_on(gpu, pass, memory, scene, &volume);
    change(&mut request);
    render_with(&volume, request, &camera(scene))
}

fn render_with(volume: &Volume, request: RenderRequest, camera: &Camera) -> Rendered {
    volume.render(request, camera).expect("a scene can be drawn")
}

/// Every scene with its reference.
fn scenes_and_truths() -> impl Iterator<Item = (&'static Scene, &'static ReferenceFrame)> {
    static TRUTHS: OnceLock<Vec<ReferenceFrame>> = OnceLock::new();
    let truths = TRUTHS.get_or_init(|| scenes().iter().map(|scene| render(&scene.reference())).collect());
    scenes().iter().zip(truths)
}

/// How far two of glassbrick's pictures are apart.
fn difference(a: &Rendered, b: &Rendered) -> Difference {
    let exact: Vec<[f64; 4]> = b.frame.rgba.iter().map(|pixel| pixel.map(f64::from)).collect();
    compare(&a.frame.rgba, &exact)
}

/// A scene by its name.
fn scene(name: &str) -> &'static Scene {
    scenes().iter().find(|scene| scene.name == name).unwrap_or_else(|| panic!("there is no scene {name}"))
}
