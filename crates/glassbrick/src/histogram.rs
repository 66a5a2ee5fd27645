use glam::UVec3;
use glassbrick_volume::{Brick, BrickGrid, BrickId, BrickSource, ReadError, Rescale, Voxels};
use rayon::prelude::*;

/// Bins of a histogram.
pub const HISTOGRAM_BINS: usize = 4096;

/// Bricks that are read for a histogram, at most.
const MOST_BRICKS: usize = 160;

/// How often values occur in a volume, estimated from a part of its voxels.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// Smallest and largest value of the volume, exact.
    pub range: [f64; 2],
    /// Estimated voxels in equal bins over the range.
    pub counts: Vec<f64>,
}

impl Histogram {
    /// Counts bricks spread over the volume, every other voxel on each axis. Bricks of one value are not read.
    ///
    /// # Errors
    /// When a brick cannot be read.
    pub fn sample(source: &dyn BrickSource) -> Result<Self, ReadError> {
        let (grid, ranges) = (source.grid(0), source.ranges(0));
        let rescale = source.desc().rescale;
        let range = value_range(source);
        let mut counts = vec![0.0; HISTOGRAM_BINS];
        let (constant, varied): (Vec<usize>, Vec<usize>) =
            (0..grid.len()).partition(|&brick| ranges[brick].core[0] == ranges[brick].core[1]);
        let binner = Binner::new(range, rescale);
        for brick in constant {
            counts[binner.bin(ranges[brick].core[0])] += core_voxels(&grid, grid.brick(brick));
        }
        let chosen = spread(&varied, MOST_BRICKS);
        let weight = varied.len() as f64 / chosen.len().max(1) as f64;
        let parts: Vec<(Vec<u32>, f64)> = chosen
            .par_iter()
            .map(|&index| {
                let at = grid.brick(index);
                let brick = source.brick(BrickId { level: 0, x: at.x, y: at.y, z: at.z })?;
                let (part, voxels) = count_brick(&brick, &grid, at, &binner);
                Ok((part, core_voxels(&grid, at) / f64::from(voxels.max(1))))
            })
            .collect::<Result<_, ReadError>>()?;
        for (part, per_voxel) in parts {
            for (count, voxels) in counts.iter_mut().zip(part) {
                *count += f64::from(voxels) * per_voxel * weight;
            }
        }
        Ok(Self { range, counts })
    }

    /// The value in the middle of a bin.
    pub fn value(&self, bin: usize) -> f64 {
        let [min, max] = self.range;
        min + (max - min) * (bin as f64 + 0.5) / self.counts.len() as f64
    }

    /// Estimated number of voxels.
    pub fn voxels(&self) -> f64 {
        self.counts.iter().sum()
    }
}

/// Smallest and largest value of a volume.
pub fn value_range(source: &dyn BrickSource) -> [f64; 2] {
    let rescale = source.desc().rescale;
    let stored = source.ranges(0).iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[min, max], range| {
        [min.min(range.core[0]), max.max(range.core[1])]
    });
    let [a, b] = stored.map(|stored| rescale.value(f64::from(stored)));
    [a.min(b), a.max(b)]
}

/// Takes stored values to bins.
struct Binner {
    first_stored: f64,
    bins_per_stored: f64,
}

impl Binner {
    fn new([min, max]: [f64; 2], rescale: Rescale) -> Self {
        let bins_per_value = if max > min { HISTOGRAM_BINS as f64 / (max - min) } else { 0.0 };
        Self { first_stored: rescale.stored(min), bins_per_stored: bins_per_value * rescale.slope }
    }

    fn bin(&self, stored: f32) -> usize {
        let bin = (f64::from(stored) - self.first_stored) * self.bins_per_stored;
        (bin.max(0.0) as usize).min(HISTOGRAM_BINS - 1)
    }
}

/// At most `most` of the items, spread over them evenly but not in a regular pattern (golden-section steps).
fn spread(items: &[usize], most: usize) -> Vec<usize> {
    if items.len() <= most {
        return items.to_vec();
    }
    let stride = items.len() as f64 / most as f64;
    (0..most)
        .map(|i| {
            items[(((i as f64) + (i as f64 * 0.618_033_988_75).fract()) * stride) as usize % items.len()]
        })
        .collect()
}

fn core_voxels(grid: &BrickGrid, brick: UVec3) -> f64 {
    (grid.core_end(brick) - grid.core_start(brick)).as_dvec3().element_product()
}

/// Counts every other core voxel on each axis; also says how many that were.
fn count_brick(brick: &Brick, grid: &BrickGrid, at: UVec3, binner: &Binner) -> (Vec<u32>, u32) {
    match &brick.voxels {
        Voxels::U8(voxels) => count(voxels, grid, at, binner),
        Voxels::I8(voxels) => count(voxels, grid, at, binner),
        Voxels::U16(voxels) => count(voxels, grid, at, binner),
        Voxels::I16(voxels) => count(voxels, grid, at, binner),
        Voxels::F32(voxels) => count(voxels, grid, at, binner),
    }
}

fn count<V: Copy + Into<f32>>(voxels: &[V], grid: &BrickGrid, at: UVec3, binner: &Binner) -> (Vec<u32>, u32) {
    let edge = grid.layout.edge as usize;
    let halo = grid.layout.halo as usize;
    let core = (grid.core_end(at) - grid.core_start(at)).as_usizevec3();
    let mut counts = vec![0u32; HISTOGRAM_BINS];
    let mut counted = 0;
    for z in (0..core.z).step_by(2) {
        for y in (0..core.y).step_by(2) {
            let row = ((z + halo) * edge + y + halo) * edge + halo;
            for &voxel in voxels[row..row + core.x].iter().step_by(2) {
                counts[binner.bin(voxel.into())] += 1;
                counted += 1;
            }
        }
    }
    (counts, counted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glassbrick_brick_store::FlatSource;
    use glassbrick_volume::{BrickLayout, StoredType, VolumeDesc};

    #[test]
    fn a_volume_of_two_values_has_two_bins() {
        let mut desc = VolumeDesc::new(UVec3::splat(40), StoredType::U8);
        desc.rescale = Rescale { slope: -2.0, intercept: 10.0 };
        let voxels: Vec<u8> = (0..64_000).map(|i| if i < 16_000 { 0 } else { 100 }).collect();
        let source = FlatSource::from_array(desc, voxels, BrickLayout { edge: 16, halo: 2 }).expect("sound");
        let histogram = Histogram::sample(&source).expect("an array is read");
        assert_eq!(histogram.range, [-190.0, 10.0]);
        assert!((histogram.voxels() - 64_000.0).abs() < 1.0);
        assert!((histogram.counts[0] - 48_000.0).abs() < 2_500.0, "{}", histogram.counts[0]);
        assert_eq!(histogram.counts.iter().filter(|&&count| count > 0.0).count(), 2);
    }
}
