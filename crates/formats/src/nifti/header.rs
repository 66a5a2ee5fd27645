use glassbrick_volume::Endian;

const NIFTI1_BYTES: u64 = 348;
const NIFTI2_BYTES: u64 = 540;

/// What a NIfTI header says, of either version, as it stands there.
pub(crate) struct Header {
    pub endian: Endian,
    /// Size of the header itself: 348 for NIfTI-1, 540 for NIfTI-2.
    pub bytes: u64,
    /// Whether the voxels are in a file of their own.
    pub is_pair: bool,
    pub dim: [i64; 8],
    pub intent_code: i32,
    pub datatype: i16,
    pub pixdim: [f64; 8],
    pub vox_offset: f64,
    pub scl_slope: f64,
    pub scl_inter: f64,
    pub xyzt_units: i32,
    pub qform_code: i32,
    pub sform_code: i32,
    /// `quatern_b`, `quatern_c` and `quatern_d`.
    pub quaternion: [f64; 3],
    pub qoffset: [f64; 3],
    /// `srow_x`, `srow_y` and `srow_z`.
    pub srow: [[f64; 4]; 3],
}

/// Whether a file that starts so is NIfTI.
pub(crate) fn is_nifti(first: &[u8]) -> bool {
    version(first).is_some()
}

/// Whether a file that starts so may be Analyze 7.5, NIfTI's ancestor, which has no magic.
pub(crate) fn is_analyze(first: &[u8]) -> bool {
    let size = first.first_chunk().map(|&bytes| [i32::from_le_bytes(bytes), i32::from_be_bytes(bytes)]);
    first.len() >= NIFTI1_BYTES as usize && size.is_some_and(|size| size.contains(&348)) && !is_nifti(first)
}

/// The header's size, and whether the voxels are in a file of their own.
fn version(first: &[u8]) -> Option<(u64, bool)> {
    match (first.get(344..348), first.get(4..12)) {
        (Some(b"n+1\0"), _) => Some((NIFTI1_BYTES, false)),
        (Some(b"ni1\0"), _) => Some((NIFTI1_BYTES, true)),
        (_, Some(b"n+2\0\r\n\x1a\n")) => Some((NIFTI2_BYTES, false)),
        (_, Some(b"ni2\0\r\n\x1a\n")) => Some((NIFTI2_BYTES, true)),
        _ => None,
    }
}

impl Header {
    pub fn parse(first: &[u8]) -> Result<Self, String> {
        let (bytes, is_pair) = version(first).ok_or("has no NIfTI header")?;
        let Some(header) = first.get(..bytes as usize) else {
            return Err(format!("ends within its header of {bytes} bytes; it is cut short"));
        };
        let mut fields = Fields { bytes: header, endian: Endian::Little };
        if u64::from(fields.i32(0).unsigned_abs()) != bytes {
            fields.endian = Endian::Big;
        }
        if u64::from(fields.i32(0).unsigned_abs()) != bytes {
            return Err(format!("the field sizeof_hdr is {}; it must be {bytes}", fields.i32(0)));
        }
        Ok(if bytes == NIFTI1_BYTES { nifti1(&fields, is_pair) } else { nifti2(&fields, is_pair) })
    }

    /// The format's name.
    pub fn format_name(&self) -> &'static str {
        if self.bytes == NIFTI1_BYTES { "NIfTI-1" } else { "NIfTI-2" }
    }

    /// Voxels along each of the seven axes; those that are not used have one.
    pub fn sizes(&self) -> Result<[u64; 7], String> {
        let used = self.dim[0];
        if !(1..=7).contains(&used) {
            return Err(format!("the field dim[0] is {used}; it must be 1 to 7"));
        }
        let mut sizes = [1; 7];
        for (axis, axis_size) in sizes.iter_mut().enumerate().take(used as usize) {
            *axis_size = match self.dim[axis + 1] {
                size @ 1.. => size.unsigned_abs(),
                0 if axis > 2 => 1,
                size => return Err(format!("the field dim[{}] is {size}; there must be voxels", axis + 1)),
            };
        }
        Ok(sizes)
    }

    /// Where the voxels start in their file; `least` where the header says nothing.
    pub fn voxel_offset(&self, least: u64) -> Result<u64, String> {
        let offset = self.vox_offset;
        if offset == 0.0 {
            return Ok(least);
        }
        if offset.fract() != 0.0 || !(least as f64..=9e15).contains(&offset) {
            return Err(format!("the field vox_offset is {offset}; the voxels cannot start there"));
        }
        Ok(offset as u64)
    }
}

/// Numbers in a header by their offset. Offsets are constants below, within the header's checked size.
struct Fields<'a> {
    bytes: &'a [u8],
    endian: Endian,
}

impl Fields<'_> {
    fn take<const N: usize>(&self, offset: usize) -> [u8; N] {
        let mut taken: [u8; N] = std::array::from_fn(|byte| self.bytes[offset + byte]);
        if self.endian == Endian::Big {
            taken.reverse();
        }
        taken
    }

    fn i16(&self, offset: usize) -> i16 {
        i16::from_le_bytes(self.take(offset))
    }

    fn i32(&self, offset: usize) -> i32 {
        i32::from_le_bytes(self.take(offset))
    }

    fn i64(&self, offset: usize) -> i64 {
        i64::from_le_bytes(self.take(offset))
    }

    fn f32(&self, offset: usize) -> f64 {
        f64::from(f32::from_le_bytes(self.take(offset)))
    }

    fn f64(&self, offset: usize) -> f64 {
        f64::from_le_bytes(self.take(offset))
    }
}

fn nifti1(fields: &Fields<'_>, is_pair: bool) -> Header {
    Header {
        endian: fields.endian,
        bytes: NIFTI1_BYTES,
        is_pair,
        dim: std::array::from_fn(|axis| fields.i16(40 + 2 * axis).into()),
        intent_code: fields.i16(68).into(),
        datatype: fields.i16(70),
        pixdim: std::array::from_fn(|axis| fields.f32(76 + 4 * axis)),
        vox_offset: fields.f32(108),
        scl_slope: fields.f32(112),
        scl_inter: fields.f32(116),
        xyzt_units: fields.bytes[123].into(),
        qform_code: fields.i16(252).into(),
        sform_code: fields.i16(254).into(),
        quaternion: std::array::from_fn(|part| fields.f32(256 + 4 * part)),
        qoffset: std::array::from_fn(|part| fields.f32(268 + 4 * part)),
        srow: std::array::from_fn(|row| std::array::from_fn(|part| fields.f32(280 + 16 * row + 4 * part))),
    }
}

fn nifti2(fields: &Fields<'_>, is_pair: bool) -> Header {
    Header {
        endian: fields.endian,
        bytes: NIFTI2_BYTES,
        is_pair,
        dim: std::array::from_fn(|axis| fields.i64(16 + 8 * axis)),
        intent_code: fields.i32(504),
        datatype: fields.i16(12),
        pixdim: std::array::from_fn(|axis| fields.f64(104 + 8 * axis)),
        vox_offset: fields.i64(168) as f64,
        scl_slope: fields.f64(176),
        scl_inter: fields.f64(184),
        xyzt_units: fields.i32(500),
        qform_code: fields.i32(344),
        sform_code: fields.i32(348),
        quaternion: std::array::from_fn(|part| fields.f64(352 + 8 * part)),
        qoffset: std::array::from_fn(|part| fields.f64(376 + 8 * part)),
        srow: std::array::from_fn(|row| std::array::from_fn(|part| fields.f64(400 + 32 * row + 8 * part))),
    }
}
