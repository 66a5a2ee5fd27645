use glam::UVec3;

use crate::{Band, BrickGrid, BrickRange, Rescale, VoxelCountTable};

/// The bricks that a transfer function can see. They depend on the transfer function alone, not on the view.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct VisibleBricks {
    /// Filtered visible bricks by their place in the grid, ascending.
    pub bricks: Vec<u32>,
    /// Bricks in which no sample can have an opacity above zero.
    pub empty: usize,
    /// Bricks that are not empty, but dropped by α and β.
    pub nearly_empty: usize,
}

/// Which nearly empty bricks to drop: a brick stays when of at least one band (α = 0 or R1 > α) and (β = 1 or R2 < β).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearlyEmpty {
    pub alpha: f64,
    pub beta: f64,
}

impl NearlyEmpty {
    /// Drops nothing but empty bricks.
    pub const KEEP: Self = Self { alpha: 0.0, beta: 1.0 };

    /// Whether pictures may lose something by it.
    pub fn is_lossy(&self) -> bool {
        self.alpha > 0.0 || self.beta < 1.0
    }

    fn keeps(&self, bands: &[Band], table: &VoxelCountTable, rescale: Rescale) -> bool {
        bands.iter().any(|band| {
            let fractions = table.fractions(band, rescale);
            (self.alpha == 0.0 || fractions.r1 > self.alpha) && (self.beta == 1.0 || fractions.r2 < self.beta)
        })
    }
}

/// Whether no sample of a brick can have an opacity above zero: no band meets the values that trilinear
/// interpolation can reach in it. Exact: a brick with voxels below and above a band, and none in it, still shows it.
pub fn is_empty_for(range: &BrickRange, bands: &[Band], rescale: Rescale) -> bool {
    let [min, max] = range.value_range(rescale);
    !bands.iter().any(|band| band.meets(min, max))
}

/// Every brick of a grid: the list of a picture in which nothing is skipped.
pub fn all_bricks(grid: &BrickGrid) -> VisibleBricks {
    VisibleBricks { bricks: (0..grid.len() as u32).collect(), ..VisibleBricks::default() }
}

/// The filtered visible bricks by emptiness alone.
pub fn filtered_visible(ranges: &[BrickRange], bands: &[Band], rescale: Rescale) -> VisibleBricks {
    let bricks: Vec<u32> = (0..ranges.len())
        .filter(|&brick| !is_empty_for(&ranges[brick], bands, rescale))
        .map(|brick| brick as u32)
        .collect();
    VisibleBricks { empty: ranges.len() - bricks.len(), nearly_empty: 0, bricks }
}

/// Drops the nearly empty bricks of a list. `tables` holds every brick of the grid.
pub fn without_nearly_empty(
    mut visible: VisibleBricks,
    tables: &[VoxelCountTable],
    bands: &[Band],
    rescale: Rescale,
    nearly_empty: NearlyEmpty,
) -> VisibleBricks {
    let before = visible.bricks.len();
    visible.bricks.retain(|&brick| nearly_empty.keeps(bands, &tables[brick as usize], rescale));
    visible.nearly_empty = before - visible.bricks.len();
    visible
}

/// Boundary bricks: visible bricks by their distance, in bricks, from the surface of the grid, then by id; as many as
/// fill half the slots are worth prefetching and pinning, since a view from outside meets them first.
pub fn boundary_bricks(visible: &VisibleBricks, grid: &BrickGrid, slots: usize) -> Vec<u32> {
    let depth = |brick: u32| {
        let brick = grid.brick(brick as usize);
        brick.min(grid.counts - UVec3::ONE - brick).min_element()
    };
    let mut bricks = visible.bricks.clone();
    bricks.sort_by_key(|&brick| (depth(brick), brick));
    bricks.truncate(slots / 2);
    bricks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Bins, BrickLayout};

    const BAND: Band = Band { low: 100.0, high: 200.0 };

    fn range(min: f32, max: f32) -> BrickRange {
        BrickRange { reach: [min, max], core: [min, max] }
    }

    #[test]
    fn a_brick_between_two_bands_is_dropped_and_one_across_a_band_is_drawn() {
        let bands = [BAND, Band { low: 300.0, high: 400.0 }];
        let ranges = [range(210.0, 290.0), range(0.0, 90.0), range(0.0, 500.0), range(250.0, 301.0)];
        let visible = filtered_visible(&ranges, &bands, Rescale::IDENTITY);
        assert_eq!(visible.bricks, vec![2, 3]);
        assert_eq!(visible.empty, 2);
    }

    #[test]
    fn a_negative_slope_is_followed() {
        let rescale = Rescale { slope: -1.0, intercept: 0.0 };
        assert!(is_empty_for(&range(100.0, 200.0), &[BAND], rescale));
        assert!(!is_empty_for(&range(-150.0, -140.0), &[BAND], rescale));
    }

    #[test]
    fn alpha_and_beta_need_one_band_that_passes_both() {
        let bins = Bins { min: 0.0, max: 255.0, whole_numbers: true };
        let mostly_below = VoxelCountTable::count((0..100).map(|v| if v < 95 { 0.0 } else { 150.0 }), bins);
        let visible = VisibleBricks { bricks: vec![0], empty: 0, nearly_empty: 0 };
        let keep = |alpha, beta| {
            let nearly_empty = NearlyEmpty { alpha, beta };
            let tables = std::slice::from_ref(&mostly_below);
            !without_nearly_empty(visible.clone(), tables, &[BAND], Rescale::IDENTITY, nearly_empty)
                .bricks
                .is_empty()
        };
        assert!(keep(0.0, 1.0));
        assert!(keep(0.5, 1.0), "R1 is 1");
        assert!(!keep(0.0, 0.9), "R2 is 0.95");
        assert!(!keep(0.5, 0.9), "passing one of the two is not enough");
        assert!(keep(0.0, 0.96));
    }

    #[test]
    fn boundary_bricks_come_from_the_outside_in() {
        let grid = BrickLayout { edge: 8, halo: 2 }.grid(UVec3::splat(20));
        let visible = all_bricks(&grid);
        let boundary = boundary_bricks(&visible, &grid, 250);
        assert_eq!(boundary.len(), 125);
        assert_eq!(*boundary.last().expect("not empty"), grid.index(UVec3::splat(2)) as u32);
        assert_eq!(boundary_bricks(&visible, &grid, 6), vec![0, 1, 2]);
    }
}
