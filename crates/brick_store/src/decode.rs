use glassbrick_volume::{Brick, BrickCells, BrickLayout, Endian, StoredType, Voxels};

/// A type that voxels are kept in memory in.
pub trait Kept: bytemuck::Pod + Default + PartialOrd + Send + Sync {
    /// Bounds that every voxel narrows: larger and smaller than all.
    const ABOVE_ALL: Self;
    const BELOW_ALL: Self;
    const IS_INTEGER: bool;

    fn to_f32(self) -> f32;
    /// Exact for whole numbers of up to 16 bits.
    fn to_i32(self) -> i32;
    fn into_voxels(voxels: Vec<Self>) -> Voxels;

    fn least(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    fn most(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

macro_rules! kept {
    ($($kept:ty => $variant:ident, $integer:literal, $below:expr, $above:expr;)*) => {$(
        impl Kept for $kept {
            const ABOVE_ALL: Self = $above;
            const BELOW_ALL: Self = $below;
            const IS_INTEGER: bool = $integer;

            fn to_f32(self) -> f32 {
                f32::from(self)
            }

            fn to_i32(self) -> i32 {
                self as i32
            }

            fn into_voxels(voxels: Vec<Self>) -> Voxels {
                Voxels::$variant(voxels)
            }
        }
    )*};
}

kept! {
    u8 => U8, true, u8::MIN, u8::MAX;
    i8 => I8, true, i8::MIN, i8::MAX;
    u16 => U16, true, u16::MIN, u16::MAX;
    i16 => I16, true, i16::MIN, i16::MAX;
    f32 => F32, false, f32::NEG_INFINITY, f32::INFINITY;
}

/// How stored bytes become kept voxels; those that are kept as they are stored are copied as bytes.
pub trait Stored: Send + Sync + 'static {
    type Kept: Kept;
    const BYTES: usize;
    /// Whether `f32` kept voxels came from whole numbers.
    const WHOLE_NUMBERS: bool;

    /// Decodes as many voxels as both slices hold.
    fn decode(stored: &[u8], kept: &mut [Self::Kept]);

    /// How many voxels are not finite; `decode` makes them 0.
    fn count_not_finite(stored: &[u8]) -> u64;
}

macro_rules! stored {
    ($($name:ident: $stored:ty, $from_bytes:ident => $kept:ty, $keep:expr, $whole:literal, $as_stored:expr;)*) => {$(
        pub struct $name;

        impl Stored for $name {
            type Kept = $kept;
            const BYTES: usize = size_of::<$stored>();
            const WHOLE_NUMBERS: bool = $whole;

            #[inline(always)]
            fn decode(stored: &[u8], kept: &mut [$kept]) {
                if $as_stored {
                    let kept: &mut [u8] = bytemuck::cast_slice_mut(kept);
                    let len = kept.len().min(stored.len());
                    kept[..len].copy_from_slice(&stored[..len]);
                    return;
                }
                let (voxels, _) = stored.as_chunks::<{ size_of::<$stored>() }>();
                let keep: fn($stored) -> $kept = $keep;
                for (kept, bytes) in kept.iter_mut().zip(voxels) {
                    *kept = keep(<$stored>::$from_bytes(*bytes));
                }
            }

            #[inline(always)]
            fn count_not_finite(stored: &[u8]) -> u64 {
                if $whole {
                    return 0;
                }
                let (voxels, _) = stored.as_chunks::<{ size_of::<$stored>() }>();
                voxels.iter().filter(|bytes| !(<$stored>::$from_bytes(**bytes) as f32).is_finite()).count() as u64
            }
        }
    )*};
}

fn finite_or_zero(value: f32) -> f32 {
    if value.is_finite() { value } else { 0.0 }
}

stored! {
    StoredU8: u8, from_ne_bytes => u8, |v| v, true, true;
    StoredI8: i8, from_ne_bytes => i8, |v| v, true, true;
    LittleU16: u16, from_le_bytes => u16, |v| v, true, cfg!(target_endian = "little");
    LittleI16: i16, from_le_bytes => i16, |v| v, true, cfg!(target_endian = "little");
    LittleU32: u32, from_le_bytes => f32, |v| v as f32, true, false;
    LittleI32: i32, from_le_bytes => f32, |v| v as f32, true, false;
    LittleF32: f32, from_le_bytes => f32, finite_or_zero, false, false;
    LittleF64: f64, from_le_bytes => f32, |v| finite_or_zero(v as f32), false, false;
    BigU16: u16, from_be_bytes => u16, |v| v, true, cfg!(target_endian = "big");
    BigI16: i16, from_be_bytes => i16, |v| v, true, cfg!(target_endian = "big");
    BigU32: u32, from_be_bytes => f32, |v| v as f32, true, false;
    BigI32: i32, from_be_bytes => f32, |v| v as f32, true, false;
    BigF32: f32, from_be_bytes => f32, finite_or_zero, false, false;
    BigF64: f64, from_be_bytes => f32, |v| finite_or_zero(v as f32), false, false;
}

/// Calls a generic function with the [`Stored`] of a stored type and byte order.
macro_rules! with_stored {
    ($stored_type:expr, $endian:expr, $function:ident($($argument:expr),*)) => {{
        use glassbrick_volume::{Endian as E, StoredType as T};
        use $crate::decode as d;
        match ($stored_type, $endian) {
            (T::U8, _) => $function::<d::StoredU8>($($argument),*),
            (T::I8, _) => $function::<d::StoredI8>($($argument),*),
            (T::U16, E::Little) => $function::<d::LittleU16>($($argument),*),
            (T::I16, E::Little) => $function::<d::LittleI16>($($argument),*),
            (T::U32, E::Little) => $function::<d::LittleU32>($($argument),*),
            (T::I32, E::Little) => $function::<d::LittleI32>($($argument),*),
            (T::F32, E::Little) => $function::<d::LittleF32>($($argument),*),
            (T::F64, E::Little) => $function::<d::LittleF64>($($argument),*),
            (T::U16, E::Big) => $function::<d::BigU16>($($argument),*),
            (T::I16, E::Big) => $function::<d::BigI16>($($argument),*),
            (T::U32, E::Big) => $function::<d::BigU32>($($argument),*),
            (T::I32, E::Big) => $function::<d::BigI32>($($argument),*),
            (T::F32, E::Big) => $function::<d::BigF32>($($argument),*),
            (T::F64, E::Big) => $function::<d::BigF64>($($argument),*),
        }
    }};
}
pub(crate) use with_stored;

/// Size in memory of a brick of kept voxels, cells included.
pub fn brick_bytes(stored_type: StoredType, layout: BrickLayout) -> u64 {
    fn kept_bytes<S: Stored>() -> usize {
        size_of::<S::Kept>()
    }
    let bytes = with_stored!(stored_type, Endian::NATIVE, kept_bytes());
    ((layout.voxels() + Brick::PADDING) * bytes + BrickCells::bytes(layout.edge)) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_byte_orders_give_the_same_voxels() {
        let mut kept = [0i16; 2];
        LittleI16::decode(&[0x18, 0xFC, 0x01, 0x00], &mut kept);
        assert_eq!(kept, [-1000, 1]);
        BigI16::decode(&[0xFC, 0x18, 0x00, 0x01], &mut kept);
        assert_eq!(kept, [-1000, 1]);
    }

    #[test]
    fn what_is_not_finite_is_zero_and_counted() {
        let stored: Vec<u8> =
            [f64::NAN, 2.5, f64::INFINITY, 1e300].iter().flat_map(|v| v.to_le_bytes()).collect();
        let mut kept = [9.0; 4];
        LittleF64::decode(&stored, &mut kept);
        assert_eq!(kept, [0.0, 2.5, 0.0, 0.0]);
        assert_eq!(LittleF64::count_not_finite(&stored), 3);
    }
}
