use crate::{Band, Rescale};

/// Bins of a voxel-count table.
pub const VCT_BINS: usize = 256;

/// The stored values of a brick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BrickRange {
    /// Smallest and largest over the core and one voxel around it: what trilinear interpolation can reach.
    pub reach: [f32; 2],
    /// Smallest and largest over the core alone: what the voxel-count table spans.
    pub core: [f32; 2],
}

impl BrickRange {
    /// The range of no voxels, which any voxel widens.
    pub const NOTHING: Self =
        Self { reach: [f32::INFINITY, f32::NEG_INFINITY], core: [f32::INFINITY, f32::NEG_INFINITY] };

    /// Smallest and largest value that a sample in the brick can have.
    pub fn value_range(&self, rescale: Rescale) -> [f64; 2] {
        let [a, b] = self.reach.map(|stored| rescale.value(f64::from(stored)));
        [a.min(b), a.max(b)]
    }
}

/// A brick's voxel-count table (VCT): the cumulative histogram of its core voxels, in 256 equal bins over the
/// core's own [min, max], in stored values.
///
/// Of whole numbers, a bin holds whole numbers: one each where max − min ≤ 255, so that the table is exact then.
/// From Xie, Yang and Zhu 2007.
#[derive(Clone, Debug, PartialEq)]
pub struct VoxelCountTable {
    /// `cumulative[b]` = voxels in bins 0 to b.
    pub cumulative: [u32; VCT_BINS],
    pub bins: Bins,
}

/// Equal bins over [min, max].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bins {
    pub min: f64,
    pub max: f64,
    pub whole_numbers: bool,
}

impl Bins {
    /// Width of a bin.
    fn width(&self) -> f64 {
        if self.whole_numbers {
            ((self.max - self.min + 1.0) / VCT_BINS as f64).max(1.0)
        } else {
            (self.max - self.min) / VCT_BINS as f64
        }
    }

    /// The bin of a stored value within [min, max].
    pub fn bin(&self, stored: f64) -> usize {
        let width = self.width();
        if width > 0.0 { (((stored - self.min) / width) as usize).min(VCT_BINS - 1) } else { 0 }
    }
}

/// How a band cuts a brick's voxels: fractions of all its core voxels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandFractions {
    /// R1 = VCT\[OTF_MAX\] / VCT\[VCT_MAX\]: voxels not above the band. 0: all voxels are above it.
    pub r1: f64,
    /// R2 = VCT\[OTF_MIN\] / VCT\[VCT_MAX\]: voxels below the band. 1: all voxels are below it.
    pub r2: f64,
}

impl BandFractions {
    /// The fraction of the voxels that the band shows.
    pub fn visible(&self) -> f64 {
        (self.r1 - self.r2).max(0.0)
    }
}

impl VoxelCountTable {
    /// Counts core voxels, given as stored values, in bins over their own range.
    pub fn count(core: impl Iterator<Item = f64>, bins: Bins) -> Self {
        let mut cumulative = [0u32; VCT_BINS];
        for stored in core {
            cumulative[bins.bin(stored)] += 1;
        }
        Self::from_counts(cumulative, bins)
    }

    /// The table of voxels that were counted bin by bin.
    pub fn from_counts(mut counts: [u32; VCT_BINS], bins: Bins) -> Self {
        let mut sum = 0;
        for count in &mut counts {
            sum += *count;
            *count = sum;
        }
        Self { cumulative: counts, bins }
    }

    /// Number of core voxels.
    pub fn voxels(&self) -> u32 {
        self.cumulative[VCT_BINS - 1]
    }

    /// R1 and R2 for a band of values; a bin that the band's end cuts counts whole.
    pub fn fractions(&self, band: &Band, rescale: Rescale) -> BandFractions {
        let [low, high] = if rescale.slope < 0.0 { [band.high, band.low] } else { [band.low, band.high] }
            .map(|value| rescale.stored(value));
        let Bins { min, max, whole_numbers } = self.bins;
        let width = self.bins.width();
        let edge = |bin: usize| min + bin as f64 * width;
        let bins_to = |stored: f64| (stored - min) / width;
        let [before_high, up_to_low] = if whole_numbers {
            // Of whole numbers a bin holds those from its start, rounded up, to its end, rounded up, less one.
            let (last_before_high, first_above_low) = (high.ceil() - 1.0, low.floor() + 1.0);
            [
                self.voxels_up_to(bins_to(last_before_high) + 1.0, |bin| edge(bin) <= last_before_high),
                self.voxels_up_to(bins_to(first_above_low), |bin| edge(bin + 1) <= first_above_low),
            ]
        } else {
            [
                self.voxels_up_to(bins_to(high).ceil(), |bin| edge(bin) < high),
                self.voxels_up_to(bins_to(low), |bin| edge(bin + 1).min(max) <= low),
            ]
        };
        let all = self.voxels();
        // Under a negative slope, what is stored after the band is below it.
        let [not_above, below] =
            if rescale.slope < 0.0 { [all - up_to_low, all - before_high] } else { [before_high, up_to_low] };
        let fraction = |voxels: u32| f64::from(voxels) / f64::from(all.max(1));
        BandFractions { r1: fraction(not_above), r2: fraction(below) }
    }

    /// Voxels up to the last bin for which `is_before` is true: it is for all bins before one for which it is. They are about
    /// so many bins; the estimate, which rounding makes wrong by one at most, is put right.
    fn voxels_up_to(&self, estimate: f64, is_before: impl Fn(usize) -> bool) -> u32 {
        let mut bins = (estimate as usize).min(VCT_BINS);
        while bins < VCT_BINS && is_before(bins) {
            bins += 1;
        }
        while bins > 0 && !is_before(bins - 1) {
            bins -= 1;
        }
        if bins == 0 { 0 } else { self.cumulative[bins - 1] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(values: &[u8]) -> VoxelCountTable {
        let floats = || values.iter().map(|&v| f64::from(v));
        let bins = Bins {
            min: floats().fold(f64::INFINITY, f64::min),
            max: floats().fold(f64::NEG_INFINITY, f64::max),
            whole_numbers: true,
        };
        VoxelCountTable::count(floats(), bins)
    }

    #[test]
    fn small_whole_numbers_are_counted_exactly() {
        let table = bytes(&[3, 3, 7, 200, 255]);
        let fractions = table.fractions(&Band { low: 3.0, high: 200.0 }, Rescale::IDENTITY);
        assert_eq!(fractions, BandFractions { r1: 0.6, r2: 0.4 });
        assert!((fractions.visible() - 0.2).abs() < 1e-12);
    }

    #[test]
    fn r1_is_zero_when_all_is_above_and_r2_is_one_when_all_is_below() {
        let table = bytes(&[10, 11, 12]);
        assert_eq!(table.fractions(&Band { low: 0.0, high: 10.0 }, Rescale::IDENTITY).r1, 0.0);
        assert_eq!(table.fractions(&Band { low: 12.0, high: 90.0 }, Rescale::IDENTITY).r2, 1.0);
    }

    #[test]
    fn a_bin_that_is_cut_counts_whole() {
        let bins = Bins { min: 0.0, max: 2559.0, whole_numbers: true };
        let table = VoxelCountTable::count((0..2560).map(f64::from), bins);
        let fractions = table.fractions(&Band { low: 5.0, high: 15.0 }, Rescale::IDENTITY);
        assert_eq!(fractions, BandFractions { r1: 20.0 / 2560.0, r2: 0.0 });
    }

    #[test]
    fn a_negative_slope_turns_the_band_round() {
        let table = bytes(&[0, 1, 2, 3]);
        let negative = Rescale { slope: -1.0, intercept: 0.0 };
        let fractions = table.fractions(&Band { low: -2.5, high: 0.0 }, negative);
        assert_eq!(fractions, BandFractions { r1: 0.75, r2: 0.25 }, "-3 is below, 0 is not in the open band");
    }

    #[test]
    fn one_value_falls_into_one_bin() {
        let bins = Bins { min: 4.5, max: 4.5, whole_numbers: false };
        let table = VoxelCountTable::count([4.5; 8].into_iter(), bins);
        assert_eq!(table.voxels(), 8);
        assert_eq!(table.fractions(&Band { low: 4.0, high: 5.0 }, Rescale::IDENTITY).visible(), 1.0);
    }
}
