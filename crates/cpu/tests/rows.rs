//! Pictures that are drawn along rows of voxels are, to the bit, those whose voxels are gathered.

use glam::{DVec3, UVec2, UVec3};
use glassbrick_brick_store::{CachedSource, FlatSource};
use glassbrick_cpu::{CpuFrame, CpuScene, InstructionSet, ShownCells, draw};
use glassbrick_volume::{
    BrickId, BrickLayout, BrickSource, Camera, ControlPoint, FramePlan, FrameRays, Mode, NamedView, Phong,
    Projection, RenderSettings, Skip, StoredType, TransferFunction, VolumeDesc, filtered_visible,
};

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

/// The same with memory for all its bricks, so that it is drawn along rows where rays go so.
fn in_memory(stored_type: StoredType, edge: u32) -> CachedSource {
    let source = volume(stored_type, edge);
    let brick_bytes = 4 * u64::from(edge).pow(3) * 2;
    let bricks = source.grid(0).len() as u64 + 1;
    CachedSource::new(Box::new(source), bricks * brick_bytes, 1)
        .expect("there is room for more than one brick")
}

/// A veil, and something opaque.
fn transfer_function(source: &dyn BrickSource) -> TransferFunction {
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
        // Without memory for all bricks of a frame, it is drawn layer by layer, by gathering.
        let (source, short_of_memory) = (in_memory(stored_type, edge), volume(stored_type, edge));
        assert!(source.can_hold(source.grid(0).len()) && !short_of_memory.can_hold(1));
        let tf = transfer_function(&source);
        // Bricks are turned only where some are at hand.
        let first = BrickId::new(0, UVec3::ZERO);
        source.brick(first).expect("an array can be read");
        assert!(source.is_kept(first));
        let views = [NamedView::Front, NamedView::Back, NamedView::Top, NamedView::Left, NamedView::Right];
        let mut cameras = views.map(|view| Camera::framing(source.desc(), view)).to_vec();
        let around = |azimuth, elevation| Camera::framing_around(source.desc(), azimuth, elevation);
        // Tilted and turned, and so with rows along each axis standing and lying in the picture.
        let (tilted, turned, both) = (around(0.0, 25.0), around(35.0, 0.0), around(90.0, 25.0));
        cameras.extend([tilted, turned, both]);
        cameras.extend([tilted, turned].map(|camera| Camera { up: DVec3::X, ..camera }));
        cameras.push(Camera { up: DVec3::Y, ..both });
        cameras.push(Camera { projection: Projection::Orthographic { height_mm: 120.0 }, ..turned });
        for camera in &cameras {
            for size in [UVec2::new(19, 13), UVec2::new(90, 70), UVec2::new(200, 160)] {
                for settings in settings() {
                    let rows = frame(&source, &tf, camera, size, settings);
                    let gathered = frame(&short_of_memory, &tf, camera, size, settings);
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
