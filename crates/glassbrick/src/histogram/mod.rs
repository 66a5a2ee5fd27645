mod bins;
mod samples;

use glassbrick_volume::{BrickSource, ReadError};

use bins::Bins;

/// How often values occur in a volume, estimated from a part of its voxels.
///
/// Bins are equal and lie over [`Histogram::span`]. Of whole numbers each bin holds equally many.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Smallest and largest value of the volume, exact.
    pub range: [f64; 2],
    /// Where the first bin begins and the last one ends. It covers the range but for strays: rare values far from all
    /// others, which count in the outermost bins, and absurd ones, which do not count.
    pub span: [f64; 2],
    /// Estimated voxels by bin.
    pub counts: Vec<f64>,
    /// Those of them that lie on the volume's faces: what surrounds the object, if anything does.
    pub face_counts: Vec<f64>,
    /// Those of them that have the very value of their next neighbour along x: nearly all of labels, few of measured
    /// values.
    pub repeated_counts: Vec<f64>,
}

impl Histogram {
    /// Counts voxels of bricks spread over the volume and over what bricks hold. Bricks of one value are not read.
    ///
    /// # Errors
    /// When a brick cannot be read.
    pub fn sample(source: &dyn BrickSource) -> Result<Self, ReadError> {
        let parts = samples::sample(source)?;
        let bins = Bins::new(source.desc(), stored_range(source), &parts);
        let mut counts = vec![0.0; bins.count];
        let mut face_counts = vec![0.0; bins.count];
        let mut repeated_counts = vec![0.0; bins.count];
        for part in &parts {
            for &[value, next] in &part.pairs {
                let Some(bin) = bins.bin(value) else { continue };
                counts[bin] += part.voxels_per_pair;
                repeated_counts[bin] += if next == value { part.voxels_per_pair } else { 0.0 };
            }
            for bin in part.faces.iter().filter_map(|&value| bins.bin(value)) {
                face_counts[bin] += part.voxels_per_face;
            }
        }
        Ok(Self { range: value_range(source), span: bins.span, counts, face_counts, repeated_counts })
    }

    /// The value in the middle of a bin.
    pub fn value(&self, bin: usize) -> f64 {
        let [start, end] = self.span;
        start + (end - start) * (bin as f64 + 0.5) / self.counts.len() as f64
    }

    /// Width of a bin.
    pub fn bin_width(&self) -> f64 {
        (self.span[1] - self.span[0]) / self.counts.len() as f64
    }

    /// The bin of a value; values outside the span are in the outermost ones.
    pub fn bin(&self, value: f64) -> usize {
        let bin = (value - self.span[0]) / self.bin_width();
        (bin.max(0.0) as usize).min(self.counts.len() - 1)
    }

    /// Estimated number of voxels.
    pub fn voxels(&self) -> f64 {
        self.counts.iter().sum()
    }

    /// The values between which nearly all voxels lie: without the 1 in 10,000 at each end.
    pub fn typical_range(&self) -> [f64; 2] {
        let bins = 0..self.counts.len();
        match (self.first_typical(bins.clone()), self.first_typical(bins.clone().rev())) {
            (Some(low), Some(high)) if low < high => {
                let [min, max] = self.range;
                // An end without outliers is the range's own, not the middle of its last bin.
                [
                    if self.span[0] <= min && low == bins.start { min } else { self.value(low) },
                    if self.span[1] >= max && high + 1 == bins.end { max } else { self.value(high) },
                ]
            }
            _ => self.range,
        }
    }

    /// The first of these bins that does not hold outliers alone.
    fn first_typical(&self, mut bins: impl Iterator<Item = usize>) -> Option<usize> {
        const OUTLIERS: f64 = 1e-4;
        let outliers = self.voxels() * OUTLIERS;
        let mut sum = 0.0;
        bins.find(|&bin| {
            sum += self.counts[bin];
            sum > outliers
        })
    }
}

/// Smallest and largest value of a volume.
pub fn value_range(source: &dyn BrickSource) -> [f64; 2] {
    let [a, b] = stored_range(source).map(|stored| source.desc().rescale.value(f64::from(stored)));
    [a.min(b), a.max(b)]
}

fn stored_range(source: &dyn BrickSource) -> [f32; 2] {
    source.ranges(0).iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[min, max], range| {
        [min.min(range.core[0]), max.max(range.core[1])]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::UVec3;
    use glassbrick_brick_store::FlatSource;
    use glassbrick_volume::{BrickLayout, Rescale, StoredType, VolumeDesc};

    fn histogram(desc: VolumeDesc, stored: Vec<u8>, edge: u32) -> Histogram {
        let layout = BrickLayout { edge, halo: 2 };
        let source = FlatSource::from_array(desc, stored, layout).expect("sound");
        Histogram::sample(&source).expect("an array is read")
    }

    #[test]
    fn a_volume_of_two_values_fills_two_bins() {
        let mut desc = VolumeDesc::new(UVec3::splat(40), StoredType::U8);
        desc.rescale = Rescale { slope: -2.0, intercept: 10.0 };
        let histogram = histogram(desc, (0..64_000).map(|i| if i < 16_000 { 0 } else { 100 }).collect(), 16);
        assert_eq!(histogram.range, [-190.0, 10.0]);
        assert!((histogram.voxels() - 64_000.0).abs() < 1.0);
        assert!((histogram.counts[0] - 48_000.0).abs() < 2_500.0, "{}", histogram.counts[0]);
        assert_eq!(histogram.counts.iter().filter(|&&count| count > 0.0).count(), 2);
        assert_eq!((histogram.value(0), histogram.bin(10.0)), (-190.0, histogram.counts.len() - 1));
    }

    #[test]
    fn whole_numbers_get_equal_bins() {
        let desc = VolumeDesc::new(UVec3::new(60, 60, 60), StoredType::U16);
        let stored = (0..216_000u32).flat_map(|i| ((i % 10_000) as u16).to_ne_bytes()).collect();
        let histogram = histogram(desc, stored, 64);
        assert_eq!(histogram.bin_width(), 3.0);
        let [most, least] = histogram.counts[..3333]
            .iter()
            .fold([0.0f64, f64::INFINITY], |[most, least], &count| [most.max(count), least.min(count)]);
        assert!(most < 3.0 * least, "{most} {least}");
    }

    #[test]
    fn strays_do_not_coarsen_the_bins() {
        let desc = VolumeDesc::new(UVec3::splat(50), StoredType::F32);
        let stored = (0..125_000).flat_map(|i| if i == 9 { 1e9f32 } else { (i % 100) as f32 }.to_ne_bytes());
        let histogram = histogram(desc, stored.collect(), 16);
        assert_eq!(histogram.range, [0.0, 1e9]);
        assert!(histogram.span[1] < 1_000.0, "{:?}", histogram.span);
        assert_eq!(histogram.counts.iter().filter(|&&count| count > 500.0).count(), 100);
    }

    #[test]
    fn what_cannot_be_meant_is_not_counted() {
        let desc = VolumeDesc::new(UVec3::splat(50), StoredType::F32);
        let value = |i: u32| if i.is_multiple_of(400) { 1e20 } else { (i % 100) as f32 };
        let histogram = histogram(desc, (0..125_000).flat_map(|i| value(i).to_ne_bytes()).collect(), 64);
        assert_eq!(histogram.range, [0.0, 1e20f32.into()]);
        assert!(histogram.span[1] < 2_000.0, "{:?}", histogram.span);
        assert_eq!(histogram.counts[histogram.counts.len() - 1], 0.0);
    }

    fn counted(counts: &[f64]) -> Histogram {
        let range = [0.0, counts.len() as f64];
        let none = vec![0.0; counts.len()];
        Histogram {
            range,
            span: range,
            counts: counts.to_vec(),
            face_counts: none.clone(),
            repeated_counts: none,
        }
    }

    #[test]
    fn a_few_outliers_do_not_count_as_typical() {
        let mut counts = vec![1000.0; 100];
        counts[60..].fill(0.0);
        counts[99] = 2.0;
        assert_eq!(counted(&counts).typical_range(), [0.0, 59.5]);
        counts[99] = 1000.0;
        assert_eq!(counted(&counts).typical_range(), [0.0, 100.0]);
    }

    #[test]
    fn one_value_or_none_keeps_the_range() {
        assert_eq!(counted(&[0.0, 5.0, 0.0]).typical_range(), [0.0, 3.0]);
        assert_eq!(counted(&[0.0; 4]).typical_range(), [0.0, 4.0]);
    }

    #[test]
    fn faces_and_repeated_values_are_told_from_the_rest() {
        let desc = VolumeDesc::new(UVec3::splat(30), StoredType::U8);
        let inside = |i: usize| [i % 30, i / 30 % 30, i / 900].iter().all(|&x| (10..20).contains(&x));
        let value = |i| if inside(i) { 100 + (i % 100) as u8 } else { 10 };
        let histogram = histogram(desc, (0..27_000).map(value).collect(), 64);
        let air = histogram.bin(10.0);
        assert_eq!(histogram.counts[air], 26_000.0);
        assert_eq!(histogram.repeated_counts[air], 25_900.0);
        assert_eq!(histogram.repeated_counts.iter().sum::<f64>(), 25_900.0);
        assert_eq!(histogram.face_counts[air], 6.0 * 15.0 * 15.0 * 4.0);
        assert_eq!(histogram.face_counts.iter().sum::<f64>(), histogram.face_counts[air]);
    }
}
