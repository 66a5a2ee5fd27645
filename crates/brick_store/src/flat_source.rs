use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::{Duration, Instant};

use glam::UVec3;
use glassbrick_volume::{
    Brick, BrickGrid, BrickId, BrickLayout, BrickRange, BrickSource, FlatPlacement, ReadError, VolumeDesc,
    VolumeReader, VoxelCountTable,
};

use crate::brick_cut::cut_brick;
use crate::range_scan::{RangeScan, scan_ranges};
use crate::table_scan::scan_tables;
use crate::{FlatVoxels, SourceError};

/// A volume whose voxels all are at hand: uncompressed files read in place, or an array in memory.
///
/// Opening it scans it once for the ranges of its bricks; bricks are cut when they are asked for. It has one level.
pub struct FlatSource {
    desc: VolumeDesc,
    voxels: FlatVoxels,
    grid: BrickGrid,
    scan: RangeScan,
    tables: OnceLock<Arc<Vec<VoxelCountTable>>>,
    bytes_read: AtomicU64,
    scan_time: Duration,
}

impl FlatSource {
    /// Maps and scans the files in which the voxels lie. They must not be cut while the source is in use.
    pub fn map(
        desc: VolumeDesc,
        placement: &FlatPlacement,
        layout: BrickLayout,
    ) -> Result<Self, SourceError> {
        check(&desc, layout)?;
        let voxels = FlatVoxels::map(&desc, placement)?;
        Ok(Self::scanned(desc, voxels, layout))
    }

    /// Takes stored voxels in this machine's byte order, x fastest, and scans them.
    pub fn from_array(desc: VolumeDesc, voxels: Vec<u8>, layout: BrickLayout) -> Result<Self, SourceError> {
        check(&desc, layout)?;
        let voxels = FlatVoxels::array(&desc, voxels)?;
        Ok(Self::scanned(desc, voxels, layout))
    }

    /// Opens what a reader reads: in place where its voxels lie uncompressed in files, else into an array.
    ///
    /// `progress` hears how many bytes of how many were read into the array.
    pub fn open(
        reader: &mut dyn VolumeReader,
        layout: BrickLayout,
        progress: &mut dyn FnMut(u64, u64),
    ) -> Result<Self, SourceError> {
        let desc = reader.desc().clone();
        if let Some(placement) = reader.flat_placement() {
            return Self::map(desc, placement, layout);
        }
        check(&desc, layout)?;
        let voxels = read_whole(reader, progress)?;
        let mut source = Self::from_array(desc, voxels, layout)?;
        source.bytes_read = AtomicU64::new(reader.bytes_read());
        Ok(source)
    }

    fn scanned(desc: VolumeDesc, voxels: FlatVoxels, layout: BrickLayout) -> Self {
        let grid = layout.grid(desc.extent);
        let start = Instant::now();
        let scan = scan_ranges(&desc, &voxels, &grid);
        let scan_time = start.elapsed();
        let bytes_read = AtomicU64::new(if voxels.is_mapped() { desc.bytes() } else { 0 });
        Self { desc, voxels, grid, scan, tables: OnceLock::new(), bytes_read, scan_time }
    }

    /// How long the scan for ranges took.
    pub fn scan_time(&self) -> Duration {
        self.scan_time
    }

    fn count_read(&self, bytes: u64) {
        if self.voxels.is_mapped() {
            self.bytes_read.fetch_add(bytes, Ordering::Relaxed);
        }
    }
}

/// The voxels of all slices, in slabs.
fn read_whole(
    reader: &mut dyn VolumeReader,
    progress: &mut dyn FnMut(u64, u64),
) -> Result<Vec<u8>, SourceError> {
    const SLAB_BYTES: usize = 32 << 20;
    let (needed, slice_bytes) = (reader.desc().bytes(), reader.desc().slice_bytes() as usize);
    let mut voxels = Vec::new();
    usize::try_from(needed)
        .ok()
        .and_then(|needed| voxels.try_reserve_exact(needed).ok())
        .ok_or(SourceError::OutOfMemory { needed })?;
    let slab_bytes = (SLAB_BYTES / slice_bytes).max(1) * slice_bytes;
    while voxels.len() < needed as usize {
        let start = voxels.len();
        voxels.resize((start + slab_bytes).min(needed as usize), 0);
        reader.read_slices(&mut voxels[start..])?;
        progress(voxels.len() as u64, needed);
    }
    Ok(voxels)
}

fn check(desc: &VolumeDesc, layout: BrickLayout) -> Result<(), SourceError> {
    let BrickLayout { edge, halo } = layout;
    let least = 2 * halo.clamp(2, 64) + 4;
    if !(least..=512).contains(&edge) || !(2..=64).contains(&halo) {
        return Err(SourceError::BadLayout { edge, halo, least });
    }
    if desc.extent.cmpeq(UVec3::ZERO).any() {
        return Err(SourceError::NoVoxels);
    }
    let rescale = desc.rescale;
    if rescale.slope == 0.0 || !rescale.slope.is_finite() || !rescale.intercept.is_finite() {
        return Err(SourceError::BadRescale { slope: rescale.slope, intercept: rescale.intercept });
    }
    Ok(())
}

impl BrickSource for FlatSource {
    fn desc(&self) -> &VolumeDesc {
        &self.desc
    }

    fn levels(&self) -> u32 {
        1
    }

    fn grid(&self, _level: u32) -> BrickGrid {
        self.grid
    }

    fn ranges(&self, _level: u32) -> &[BrickRange] {
        &self.scan.ranges
    }

    fn voxel_count_tables(&self, _level: u32) -> Result<Arc<Vec<VoxelCountTable>>, ReadError> {
        let tables = self.tables.get_or_init(|| {
            self.count_read(self.desc.bytes());
            Arc::new(scan_tables(&self.desc, &self.voxels, &self.grid, &self.scan.ranges))
        });
        Ok(Arc::clone(tables))
    }

    fn brick(&self, id: BrickId) -> Result<Arc<Brick>, ReadError> {
        self.count_read(self.grid.layout.voxels() as u64 * self.desc.stored_type.bytes() as u64);
        Ok(Arc::new(cut_brick(&self.desc, &self.voxels, &self.grid, id.place())))
    }

    /// The operating system reads mapped files ahead by itself.
    fn will_need(&self, _bricks: &[BrickId]) {}

    /// Bricks are cut anew each time, and nothing was promised of what becomes of them.
    fn can_hold(&self, _bricks: usize) -> bool {
        false
    }

    fn not_finite(&self) -> u64 {
        self.scan.not_finite
    }

    fn bytes_read(&self) -> u64 {
        self.bytes_read.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use glassbrick_volume::StoredType;

    use super::*;

    /// A reader of zeros that claims to read a byte for every four.
    struct Packed {
        desc: VolumeDesc,
        bytes_read: u64,
    }

    impl VolumeReader for Packed {
        fn desc(&self) -> &VolumeDesc {
            &self.desc
        }

        fn format(&self) -> &'static str {
            "packed"
        }

        fn notes(&self) -> &[String] {
            &[]
        }

        fn flat_placement(&self) -> Option<&FlatPlacement> {
            None
        }

        fn read_slices(&mut self, out: &mut [u8]) -> Result<(), ReadError> {
            self.bytes_read += out.len() as u64 / 4;
            Ok(())
        }

        fn bytes_read(&self) -> u64 {
            self.bytes_read
        }
    }

    #[test]
    fn what_a_reader_read_before_decoding_is_counted_once() {
        let desc = VolumeDesc::new(UVec3::splat(32), StoredType::U8);
        let mut reader = Packed { desc, bytes_read: 0 };
        let layout = BrickLayout { edge: 16, halo: 2 };
        let source = FlatSource::open(&mut reader, layout, &mut |_, _| {}).expect("a sound reader");
        assert_eq!(source.bytes_read(), 32 * 32 * 8);
        source.brick(BrickId { level: 0, x: 0, y: 0, z: 0 }).expect("in memory");
        source.voxel_count_tables(0).expect("in memory");
        assert_eq!(source.bytes_read(), 32 * 32 * 8);
    }
}
