use glassbrick_volume::{
    Band, BrickSource, NearlyEmpty, Rescale, VCT_BINS, VisibleBricks, VoxelCountTable, without_nearly_empty,
};
use proptest::prelude::*;

use super::cases;
use super::stored::{Stored, stored};

/// A brick's core voxels, and the table that its source makes of them.
struct Counted {
    voxels: Vec<f64>,
    min: f64,
    max: f64,
    whole_numbers: bool,
    table: VoxelCountTable,
}

fn counted(volume: &Stored) -> Vec<Counted> {
    let source = volume.source();
    let grid = source.grid(0);
    let tables = source.voxel_count_tables(0).expect("the array is at hand");
    assert_eq!(tables.len(), grid.len());
    let brick = |(index, table): (usize, &VoxelCountTable)| {
        let (low, high) = (grid.core_start(grid.brick(index)), grid.core_end(grid.brick(index)));
        let voxels: Vec<f64> = volume.voxels_in(low, high).map(f64::from).collect();
        Counted {
            min: voxels.iter().copied().fold(f64::INFINITY, f64::min),
            max: voxels.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            whole_numbers: volume.desc.stored_type.is_integer(),
            voxels,
            table: table.clone(),
        }
    };
    tables.iter().enumerate().map(brick).collect()
}

impl Counted {
    /// The bins in which a voxel may be counted: two for a real number that is an edge but for rounding.
    fn bins(&self, voxel: f64) -> [usize; 2] {
        let (above, width) = (voxel - self.min, self.max - self.min);
        if self.whole_numbers {
            let values = (width as u64 + 1).max(VCT_BINS as u64);
            let bin = (above as u64 * VCT_BINS as u64 / values) as usize;
            return [bin, bin];
        }
        let at = if width > 0.0 { above * VCT_BINS as f64 / width } else { 0.0 };
        [at - 1e-9, at + 1e-9].map(|at| (at.max(0.0) as usize).min(VCT_BINS - 1))
    }

    fn fraction(&self, counts: impl Fn(f64) -> bool) -> f64 {
        self.voxels.iter().filter(|&&voxel| counts(voxel)).count() as f64 / self.voxels.len() as f64
    }

    fn bin_width(&self) -> f64 {
        let values = self.max - self.min + if self.whole_numbers { 1.0 } else { 0.0 };
        let width = values / VCT_BINS as f64 * (1.0 + 1e-9);
        if self.whole_numbers { if self.max - self.min <= 255.0 { 0.0 } else { width } } else { width }
    }
}

/// Bands with ends on voxels, between them, beyond them, and nowhere.
fn bands() -> impl Strategy<Value = Vec<(Option<i16>, Option<i16>)>> {
    prop::collection::vec((prop::option::of(-64..320i16), prop::option::of(-64..320i16)), 1..4)
}

/// Disjoint bands in ascending order, made of ends in 256ths of a brick's range of values.
fn bands_over(ends: &[(Option<i16>, Option<i16>)], counted: &Counted, rescale: Rescale) -> Vec<Band> {
    let stored = |end: i16| {
        let at = counted.min + (counted.max - counted.min).max(1.0) * f64::from(end) / 256.0;
        if counted.whole_numbers && end % 2 == 0 { at.round() } else { at }
    };
    let mut values: Vec<f64> = Vec::new();
    for &(low, high) in ends {
        values.extend([low, high].into_iter().flatten().map(|end| rescale.value(stored(end))));
    }
    values.sort_by(f64::total_cmp);
    values.dedup();
    if ends[0].0.is_none() {
        values.insert(0, f64::NEG_INFINITY);
    }
    if values.len() % 2 == 1 {
        values.push(f64::INFINITY);
    }
    values.chunks_exact(2).map(|pair| Band { low: pair[0], high: pair[1] }).collect()
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn tables_hold_what_is_counted_by_hand(volume in stored(24)) {
        for counted in counted(&volume) {
            prop_assert_eq!(counted.table.voxels() as usize, counted.voxels.len());
            prop_assert!(counted.table.cumulative.is_sorted());
            for bin in 0..VCT_BINS {
                let [fewest, most] =
                    [1, 0].map(|end| counted.voxels.iter().filter(|&&v| counted.bins(v)[end] <= bin).count());
                let count = counted.table.cumulative[bin] as usize;
                prop_assert!((fewest..=most).contains(&count), "bin {}: {} not in {}..={}", bin, count, fewest, most);
            }
        }
    }

    #[test]
    fn fractions_are_those_counted_by_hand(volume in stored(16), ends in bands()) {
        let rescale = volume.desc.rescale;
        for counted in counted(&volume) {
            let width = counted.bin_width() * rescale.slope.abs();
            for band in bands_over(&ends, &counted, rescale) {
                let fractions = counted.table.fractions(&band, rescale);
                let value = |stored: f64| rescale.value(stored);
                // What a bin that is cut adds lies within a bin's width of the band's ends.
                let r1 = [0.0, width].map(|more| counted.fraction(|voxel| value(voxel) < band.high + more));
                let r2 = [width, 0.0].map(|less| counted.fraction(|voxel| value(voxel) <= band.low - less));
                let within = |x: f64, [low, high]: [f64; 2]| (low - 1e-12..=high + 1e-12).contains(&x);
                prop_assert!(within(fractions.r1, r1), "{:?}: R1 {} not in {:?}", band, fractions.r1, r1);
                prop_assert!(within(fractions.r2, r2), "{:?}: R2 {} not in {:?}", band, fractions.r2, r2);
                let inside = counted.fraction(|voxel| value(voxel) > band.low && value(voxel) < band.high);
                prop_assert!(fractions.visible() >= inside - 1e-12);
                if width == 0.0 {
                    prop_assert!((fractions.visible() - inside).abs() < 1e-12);
                }
                let all_above = counted.voxels.iter().all(|&voxel| value(voxel) >= band.high + width);
                let all_below = counted.voxels.iter().all(|&voxel| value(voxel) <= band.low - width);
                prop_assert!(!all_above || fractions.r1 == 0.0, "all is above, R1 {}", fractions.r1);
                prop_assert!(!all_below || fractions.r2 == 1.0, "all is below, R2 {}", fractions.r2);
            }
        }
    }

    #[test]
    fn alpha_and_beta_keep_what_one_band_keeps(
        volume in stored(16), ends in bands(), alpha in prop_oneof![Just(0.0), 0.0..1.0],
        beta in prop_oneof![Just(1.0), 0.0..1.0],
    ) {
        let rescale = volume.desc.rescale;
        for counted in counted(&volume) {
            let bands = bands_over(&ends, &counted, rescale);
            let visible = VisibleBricks { bricks: vec![0], ..VisibleBricks::default() };
            let tables = std::slice::from_ref(&counted.table);
            let left =
                without_nearly_empty(visible, tables, &bands, rescale, NearlyEmpty { alpha, beta });
            let is_kept = bands.iter().any(|band| {
                let fractions = counted.table.fractions(band, rescale);
                (alpha == 0.0 || fractions.r1 > alpha) && (beta == 1.0 || fractions.r2 < beta)
            });
            prop_assert_eq!(left.bricks.len(), usize::from(is_kept));
            prop_assert_eq!(left.nearly_empty, usize::from(!is_kept));
        }
    }
}
