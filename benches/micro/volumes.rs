//! What the benchmarks measure on: volumes of one brick and lists of many, made by rule.

use glam::{DVec3, UVec2, UVec3};
use glassbrick_brick_store::{CachedSource, FlatSource};
use glassbrick_cpu::{CpuScene, InstructionSet, ShownCells};
use glassbrick_volume::{
    BakedTransferFunction, BrickLayout, BrickRange, BrickSource, Camera, ControlPoint, FramePlan, FrameRays,
    NamedView, Projection, RenderSettings, StoredType, TransferFunction, VolumeDesc,
};

/// Pixels along a side of the pictures of one brick: rays are half a voxel apart.
const PIXELS: u32 = 128;

/// Voxels along an axis of a volume of one brick: a core.
pub const BRICK_VOXELS: u32 = 60;

/// Values that rise and fall gently, with some noise, between 0 and 2000.
pub fn voxels(extent: UVec3) -> Vec<u8> {
    let at = |x: u32, y: u32, z: u32| {
        let wave = (f64::from(x) / 9.0).sin() * (f64::from(y) / 7.0).cos() * (f64::from(z) / 11.0).sin();
        let noise = x.wrapping_mul(7919) ^ y.wrapping_mul(104_729) ^ z.wrapping_mul(1_299_709);
        (1000.0 + 950.0 * wave) as u16 + (noise % 50) as u16
    };
    (0..extent.z)
        .flat_map(|z| (0..extent.y).flat_map(move |y| (0..extent.x).map(move |x| at(x, y, z))))
        .flat_map(u16::to_ne_bytes)
        .collect()
}

/// A volume in memory.
pub fn source(extent: UVec3) -> FlatSource {
    let desc = VolumeDesc::new(extent, StoredType::U16);
    FlatSource::from_array(desc, voxels(extent), BrickLayout::default()).expect("the array fits its extent")
}

/// A picture of one resident brick that fills it, seen straight or askew.
pub struct OneBrick {
    source: CachedSource,
    rays: FrameRays,
    plan: FramePlan,
    transfer_function: BakedTransferFunction,
    shown_cells: ShownCells,
}

impl OneBrick {
    /// The brick seen from `azimuth_deg`, with a transfer function of `opacity` for all values.
    pub fn new(azimuth_deg: f64, opacity: f64) -> Self {
        let source = CachedSource::new(Box::new(source(UVec3::splat(BRICK_VOXELS))), 1 << 30, 1)
            .expect("there is memory for a brick");
        let projection = Projection::Orthographic { height_mm: f64::from(BRICK_VOXELS) };
        let camera = Camera { projection, ..Camera::framing_around(source.desc(), azimuth_deg, 0.0) };
        let rays = FrameRays::new(&source.desc().level(0), &camera, UVec2::splat(PIXELS), 1.0)
            .expect("a sound camera");
        let plan = FramePlan::new(0, &source.grid(0), &rays, &[0]);
        let point = |value, opacity| ControlPoint { value, color: [1.0, value / 2000.0, 0.5], opacity };
        let points = vec![point(0.0, opacity), point(2000.0, opacity * 0.5)];
        let transfer_function = TransferFunction { points, unit_mm: None }.bake(1.0);
        Self { source, rays, plan, transfer_function, shown_cells: ShownCells::new(1) }
    }

    /// Draws it; returns how many samples were evaluated.
    pub fn draw(&self, settings: RenderSettings, instruction_set: InstructionSet) -> u64 {
        let scene = CpuScene {
            rays: &self.rays,
            plan: &self.plan,
            transfer_function: &self.transfer_function,
            settings,
            shown_cells: &self.shown_cells,
            allow_damaged: false,
        };
        glassbrick_cpu::draw(&self.source, &scene, instruction_set).expect("an array is read").samples
    }
}

/// Ranges of bricks as those of a scan: half of them air, the others anything.
pub fn ranges(count: usize) -> Vec<BrickRange> {
    let mut state = 1u32;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) as f32 / 32.0
    };
    (0..count)
        .map(|_| {
            let (low, width, kind) = (next(), next(), next());
            let range = if kind < 1024.0 { [0.0, 20.0] } else { [low, low + width] };
            BrickRange { reach: range, core: range }
        })
        .collect()
}

/// Opaque above a value, with a steep ramp.
pub fn opaque_above(value: f64) -> TransferFunction {
    let point = |value, opacity| ControlPoint { value, color: [1.0; 3], opacity };
    TransferFunction {
        points: vec![point(value, 0.0), point(value + 200.0, 0.9), point(3000.0, 0.9)],
        unit_mm: None,
    }
}

/// A camera that sees a whole grid from the front.
pub fn camera(desc: &VolumeDesc) -> Camera {
    let camera = Camera::framing(desc, NamedView::Front);
    Camera { up: DVec3::Z, ..camera }
}
