use glassbrick::{Band, Error, TransferFunction, Volume, filtered_visible};

/// What a transfer function needs of a volume.
pub struct Needs {
    pub bands: Vec<Band>,
    /// Bricks in which nothing is shown.
    pub empty: usize,
    pub filtered_visible: usize,
    /// Of these, decoded.
    pub bytes: u64,
    /// Of these, in files, before decoding; estimated.
    pub file_bytes: f64,
    /// How long loading them takes, with what is in the system's memory there already; estimated.
    pub load_seconds: f64,
    /// The fraction of the volume's voxels that lie in a band, by the voxel-count tables.
    pub visible_voxels: f64,
}

impl Needs {
    /// Finds the visible bricks by their ranges, and the visible voxels by their tables; loads a few bricks to measure
    /// what all of them will take.
    ///
    /// # Errors
    /// When the voxels cannot be read.
    pub fn measure(volume: &Volume, transfer_function: &TransferFunction) -> Result<Self, Error> {
        let (desc, bricks) = (volume.desc(), volume.bricks());
        let bands = transfer_function.bake(desc.smallest_spacing_mm()).bands();
        let visible = filtered_visible(bricks.ranges(0), &bands, desc.rescale);
        let tables = volume.voxel_count_tables()?;
        let visible_voxels = |brick: u32| {
            let table = &tables[brick as usize];
            let fraction: f64 = bands.iter().map(|band| table.fractions(band, desc.rescale).visible()).sum();
            // A bin that two bands cut is counted by both.
            fraction.min(1.0) * f64::from(table.voxels())
        };
        let voxels: f64 = visible.bricks.iter().map(|&brick| visible_voxels(brick)).sum();
        let (file_bytes, seconds) = volume.measure_loading(&visible.bricks)?;
        let loaded = visible.bricks.len() as f64;
        Ok(Self {
            bands,
            file_bytes: loaded * file_bytes,
            load_seconds: loaded * seconds / volume.threads() as f64,
            empty: visible.empty,
            filtered_visible: visible.bricks.len(),
            bytes: visible.bricks.len() as u64 * decoded_brick_bytes(volume),
            visible_voxels: voxels / desc.voxels() as f64,
        })
    }
}

/// A brick in memory; types of more than 4 bytes are kept as `f32`.
fn decoded_brick_bytes(volume: &Volume) -> u64 {
    let layout = volume.bricks().grid(0).layout;
    layout.voxels() as u64 * volume.desc().stored_type.bytes().min(4) as u64
}
