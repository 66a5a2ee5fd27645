use glam::{UVec3, Vec3};
use glassbrick_volume::{BrickGrid, BrickLayout, VOLUME_MARGIN_VOXELS};
use proptest::prelude::*;
use proptest::sample::select;

use super::any::{View, view};
use super::cases;

/// The bricks whose boxes hold a sample.
fn owners(grid: &BrickGrid, sample: Vec3) -> Vec<UVec3> {
    let holds = |&brick: &UVec3| {
        let [low, high] = grid.owned_box(brick);
        sample.cmpge(low).all() && sample.cmplt(high).all()
    };
    (0..grid.len()).map(|index| grid.brick(index)).filter(holds).collect()
}

/// The owner by the definition, worked out in `f64` one axis after the other.
fn owner_by_hand(grid: &BrickGrid, sample: Vec3) -> Option<UVec3> {
    let core = f64::from(grid.layout.core());
    let mut owner = UVec3::ZERO;
    for axis in 0..3 {
        let (q, n) = (f64::from(sample[axis]), f64::from(grid.extent[axis]));
        if !(q >= -0.5 - VOLUME_MARGIN_VOXELS && q < n - 0.5 + VOLUME_MARGIN_VOXELS) {
            return None;
        }
        let cell = (q.clamp(-0.5, n - 0.75) + 0.5) / core;
        owner[axis] = cell.floor() as u32;
    }
    Some(owner)
}

/// A coordinate on a seam or an end of the volume, off it by a few of the smallest steps, or anywhere.
#[derive(Clone, Debug)]
enum Coordinate {
    Seam { seam: u32, ulps: i32 },
    End { far: bool, margins: f32, ulps: i32 },
    Anywhere(f32),
}

fn coordinate() -> impl Strategy<Value = Coordinate> {
    let margins = select(vec![0.0, 0.5, 1.0, -1.0]);
    prop_oneof![
        (0..12u32, -2..=2).prop_map(|(seam, ulps)| Coordinate::Seam { seam, ulps }),
        (any::<bool>(), margins, -2..=2).prop_map(|(far, margins, ulps)| Coordinate::End {
            far,
            margins,
            ulps
        }),
        (-0.2..1.2f32).prop_map(Coordinate::Anywhere),
        select(vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30]).prop_map(Coordinate::Anywhere),
    ]
}

impl Coordinate {
    fn place(&self, n: u32, core: u32) -> f32 {
        let margin = VOLUME_MARGIN_VOXELS as f32;
        let (mut at, ulps) = match *self {
            Self::Seam { seam, ulps } => ((core * (seam % (n / core + 1))) as f32 - 0.5, ulps),
            Self::End { far: false, margins, ulps } => (-0.5 - margins * margin, ulps),
            Self::End { far: true, margins, ulps } => (n as f32 - 0.5 + margins * margin, ulps),
            Self::Anywhere(fraction) => (fraction * n as f32, 0),
        };
        for _ in 0..ulps.abs() {
            at = if ulps > 0 { at.next_up() } else { at.next_down() };
        }
        at
    }
}

/// Every stored layout from bricks of a few voxels to the largest, most of them with 60 voxels of core.
fn layouts() -> impl Strategy<Value = BrickLayout> {
    prop_oneof![
        Just(BrickLayout::default()),
        (2..130u32, 2..=4u32).prop_map(|(core, halo)| BrickLayout { edge: core + 2 * halo, halo }),
    ]
}

proptest! {
    #![proptest_config(cases(10_000))]

    #[test]
    fn each_sample_belongs_to_exactly_one_brick(
        extent in [1..300u32, 1..300u32, 1..300u32],
        layout in layouts(),
        at in [coordinate(), coordinate(), coordinate()],
    ) {
        let grid = layout.grid(UVec3::from_array(extent));
        // Three short rows of bricks stand for the whole grid, since an owner is found axis by axis.
        let sample = Vec3::from_array(std::array::from_fn(|axis| at[axis].place(extent[axis], layout.core())));
        let by_hand = owner_by_hand(&grid, sample);
        prop_assert_eq!(grid.owner(sample), by_hand, "{:?}", sample);
        for axis in 0..3 {
            let mut row = extent;
            (0..3).filter(|&other| other != axis).for_each(|other| row[other] = 1);
            let grid = layout.grid(UVec3::from_array(row));
            let mut in_row = Vec3::ZERO;
            in_row[axis] = sample[axis];
            let found: Vec<u32> = owners(&grid, in_row).iter().map(|brick| brick[axis]).collect();
            let expected: Vec<u32> = owner_by_hand(&grid, in_row).iter().map(|brick| brick[axis]).collect();
            prop_assert_eq!(found, expected, "axis {} of {:?}", axis, sample);
        }
    }
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn each_sample_of_a_ray_belongs_to_one_brick_and_none_lies_before_or_behind_the_ray(view in view(32)) {
        let (grid, rays) = (view.grid(), view.rays());
        for (column, row) in corners_and_middle(&view) {
            let ray = rays.ray(column, row);
            for number in 0..rays.sample_count {
                let sample = ray.sample(number);
                let owner = grid.owner(sample);
                prop_assert_eq!(owners(&grid, sample), owner.into_iter().collect::<Vec<_>>());
                prop_assert_eq!(owner, owner_by_hand(&grid, sample));
            }
            // A sample plane may touch the volume's end; rounding must not have put more than its very end inside.
            for number in rays.sample_count..rays.sample_count + 4 {
                let sample = ray.sample(number);
                let deep = owner_by_hand(&grid, sample + 1e-4).and(owner_by_hand(&grid, sample - 1e-4));
                prop_assert_eq!(deep, None, "sample {} of {}", number, rays.sample_count);
            }
            if rays.first_sample > 0 {
                let before = ray.start - ray.step;
                let deep = owner_by_hand(&grid, before + 1e-4).and(owner_by_hand(&grid, before - 1e-4));
                prop_assert_eq!(deep, None, "the sample before the first");
            }
        }
    }
}

fn corners_and_middle(view: &View) -> [(u32, u32); 5] {
    let (right, bottom) = (view.size.x - 1, view.size.y - 1);
    [(0, 0), (right, 0), (0, bottom), (right, bottom), (right / 2, bottom / 2)]
}
