use crate::Histogram;

/// Every value.
pub(super) const ALL: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// What can be asked of a histogram.
pub(super) struct Distribution<'a> {
    pub histogram: &'a Histogram,
    /// Voxels in the bins before each, and in all of them at the end.
    voxels: Vec<f64>,
    /// The same of the voxels on the volume's faces.
    faces: Vec<f64>,
}

impl<'a> Distribution<'a> {
    /// None where all voxels have one value.
    pub fn of(histogram: &'a Histogram) -> Option<Self> {
        let [min, max] = histogram.range;
        let width = histogram.bin_width();
        let varied = max > min && (max - min).is_finite() && width > 0.0 && width.is_finite();
        (varied && histogram.voxels() > 0.0).then(|| Self {
            histogram,
            voxels: cumulative(&histogram.counts),
            faces: cumulative(&histogram.face_counts),
        })
    }

    /// The fraction of the voxels with values between two.
    pub fn fraction(&self, between: [f64; 2]) -> f64 {
        self.share(&self.voxels, between)
    }

    /// The fraction of the voxels on the faces with values between two.
    pub fn face_fraction(&self, between: [f64; 2]) -> f64 {
        self.share(&self.faces, between)
    }

    /// The value below which a fraction of the voxels with values between two lies.
    pub fn quantile(&self, fraction: f64, between: [f64; 2]) -> f64 {
        self.quantile_of(&self.voxels, fraction, between)
    }

    /// The same of the voxels on the faces.
    pub fn face_quantile(&self, fraction: f64, between: [f64; 2]) -> f64 {
        self.quantile_of(&self.faces, fraction, between)
    }

    /// Where the interval of this width lies that holds most voxels: the median of those in it.
    pub fn mode(&self, width: f64) -> f64 {
        self.mode_of(&self.voxels, width)
    }

    /// The same of the voxels on the faces; of all, where there are none.
    pub fn face_mode(&self, width: f64) -> f64 {
        self.mode_of(if self.faces[self.faces.len() - 1] > 0.0 { &self.faces } else { &self.voxels }, width)
    }

    /// How likely a voxel on the faces has a higher value than another voxel: a half where they are alike.
    pub fn faces_above(&self) -> f64 {
        let pairs = self.histogram.face_counts.iter().zip(self.voxels.windows(2));
        let above: f64 = pairs.map(|(&count, below)| count * 0.5 * (below[0] + below[1])).sum();
        let last = self.voxels.len() - 1;
        let all = self.voxels[last] * self.faces[last];
        if all > 0.0 { above / all } else { 0.5 }
    }

    /// The value that parts the voxels with values between two best into two classes (Otsu 1979); the middle, where all
    /// are of one.
    pub fn threshold(&self, [low, high]: [f64; 2]) -> f64 {
        let histogram = self.histogram;
        let bins = || {
            (histogram.bin(low)..=histogram.bin(high))
                .map(|bin| (histogram.value(bin), histogram.counts[bin]))
        };
        let (count, sum) = bins().fold((0.0, 0.0), |(n, s), (value, count)| (n + count, s + count * value));
        let (mut below, mut sum_below) = (0.0, 0.0);
        let (mut best, mut threshold) = (0.0, 0.5 * (low + high));
        for (value, in_bin) in bins() {
            below += in_bin;
            sum_below += in_bin * value;
            let above = count - below;
            if below > 0.0 && above > 0.0 {
                let apart = (sum - sum_below) / above - sum_below / below;
                let between = below * above * apart * apart;
                if between > best {
                    (best, threshold) = (between, value + 0.5 * histogram.bin_width());
                }
            }
        }
        threshold
    }

    fn share(&self, cumulative: &[f64], [low, high]: [f64; 2]) -> f64 {
        let all = cumulative[cumulative.len() - 1];
        let between = self.up_to(cumulative, high) - self.up_to(cumulative, low);
        if all > 0.0 { (between / all).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Voxels up to a value: of a bin that it cuts, the same part.
    fn up_to(&self, cumulative: &[f64], value: f64) -> f64 {
        let last = cumulative.len() - 1;
        let at = ((value - self.histogram.span[0]) / self.histogram.bin_width()).clamp(0.0, last as f64);
        let bin = (at as usize).min(last - 1);
        cumulative[bin] + (cumulative[bin + 1] - cumulative[bin]) * (at - bin as f64)
    }

    fn quantile_of(&self, cumulative: &[f64], fraction: f64, [low, high]: [f64; 2]) -> f64 {
        let (below, above) = (self.up_to(cumulative, low), self.up_to(cumulative, high));
        let wanted = below + fraction * (above - below);
        let bin = cumulative.partition_point(|&voxels| voxels < wanted).clamp(1, cumulative.len() - 1) - 1;
        let count = cumulative[bin + 1] - cumulative[bin];
        let inside = if count > 0.0 { ((wanted - cumulative[bin]) / count).clamp(0.0, 1.0) } else { 0.5 };
        let value = self.histogram.span[0] + (bin as f64 + inside) * self.histogram.bin_width();
        let [min, max] = self.histogram.range;
        value.max(low.max(min)).min(high.min(max))
    }

    fn mode_of(&self, cumulative: &[f64], width: f64) -> f64 {
        let (bins, bin_width) = (cumulative.len() - 1, self.histogram.bin_width());
        let wide = ((width / bin_width).round() as usize).clamp(1, bins);
        let voxels = |start: usize| cumulative[start + wide] - cumulative[start];
        let start =
            (0..=bins - wide).fold(0, |best, start| if voxels(start) > voxels(best) { start } else { best });
        let ends = [start, start + wide].map(|bin| self.histogram.span[0] + bin as f64 * bin_width);
        self.quantile_of(cumulative, 0.5, ends)
    }
}

fn cumulative(counts: &[f64]) -> Vec<f64> {
    let sums = counts.iter().scan(0.0, |sum, count| {
        *sum += count;
        Some(*sum)
    });
    std::iter::once(0.0).chain(sums).collect()
}
