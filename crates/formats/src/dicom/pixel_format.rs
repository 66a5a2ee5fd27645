//! How a voxel lies in its bytes, and how it becomes a stored value.

use glassbrick_volume::StoredType;

use super::byte_stream::Parsed;
use super::data_set::DataSet;
use super::data_set_reader::PixelElement;
use super::tag;

/// The voxels of a file once its frames are decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct PixelFormat {
    pub stored_type: StoredType,
    pub bits: BitField,
}

/// The bits of a voxel that hold its value; those around it may hold anything (overlays, once).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct BitField {
    pub stored: u32,
    pub high: u32,
}

impl BitField {
    /// The lowest bits of a voxel.
    pub(super) fn low(stored: u32) -> Self {
        Self { stored, high: stored - 1 }
    }
}

impl PixelFormat {
    /// Reads the format of the voxels that `pixels` holds.
    pub(super) fn read(data_set: &DataSet, pixels: &PixelElement) -> Parsed<Self> {
        match pixels.tag {
            tag::FLOAT_PIXEL_DATA => return Ok(Self::whole(StoredType::F32)),
            tag::DOUBLE_FLOAT_PIXEL_DATA => return Ok(Self::whole(StoredType::F64)),
            _ => {}
        }
        let signed = data_set.whole(tag::PIXEL_REPRESENTATION).unwrap_or(0) == 1;
        let allocated = data_set.whole(tag::BITS_ALLOCATED).ok_or("BitsAllocated is missing")?;
        let stored_type = match (allocated, signed) {
            (8, false) => StoredType::U8,
            (8, true) => StoredType::I8,
            (16, false) => StoredType::U16,
            (16, true) => StoredType::I16,
            (32, false) => StoredType::U32,
            (32, true) => StoredType::I32,
            (1, _) => return Err("holds 1-bit voxels (a segmentation), which are not read".to_owned()),
            _ => return Err(format!("has BitsAllocated {allocated}; 8, 16 and 32 are read")),
        };
        let stored = data_set.whole(tag::BITS_STORED).unwrap_or(allocated);
        let high = data_set.whole(tag::HIGH_BIT).unwrap_or(stored.saturating_sub(1));
        if stored == 0 || stored > allocated || high >= allocated || high + 1 < stored {
            return Err(format!("has BitsStored {stored} and HighBit {high} in BitsAllocated {allocated}"));
        }
        Ok(Self { stored_type, bits: BitField { stored, high } })
    }

    fn whole(stored_type: StoredType) -> Self {
        Self { stored_type, bits: BitField::low(stored_type.bytes() as u32 * 8) }
    }

    /// Whether every bit of a voxel is part of its value.
    pub(super) fn uses_all_bits(self) -> bool {
        self.bits.stored as usize == self.stored_type.bytes() * 8
    }

    /// Makes voxels in this machine's byte order stored values: takes the bit field and extends its sign.
    pub(super) fn extract(self, bits: BitField, voxels: &mut [u8]) {
        let allocated = self.stored_type.bytes() as u32 * 8;
        if bits.stored == allocated || !self.stored_type.is_integer() {
            return;
        }
        let (left, right) = (allocated - 1 - bits.high, allocated - bits.stored);
        match self.stored_type {
            StoredType::U8 => map(voxels, |voxel: [u8; 1]| [voxel[0] << left >> right]),
            StoredType::I8 => map(voxels, |voxel: [u8; 1]| [((voxel[0] << left) as i8 >> right) as u8]),
            StoredType::U16 => {
                map(voxels, |voxel| (u16::from_ne_bytes(voxel) << left >> right).to_ne_bytes())
            }
            StoredType::I16 => {
                map(voxels, |voxel| (i16::from_ne_bytes(voxel) << left >> right).to_ne_bytes())
            }
            StoredType::U32 => {
                map(voxels, |voxel| (u32::from_ne_bytes(voxel) << left >> right).to_ne_bytes())
            }
            StoredType::I32 => {
                map(voxels, |voxel| (i32::from_ne_bytes(voxel) << left >> right).to_ne_bytes())
            }
            StoredType::F32 | StoredType::F64 => {}
        }
    }

    /// Voxels as numbers, for rescaling.
    pub(super) fn numbers(self, voxels: &[u8]) -> Vec<f64> {
        match self.stored_type {
            StoredType::U8 => voxels.iter().map(|&voxel| f64::from(voxel)).collect(),
            StoredType::I8 => voxels.iter().map(|&voxel| f64::from(voxel as i8)).collect(),
            StoredType::U16 => convert(voxels, |voxel| f64::from(u16::from_ne_bytes(voxel))),
            StoredType::I16 => convert(voxels, |voxel| f64::from(i16::from_ne_bytes(voxel))),
            StoredType::U32 => convert(voxels, |voxel| f64::from(u32::from_ne_bytes(voxel))),
            StoredType::I32 => convert(voxels, |voxel| f64::from(i32::from_ne_bytes(voxel))),
            StoredType::F32 => convert(voxels, |voxel| f64::from(f32::from_ne_bytes(voxel))),
            StoredType::F64 => convert(voxels, f64::from_ne_bytes),
        }
    }
}

fn map<const N: usize>(voxels: &mut [u8], change: impl Fn([u8; N]) -> [u8; N]) {
    for voxel in voxels.as_chunks_mut::<N>().0 {
        *voxel = change(*voxel);
    }
}

fn convert<const N: usize>(voxels: &[u8], number: impl Fn([u8; N]) -> f64) -> Vec<f64> {
    voxels.as_chunks::<N>().0.iter().map(|&voxel| number(voxel)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn twelve_signed_bits_of_sixteen_are_masked_and_sign_extended() {
        let format = PixelFormat { stored_type: StoredType::I16, bits: BitField::low(12) };
        let mut voxels: Vec<u8> =
            [0x0FFF_u16, 0x0800, 0x07FF, 0xF123].into_iter().flat_map(u16::to_ne_bytes).collect();
        format.extract(format.bits, &mut voxels);
        assert_eq!(format.numbers(&voxels), [-1.0, -2048.0, 2047.0, 0x123 as f64]);
    }

    #[test]
    fn a_bit_field_high_in_the_voxel_is_shifted_down() {
        let format = PixelFormat { stored_type: StoredType::U16, bits: BitField { stored: 12, high: 15 } };
        let mut voxels = 0xABCD_u16.to_ne_bytes().to_vec();
        format.extract(format.bits, &mut voxels);
        assert_eq!(format.numbers(&voxels), [0xABC as f64]);
    }
}
