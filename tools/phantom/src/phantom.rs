use rayon::prelude::*;

use crate::anatomy;
use crate::framing::frame;
use crate::paint::{Scratch, Slice};
use crate::shape::Shape;

/// A body in a CT scanner, of any size.
///
/// The body is defined in millimetres; `extent` decides which part of it is in the frame and how finely it is
/// sampled:
///
/// - The smaller of x and y spacing that shows the whole width (466 mm) and depth (274 mm) of the body, equal on
///   both axes, is taken.
/// - A volume so deep that it reaches over 1500 mm at that spacing shows the whole body, 1800 mm tall; its z
///   spacing is what that needs.
/// - A shallower one has cubic voxels and shows the body from the crown of the head downwards.
/// - One that would be under 200 mm deep shows the chest around the heart.
///
/// Every voxel depends on its place, the extent and the seed alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Phantom {
    /// Voxels along x (to the patient's left), y (posterior) and z (superior); at least 1 each.
    pub extent: [u32; 3],
    /// Decides the noise, the grain of tissues, and how small vessels and bowels run.
    pub seed: u64,
}

impl Phantom {
    /// The extent of the Visible Human's CT as the literature uses it: 269 million voxels, 538 MB in 16 bits.
    pub const VISIBLE_HUMAN: [u32; 3] = [512, 304, 1730];

    /// A phantom of that extent. An axis of no voxels is taken as 1.
    pub fn new(extent: [u32; 3], seed: u64) -> Self {
        Self { extent: extent.map(|n| n.max(1)), seed }
    }

    /// The same body in the same frame with `factor` times the voxels on each axis, or `None` where that is no
    /// extent. It is the same continuous field sampled more finely, with noise of its own.
    pub fn upsampled(&self, factor: u32) -> Option<Self> {
        let [x, y, z] = self.extent.map(|n| n.checked_mul(factor).filter(|&n| n > 0));
        Some(Self { extent: [x?, y?, z?], seed: self.seed })
    }

    /// Distance of neighbouring voxel centres along x, y and z.
    pub fn spacing_mm(&self) -> [f64; 3] {
        frame(self.extent).spacing_mm
    }

    /// Where the centre of the first voxel lies: LPS millimetres, from the middle of the body at its soles.
    pub fn origin_mm(&self) -> [f64; 3] {
        frame(self.extent).origin_mm
    }

    /// Number of voxels of a slice.
    pub fn slice_voxels(&self) -> usize {
        self.extent[0] as usize * self.extent[1] as usize
    }

    /// Computes whole slices in Hounsfield units, −1024 to 3071, x fastest; slice 0 is the lowest.
    ///
    /// # Panics
    ///
    /// Where `out` is not a whole number of slices, or they reach beyond the volume.
    pub fn fill_slices(&self, first_slice: u32, out: &mut [i16]) {
        assert!(out.len().is_multiple_of(self.slice_voxels()), "a slab must hold whole slices");
        self.scan().fill_rows(u64::from(first_slice) * u64::from(self.extent[1]), out);
    }

    /// The body, and the grid on which it is sampled.
    pub(crate) fn scan(&self) -> Scan {
        Scan { grid: Grid::new(self.extent), shapes: anatomy::body(self.seed), seed: self.seed }
    }
}

/// A phantom whose body has been made, ready to be sampled.
#[derive(Clone, Debug)]
pub(crate) struct Scan {
    grid: Grid,
    shapes: Vec<Shape>,
    seed: u64,
}

impl Scan {
    /// Computes whole rows; row r is row r mod y-extent of slice r div y-extent.
    pub fn fill_rows(&self, first_row: u64, out: &mut [i16]) {
        let [nx, ny, nz] = self.grid.extent;
        let rows = (out.len() / nx as usize) as u64;
        let end = first_row.checked_add(rows).filter(|&end| end <= u64::from(ny) * u64::from(nz));
        assert!(end.is_some(), "rows {first_row} to {first_row} + {rows} reach beyond the volume");
        let paint = |scratch: &mut Scratch, (row, voxels): (u64, &mut [i16])| {
            let slice = Slice::new(&self.grid, &self.shapes, self.seed, (row / u64::from(ny)) as u32);
            for (y, out) in ((row % u64::from(ny)) as u32..).zip(voxels.chunks_exact_mut(nx as usize)) {
                slice.paint_row(y, scratch, out);
            }
        };
        pieces(first_row, ny, nx as usize, out).into_par_iter().for_each_init(Scratch::default, paint);
    }
}

/// Cuts a slab into runs of rows that each lie in one slice, and names each by its first row.
fn pieces(first_row: u64, ny: u32, nx: usize, mut out: &mut [i16]) -> Vec<(u64, &mut [i16])> {
    const ROWS: u64 = 256;
    let mut pieces = Vec::new();
    let mut row = first_row;
    while !out.is_empty() {
        let left_in_slice = u64::from(ny) - row % u64::from(ny);
        let rows = left_in_slice.min(ROWS);
        let voxels = (rows as usize * nx).min(out.len());
        let (piece, rest) = out.split_at_mut(voxels);
        pieces.push((row, piece));
        out = rest;
        row += rows;
    }
    pieces
}

/// The voxel grid in the world.
#[derive(Clone, Debug)]
pub(crate) struct Grid {
    extent: [u32; 3],
    pub spacing_mm: [f64; 3],
    origin_mm: [f64; 3],
    /// Width of the edge over which a surface goes from one tissue to the next.
    pub ramp_mm: f32,
}

impl Grid {
    fn new(extent: [u32; 3]) -> Self {
        const RAMP_VOXELS: f64 = 2.0;
        const LARGEST_RAMP_MM: f64 = 40.0;
        let frame = frame(extent);
        let mean_mm = frame.spacing_mm.iter().sum::<f64>() / 3.0;
        Self {
            extent,
            spacing_mm: frame.spacing_mm,
            origin_mm: frame.origin_mm,
            ramp_mm: (RAMP_VOXELS * mean_mm).min(LARGEST_RAMP_MM) as f32,
        }
    }

    /// Where the centres of voxels of that index lie on an axis.
    pub fn position(&self, axis: usize, index: u32) -> f64 {
        self.origin_mm[axis] + f64::from(index) * self.spacing_mm[axis]
    }

    /// The voxels of an axis whose centres lie in a range.
    pub fn voxels(&self, axis: usize, range_mm: [f32; 2]) -> std::ops::Range<usize> {
        let index = |mm: f32| (f64::from(mm) - self.origin_mm[axis]) / self.spacing_mm[axis];
        let count = self.extent[axis] as usize;
        let start = (index(range_mm[0]).ceil().max(0.0) as usize).min(count);
        start..((index(range_mm[1]).floor() + 1.0).max(0.0) as usize).clamp(start, count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(phantom: &Phantom) -> Vec<i16> {
        let mut voxels = vec![0; phantom.slice_voxels() * phantom.extent[2] as usize];
        phantom.fill_slices(0, &mut voxels);
        voxels
    }

    #[test]
    fn every_slab_split_and_thread_count_gives_the_same_voxels() {
        let phantom = Phantom::new([40, 33, 57], 9);
        let whole = volume(&phantom);
        for slices in [1, 7, 56] {
            let mut voxels = vec![0; whole.len()];
            for (index, slab) in voxels.chunks_mut(slices * phantom.slice_voxels()).enumerate() {
                phantom.fill_slices((index * slices) as u32, slab);
            }
            assert!(voxels == whole, "slabs of {slices} slices differ");
        }
        let scan = phantom.scan();
        let mut voxels = vec![0; whole.len()];
        for (index, slab) in voxels.chunks_mut(13 * 40).enumerate() {
            scan.fill_rows(index as u64 * 13, slab);
        }
        assert!(voxels == whole, "slabs of 13 rows differ");
        let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert!(one.install(|| volume(&phantom)) == whole, "one thread differs");
    }

    #[test]
    fn seeds_differ_in_noise_and_detail_only() {
        let [one, same, other] = [1, 1, 2].map(|seed| volume(&Phantom::new([48, 40, 64], seed)));
        assert!(one == same);
        let changed = one.iter().zip(&other).filter(|(a, b)| a != b).count();
        assert!(changed > one.len() / 2);
        let far =
            one.iter().zip(&other).filter(|&(&a, &b)| (i32::from(a) - i32::from(b)).abs() > 150).count();
        assert!(far < one.len() / 50, "{far} of {} voxels differ by more than noise", one.len());
    }

    #[test]
    fn the_whole_body_is_about_three_fifths_air() {
        let voxels = volume(&Phantom::new([128, 76, 433], 1));
        let air = voxels.iter().filter(|&&hu| hu < -900).count() as f64 / voxels.len() as f64;
        assert!((0.55..0.66).contains(&air), "air {air}");
        let noise = voxels[..76].iter().map(|&hu| (f64::from(hu) + 1000.0).powi(2)).sum::<f64>() / 76.0;
        assert!(noise.sqrt() < 6.0, "noise in air {}", noise.sqrt());
    }

    #[test]
    fn twice_the_resolution_shows_the_same_body() {
        let coarse = Phantom::new([48, 40, 64], 3);
        let fine = coarse.upsampled(2).unwrap();
        assert_eq!(fine.extent, [96, 80, 128]);
        let (a, b) = (volume(&coarse), volume(&fine));
        let mut difference = 0.0;
        for (index, &hu) in a.iter().enumerate() {
            let (x, y, z) = (index % 48, index / 48 % 40, index / (48 * 40));
            let corner = |n: usize| {
                let (dx, dy, dz) = (n & 1, n >> 1 & 1, n >> 2);
                f64::from(b[((2 * z + dz) * 80 + 2 * y + dy) * 96 + 2 * x + dx])
            };
            let mean = (0..8).map(corner).sum::<f64>() / 8.0;
            difference += (f64::from(hu) - mean).abs() / a.len() as f64;
        }
        assert!(difference < 25.0, "mean difference {difference} HU");
        assert_eq!(coarse.upsampled(0), None);
        assert_eq!(coarse.upsampled(u32::MAX), None);
    }

    #[test]
    fn any_extent_can_be_made() {
        let extents =
            [[1, 1, 1], [1, 2, 3], [7, 1, 1], [1, 9, 1], [1, 1, 300], [3, 300, 2], [300, 2, 1], [2, 2, 4000]];
        for extent in extents {
            let phantom = Phantom::new(extent, 0);
            assert!(volume(&phantom).iter().all(|hu| (-1024..=3071).contains(hu)), "{extent:?}");
            assert!(phantom.spacing_mm().iter().all(|mm| mm.is_finite() && *mm > 0.0));
        }
        assert_eq!(Phantom::new([0, 2, 3], 0).extent, [1, 2, 3]);
    }

    #[test]
    #[should_panic(expected = "reach beyond the volume")]
    fn slices_beyond_the_volume_are_refused() {
        Phantom::new([4, 4, 4], 0).fill_slices(3, &mut [0; 32]);
    }
}
