use glam::{IVec3, UVec3, Vec3};
use glassbrick::{InstructionSet, OpenSettings, RenderRequest, Skip, Volume};
use glassbrick_tests::tolerance::{SAME_KERNEL, compare};
use glassbrick_volume::{
    BakedTransferFunction, BrickGrid, BrickLayout, BrickSource, Camera, ControlPoint, NamedView, Rescale,
    StoredType, TransferFunction, VolumeDesc, filtered_visible,
};
use proptest::prelude::*;
use proptest::sample::select;

use super::any::{extent, layout};
use super::cases;
use super::stored::{Stored, hash, voxel_at};
use super::transfer_functions::{extinction_by_hand, shows_any_of, transfer_function};

const BOTH: [StoredType; 2] = [StoredType::I16, StoredType::F32];

/// A volume whose voxels lie on the very values at which bands begin and end, and between and beyond them.
#[derive(Clone, Debug)]
struct OnEdges {
    function: TransferFunction,
    baked: BakedTransferFunction,
    volume: Stored,
}

fn on_edges(
    function: impl Strategy<Value = TransferFunction>,
    stored_types: &[StoredType],
) -> impl Strategy<Value = OnEdges> {
    let rescale = select(vec![(1.0, 0.0), (-1.0, 0.0), (0.5, -3.0), (-2.0, 7.0)]);
    let stored_type = select(stored_types.to_vec());
    (function, rescale, stored_type, extent(12), layout(), 1..6u32, any::<u64>()).prop_map(
        |(function, (slope, intercept), stored_type, extent, layout, plateau, seed)| {
            let float = stored_type == StoredType::F32;
            let rescale = Rescale { slope, intercept };
            let desc = VolumeDesc { rescale, ..VolumeDesc::new(extent, stored_type) };
            let baked = function.bake(desc.smallest_spacing_mm());
            let values = telling_values(&function, &baked);
            let voxel = |index: usize| {
                let UVec3 { x, y, z } = voxel_at(index, extent) / plateau;
                let number = hash(seed, u64::from(x + 32 * (y + 32 * z))) as usize % (values.len() + 2);
                // Some values are likelier, so that whole bricks are of one.
                let value = values[number.min(values.len() - 1)];
                rescale.stored(value)
            };
            let voxels = (0..desc.voxels() as usize).map(voxel);
            let kept: Vec<f32> = voxels.map(|v| if float { v as f32 } else { v.round() as f32 }).collect();
            let bytes = if float {
                kept.iter().flat_map(|voxel| voxel.to_ne_bytes()).collect()
            } else {
                kept.iter().flat_map(|&voxel| (voxel as i16).to_ne_bytes()).collect()
            };
            OnEdges { function, baked, volume: Stored::of(desc, layout, bytes, kept) }
        },
    )
}

/// Any transfer function over whole numbers. Of some widths, entries of the baked function fall on whole numbers.
fn any_function() -> impl Strategy<Value = TransferFunction> {
    let width = select(vec![3, 31, 93, 100, 121, 255, 341, 1023]);
    (-500..500, width).prop_flat_map(|(low, width)| transfer_function(low, low + width))
}

/// Transfer functions whose entries on whole numbers are met exactly in `f32`.
fn plain_function() -> impl Strategy<Value = TransferFunction> {
    let width = select(vec![3, 11, 31, 33, 93, 341, 1000, 1023, 3000, 4095]);
    let with_ends = (-500..500, width, 0.0..1.0, 0.0..1.0);
    with_ends.prop_flat_map(|(low, width, first, last)| {
        transfer_function(low, low + width).prop_map(move |mut function| {
            let end = |value: i32, opacity: f64| ControlPoint {
                value: f64::from(value),
                opacity: (opacity - 0.5f64).max(0.0),
                ..function.points[0]
            };
            let (first, last) = (end(low, first), end(low + width, last));
            function.points.insert(0, first);
            function.points.push(last);
            function
        })
    })
}

/// Every band's ends and middle, every point, and values outside.
fn telling_values(function: &TransferFunction, baked: &BakedTransferFunction) -> Vec<f64> {
    let ends = baked.bands().into_iter().flat_map(|band| [band.low, band.high, (band.low + band.high) / 2.0]);
    let points = function.points.iter().map(|point| point.value);
    let outside = [baked.first_value - 5.0, baked.last_value + 5.0];
    let mut values: Vec<f64> = ends.chain(points).chain(outside).filter(|value| value.is_finite()).collect();
    values.sort_by(f64::total_cmp);
    values.dedup();
    values
}

/// Smallest and largest value over a brick's core and one voxel around it.
fn reach_by_hand(volume: &Stored, grid: &BrickGrid, brick: UVec3) -> [f64; 2] {
    let low = grid.core_start(brick).saturating_sub(UVec3::ONE);
    let high = (grid.core_end(brick) + 1).min(grid.extent);
    let values = volume.voxels_in(low, high).map(|voxel| volume.desc.rescale.value(f64::from(voxel)));
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], value| [min.min(value), max.max(value)])
}

/// The value at a sample, interpolated along x, y and z, and never outside the eight voxels around it.
fn value_by_hand(volume: &Stored, sample: Vec3) -> f64 {
    let cell = sample.floor();
    let t = (sample - cell).as_dvec3();
    let corner = |x, y, z| f64::from(volume.at(cell.as_ivec3() + IVec3::new(x, y, z)));
    let between = |a: f64, b: f64, t: f64| (a + t * (b - a)).clamp(a.min(b), a.max(b));
    let row = |y, z| between(corner(0, y, z), corner(1, y, z), t.x);
    let plane = |z| between(row(0, z), row(1, z), t.y);
    volume.desc.rescale.value(between(plane(0), plane(1), t.z))
}

proptest! {
    #![proptest_config(cases(2000))]

    #[test]
    fn a_brick_is_empty_exactly_when_nothing_in_its_reach_is_shown(OnEdges { baked, volume, .. } in on_edges(any_function(), &BOTH)) {
        let source = volume.source();
        let grid = source.grid(0);
        let visible = filtered_visible(source.ranges(0), &baked.bands(), volume.desc.rescale);
        prop_assert_eq!(visible.bricks.len() + visible.empty, grid.len());
        for index in 0..grid.len() {
            let reach = reach_by_hand(&volume, &grid, grid.brick(index));
            let is_kept = visible.bricks.contains(&(index as u32));
            prop_assert_eq!(is_kept, shows_any_of(&baked, reach), "values {:?} in {:?}", reach, baked.bands());
        }
    }

    #[test]
    fn no_brick_with_a_sample_to_show_is_dropped(OnEdges { baked, volume, .. } in on_edges(any_function(), &BOTH), seed in any::<u64>()) {
        let source = volume.source();
        let grid = source.grid(0);
        let visible = filtered_visible(source.ranges(0), &baked.bands(), volume.desc.rescale);
        for index in (0..grid.len()).filter(|&index| !visible.bricks.contains(&(index as u32))) {
            let [low, high] = grid.owned_box(grid.brick(index));
            for number in 0..32u64 {
                let part = |axis| hash(seed, 3 * number + axis) as f32 / u64::MAX as f32;
                let sample = low + (high - low) * Vec3::new(part(0), part(1), part(2));
                let value = value_by_hand(&volume, sample);
                prop_assert_eq!(extinction_by_hand(&baked, value), 0.0, "{} at {:?}", value, sample);
            }
        }
    }
}

proptest! {
    #![proptest_config(cases(800))]

    #[test]
    fn what_is_skipped_is_not_missed(OnEdges { function, volume, .. } in on_edges(plain_function(), &[StoredType::I16]), azimuth_deg in 0.0..360.0) {
        let layout = BrickLayout { edge: 8, halo: 2 };
        let settings = OpenSettings { layout, threads: Some(1), ..OpenSettings::default() };
        let opened = Volume::from_array(volume.desc.clone(), volume.bytes.clone(), &settings).expect("sound");
        let turned = Camera::framing_around(&volume.desc, azimuth_deg, 25.0);
        for camera in [turned, Camera::framing(&volume.desc, NamedView::Top)] {
            let draw = |skip| {
                let mut request = RenderRequest { size: [14, 11], ..RenderRequest::new(function.clone()) };
                request.settings.skip = skip;
                request.settings.opacity_cutoff = 1.0;
                opened.render(request, &camera).expect("it can be drawn").frame
            };
            let exact: Vec<[f64; 4]> = draw(Skip::None).rgba.iter().map(|pixel| pixel.map(f64::from)).collect();
            for skip in [Skip::Empty, Skip::All] {
                let difference = compare(&draw(skip).rgba, &exact);
                prop_assert!(difference.is_within(SAME_KERNEL), "{:?}: {}", skip, difference);
            }
        }
    }
}

/// Entry 341 falls on 21 of 63: a voxel on the end of a band must not be taken for one just inside it, or a brick of
/// nothing else would show where nothing is skipped, and rightly be skipped as empty elsewhere.
#[test]
fn a_value_on_the_end_of_a_band_is_not_shown() {
    let point = |value, opacity| ControlPoint { value, color: [1.0; 3], opacity };
    let points = vec![point(0.0, 1.0), point(20.9, 1.0), point(21.0, 0.0), point(63.0, 0.0)];
    let desc = VolumeDesc::new(UVec3::splat(64), StoredType::U8);
    let camera = Camera::framing(&desc, NamedView::Front);
    let volume = Volume::from_array(desc, vec![21; 64 * 64 * 64], &OpenSettings::default()).expect("sound");
    let mut request =
        RenderRequest { size: [8, 8], ..RenderRequest::new(TransferFunction { points, unit_mm: None }) };
    request.settings.skip = Skip::None;
    for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
        request.instruction_set = Some(set);
        let frame = volume.render(request.clone(), &camera).expect("it can be drawn").frame;
        let most = frame.rgba.iter().map(|pixel| pixel[3]).fold(0.0, f32::max);
        assert!(most == 0.0, "{most} is shown with {}", set.name());
    }
}
