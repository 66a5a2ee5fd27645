use glassbrick::VolumeDesc;
use glassbrick_tests::drawing::{desc, native_bytes};
use glassbrick_tests::scenes::Scene;
use glassbrick_volume::{FlatPlacement, ReadError, VolumeReader};

/// A scene's volume, read as a stream of slices.
pub struct ArrayReader {
    desc: VolumeDesc,
    voxels: Vec<u8>,
    read: usize,
}

impl ArrayReader {
    pub fn of(scene: &Scene) -> Self {
        Self { desc: desc(scene), voxels: native_bytes(scene), read: 0 }
    }
}

impl VolumeReader for ArrayReader {
    fn desc(&self) -> &VolumeDesc {
        &self.desc
    }

    fn format(&self) -> &'static str {
        "array"
    }

    fn notes(&self) -> &[String] {
        &[]
    }

    fn flat_placement(&self) -> Option<&FlatPlacement> {
        None
    }

    fn read_slices(&mut self, out: &mut [u8]) -> Result<(), ReadError> {
        let slices = self.voxels.get(self.read..self.read + out.len()).ok_or("there are no more slices")?;
        out.copy_from_slice(slices);
        self.read += out.len();
        Ok(())
    }

    fn bytes_read(&self) -> u64 {
        self.read as u64
    }
}
