//! Benchmarks of parts: `cargo bench -p glassbrick-benches`.
//!
//! Samples are measured by drawing one resident brick on one thread: `mean` is trilinear sampling, `dvr` adds the look-up of
//! extinction and colour, `phong` the gradient. Throughput is in samples, voxels or bricks.

mod volumes;

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::{UVec2, UVec3};
use glassbrick_brick_store::Codec;
use glassbrick_cpu::InstructionSet;
use glassbrick_volume::{
    Bins, BrickLayout, BrickSource, FramePlan, FrameRays, Mode, NearlyEmpty, Phong, RenderSettings, Rescale,
    Skip, StoredType, VCT_BINS, VolumeDesc, VoxelCountTable, filtered_visible, without_nearly_empty,
};
use volumes::{OneBrick, camera, opaque_above, ranges, source};

/// Bricks of the lists: a volume of about 22 billion voxels.
const MANY_BRICKS: usize = 100_000;

fn one_thread<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread can be started");
    pool.install(work)
}

/// Nothing stops early, so that samples are the same for all.
fn settings(mode: Mode, shading: Option<Phong>) -> RenderSettings {
    RenderSettings { mode, shading, opacity_cutoff: 1.0, skip: Skip::Empty }
}

fn samples(criterion: &mut Criterion) {
    let kinds = [
        ("mean", settings(Mode::Mean, None)),
        ("mip", settings(Mode::Mip, None)),
        ("dvr", settings(Mode::Dvr, None)),
        ("phong", settings(Mode::Dvr, Some(Phong::default()))),
    ];
    for (name, settings) in kinds {
        let mut group = criterion.benchmark_group(format!("samples/{name}"));
        for azimuth_deg in [0.0, 30.0] {
            let brick = OneBrick::new(azimuth_deg, 0.02);
            for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
                let count = one_thread(|| brick.draw(settings, set));
                group.throughput(Throughput::Elements(count));
                group.bench_function(BenchmarkId::new(set.name(), format!("{azimuth_deg}°")), |bencher| {
                    one_thread(|| bencher.iter(|| black_box(brick.draw(settings, set))));
                });
            }
        }
        group.finish();
    }
}

fn tables(criterion: &mut Criterion) {
    let extent = UVec3::splat(180);
    let voxels = volumes::voxels(extent);
    let mut group = criterion.benchmark_group("scan");
    group.throughput(Throughput::Elements(u64::from(extent.element_product())));
    group.bench_function("ranges, voxels copied", |bencher| {
        let desc = VolumeDesc::new(extent, StoredType::U16);
        bencher.iter(|| {
            glassbrick_brick_store::FlatSource::from_array(
                desc.clone(),
                voxels.clone(),
                BrickLayout::default(),
            )
            .expect("the array fits its extent")
        });
    });
    group.bench_function("voxel-count tables, ranges included", |bencher| {
        bencher.iter(|| source_of(&voxels, extent).voxel_count_tables(0).expect("an array is read"));
    });
    group.finish();
    let mut group = criterion.benchmark_group("brick");
    group.throughput(Throughput::Elements(1));
    let source = source(extent);
    group.bench_function("cut", |bencher| bencher.iter(|| source.brick(id()).expect("an array is read")));
    group.bench_function("cut, and its cells", |bencher| {
        bencher.iter(|| {
            let brick = source.brick(id()).expect("an array is read");
            black_box(brick.cells());
            brick
        });
    });
    group.finish();
}

fn source_of(voxels: &[u8], extent: UVec3) -> glassbrick_brick_store::FlatSource {
    let desc = VolumeDesc::new(extent, StoredType::U16);
    glassbrick_brick_store::FlatSource::from_array(desc, voxels.to_vec(), BrickLayout::default())
        .expect("the array fits its extent")
}

fn id() -> glassbrick_volume::BrickId {
    glassbrick_volume::BrickId { level: 0, x: 1, y: 1, z: 1 }
}

/// What a brick of a store costs to write and to read, beside the disk.
fn codecs(criterion: &mut Criterion) {
    let brick = volumes::voxels(UVec3::splat(BrickLayout::default().edge));
    let mut group = criterion.benchmark_group("codec");
    group.throughput(Throughput::Bytes(brick.len() as u64));
    for codec in Codec::ALL {
        let mut encoded = Vec::new();
        group.bench_function(BenchmarkId::new("encode", codec.name()), |bencher| {
            bencher.iter(|| {
                encoded.clear();
                codec.encode(2, black_box(&brick), &mut encoded);
            });
        });
        let mut decoded = vec![0; brick.len()];
        group.bench_function(BenchmarkId::new("decode", codec.name()), |bencher| {
            bencher.iter(|| codec.decode(black_box(&encoded), &mut decoded).expect("it was encoded"));
        });
    }
    group.finish();
}

/// What a change of the transfer function costs, and what a change of the camera costs.
fn lists(criterion: &mut Criterion) {
    let ranges = ranges(MANY_BRICKS);
    let bands = opaque_above(1200.0).bake(1.0).bands();
    let mut group = criterion.benchmark_group("100,000 bricks");
    group.throughput(Throughput::Elements(MANY_BRICKS as u64));
    group.bench_function("bake a transfer function", |bencher| {
        bencher.iter(|| opaque_above(black_box(1200.0)).bake(1.0));
    });
    group.bench_function("visible list", |bencher| {
        bencher.iter(|| filtered_visible(black_box(&ranges), &bands, Rescale::IDENTITY));
    });
    let tables: Vec<VoxelCountTable> = ranges
        .iter()
        .map(|range| VoxelCountTable {
            cumulative: std::array::from_fn(|bin| (bin as u32 + 1) * 216_000 / VCT_BINS as u32),
            bins: Bins { min: range.core[0].into(), max: range.core[1].into(), whole_numbers: true },
        })
        .collect();
    let nearly_empty = NearlyEmpty { alpha: 0.01, beta: 0.99 };
    group.bench_function("visible list by alpha and beta", |bencher| {
        bencher.iter(|| {
            let visible = filtered_visible(&ranges, &bands, Rescale::IDENTITY);
            without_nearly_empty(visible, &tables, &bands, Rescale::IDENTITY, nearly_empty)
        });
    });
    let desc = VolumeDesc::new(UVec3::new(3000, 3000, 2400), StoredType::U16);
    let grid = BrickLayout::default().grid(desc.extent);
    let visible = filtered_visible(&ranges, &bands, Rescale::IDENTITY);
    let camera = camera(&desc);
    group.bench_function("frame plan", |bencher| {
        bencher.iter(|| {
            let rays =
                FrameRays::new(&desc.level(0), &camera, UVec2::splat(512), 1.0).expect("a sound camera");
            FramePlan::new(0, &grid, &rays, &visible.bricks)
        });
    });
    group.finish();
}

criterion_group! {
    name = micro;
    config = Criterion::default().sample_size(20).warm_up_time(Duration::from_millis(500)).measurement_time(Duration::from_secs(2));
    targets = samples, tables, codecs, lists
}
criterion_main!(micro);
