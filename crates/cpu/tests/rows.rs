//! Pictures that are drawn along rows of voxels are, to the bit, those whose voxels are gathered.

use std::sync::Arc;

use glam::{UVec2, UVec3};
use glassbrick_brick_store::FlatSource;
use glassbrick_cpu::{CpuFrame, CpuScene, InstructionSet, ShownCells, draw};
use glassbrick_volume::{
    Brick, BrickGrid, BrickId, BrickLayout, BrickRange, BrickSource, Camera, ControlPoint, FramePlan,
    FrameRays, Mode, NamedView, Phong, ReadError, RenderSettings, Skip, StoredType, TransferFunction,
    VolumeDesc, VoxelCountTable, filtered_visible,
};

/// A source without the memory for all bricks of a frame: these frames are drawn layer by layer, by gathering.
struct ShortOfMemory<'a>(&'a FlatSource);

impl BrickSource for ShortOfMemory<'_> {
    fn desc(&self) -> &VolumeDesc {
        self.0.desc()
    }
    fn levels(&self) -> u32 {
        self.0.levels()
    }
    fn grid(&self, level: u32) -> BrickGrid {
        self.0.grid(level)
    }
    fn ranges(&self, level: u32) -> &[BrickRange] {
        self.0.ranges(level)
    }
    fn voxel_count_tables(&self, level: u32) -> Result<Arc<Vec<VoxelCountTable>>, ReadError> {
        self.0.voxel_count_tables(level)
    }
    fn brick(&self, id: BrickId) -> Result<Arc<Brick>, ReadError> {
        self.0.brick(id)
    }
    fn will_need(&self, bricks: &[BrickId]) {
        self.0.will_need(bricks);
    }
    fn can_hold(&self, _bricks: usize) -> bool {
        false
    }
    fn not_finite(&self) -> u64 {
        self.0.not_finite()
    }
    fn bytes_read(&self) -> u64 {
        self.0.bytes_read()
    }
}

const EXTENT: UVec3 = UVec3::new(150, 70, 90);

/// Blobs in noise that goes through much of the type's range; some bricks are empty.
fn volume(stored_type: StoredType, edge: u32) -> FlatSource {
    let desc = VolumeDesc::new(EXTENT, stored_type);
    let mut bytes = Vec::new();
    for z in 0..EXTENT.z {
        for y in 0..EXTENT.y {
            for x in 0..EXTENT.x {
                let at = UVec3::new(x, y, z).as_vec3() * 0.17;
                let blob = (at.x.sin() * at.y.cos() + at.z.sin() * (0.4 * at.x).cos()).max(0.0) / 2.0;
                let noise = (x * 7919 + y * 104_729 + z * 1_299_709) % 97;
                let part = if x < 40 { 0.0 } else { 0.9 * blob + 0.001 * noise as f32 };
                match stored_type {
                    StoredType::U8 => bytes.push((part * 255.0) as u8),
                    StoredType::I8 => bytes.push((part * 255.0 - 128.0) as i8 as u8),
                    StoredType::U16 => bytes.extend(((part * 65_535.0) as u16).to_ne_bytes()),
                    StoredType::I16 => bytes.extend(((part * 65_535.0 - 32_768.0) as i16).to_ne_bytes()),
                    StoredType::I32 => bytes.extend(((part * 2e6 - 1e6) as i32).to_ne_bytes()),
                    StoredType::F32 => bytes.extend((part * 3.0 - 0.7).to_ne_bytes()),
                    other => unreachable!("{other} is read as one of the others"),
                }
            }
        }
    }
    FlatSource::from_array(desc, bytes, BrickLayout { edge, halo: 2 }).expect("the array is sound")
}

/// A veil, and something opaque.
fn transfer_function(source: &FlatSource) -> TransferFunction {
    let ranges = source.ranges(0).iter().map(|range| range.core);
    let [low, high] =
        ranges.fold([f32::INFINITY, f32::NEG_INFINITY], |a, b| [a[0].min(b[0]), a[1].max(b[1])]);
    let point = |part: f32, color, opacity| ControlPoint {
        value: f64::from(low + part * (high - low)),
        color,
        opacity,
    };
    let points = vec![
        point(0.0, [0.0, 0.0, 0.5], 0.0),
        point(0.2, [0.9, 0.2, 0.1], 0.0),
        point(0.4, [0.2, 0.8, 0.3], 0.05),
        point(0.9, [0.8, 0.8, 0.9], 0.7),
    ];
    TransferFunction { points, unit_mm: None }
}

fn frame(
    source: &dyn BrickSource,
    tf: &TransferFunction,
    camera: &Camera,
    size: UVec2,
    settings: RenderSettings,
) -> CpuFrame {
    let rays = FrameRays::new(&source.desc().level(0), camera, size, 1.0).expect("sound camera");
    let baked = tf.bake(1.0);
    let grid = source.grid(0);
    let bricks = if settings.mode == Mode::Dvr {
        filtered_visible(source.ranges(0), &baked.bands(), source.desc().rescale).bricks
    } else {
        (0..grid.len() as u32).collect()
    };
    let plan = FramePlan::new(0, &grid, &rays, &bricks);
    let shown_cells = ShownCells::new(grid.len());
    let scene = CpuScene {
        rays: &rays,
        plan: &plan,
        transfer_function: &baked,
        settings,
        shown_cells: &shown_cells,
        allow_damaged: false,
    };
    draw(source, &scene, InstructionSet::best()).expect("an array can be read")
}

fn settings() -> Vec<RenderSettings> {
    let plain = RenderSettings::default();
    vec![
        plain,
        RenderSettings { opacity_cutoff: 1.0, skip: Skip::None, ..plain },
        RenderSettings { shading: Some(Phong::default()), ..plain },
        RenderSettings { mode: Mode::Mip, ..plain },
        RenderSettings { mode: Mode::Minip, ..plain },
        RenderSettings { mode: Mode::Mean, ..plain },
    ]
}

#[test]
fn rows_are_what_is_gathered() {
    for (stored_type, edge) in [
        (StoredType::U8, 64),
        (StoredType::I8, 24),
        (StoredType::U16, 32),
        (StoredType::I16, 64),
        (StoredType::F32, 64),
        (StoredType::I32, 40),
    ] {
        let source = volume(stored_type, edge);
        let tf = transfer_function(&source);
        let views = [NamedView::Front, NamedView::Back, NamedView::Top, NamedView::Bottom];
        let mut cameras: Vec<Camera> =
            views.iter().map(|&view| Camera::framing(source.desc(), view)).collect();
        cameras.push(Camera::framing_around(source.desc(), 0.0, 25.0));
        for camera in &cameras {
            for size in [UVec2::new(19, 13), UVec2::new(90, 70), UVec2::new(200, 160)] {
                for settings in settings() {
                    let rows = frame(&source, &tf, camera, size, settings);
                    let gathered = frame(&ShortOfMemory(&source), &tf, camera, size, settings);
                    let what = format!("{stored_type}, {edge}, {size}, {settings:?}, {camera:?}");
                    assert!(gathered.rendered > 0, "{what}: nothing is drawn");
                    assert!(rows.frame == gathered.frame, "{what}: the pictures differ");
                    if settings.mode == Mode::Dvr {
                        assert_eq!(rows.samples, gathered.samples, "{what}");
                    }
                }
            }
        }
    }
}
