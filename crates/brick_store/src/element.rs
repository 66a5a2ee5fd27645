use std::ops::{Add, AddAssign};

/// A stored type as a number of this machine, read from and written to little-endian bytes.
pub trait Element: Copy + PartialOrd + Send + Sync + 'static {
    const BYTES: usize;
    /// Bounds that every element narrows: larger and smaller than all.
    const ABOVE_ALL: Self;
    const BELOW_ALL: Self;
    /// What sums of elements are kept in.
    type Sum: Copy + Default + Add<Output = Self::Sum> + AddAssign;

    /// From exactly [`Self::BYTES`] bytes. What is not finite as `f32` is 0, as it is for every reader of voxels.
    fn read(stored: &[u8]) -> Self;

    /// To exactly [`Self::BYTES`] bytes.
    fn write(self, stored: &mut [u8]);

    fn to_sum(self) -> Self::Sum;

    /// The mean of `count` elements, a power of two; whole numbers are rounded half up.
    fn mean(sum: Self::Sum, count: u32) -> Self;
}

macro_rules! whole_numbers {
    ($($number:ty, $sum:ty;)*) => {$(
        impl Element for $number {
            const BYTES: usize = size_of::<$number>();
            const ABOVE_ALL: Self = <$number>::MAX;
            const BELOW_ALL: Self = <$number>::MIN;
            type Sum = $sum;

            #[inline(always)]
            fn read(stored: &[u8]) -> Self {
                <$number>::from_le_bytes(stored.try_into().expect("the caller gives as many bytes"))
            }

            #[inline(always)]
            fn write(self, stored: &mut [u8]) {
                stored.copy_from_slice(&self.to_le_bytes());
            }

            #[inline(always)]
            fn to_sum(self) -> $sum {
                <$sum>::from(self)
            }

            #[inline(always)]
            fn mean(sum: $sum, count: u32) -> Self {
                // An arithmetic shift rounds down. A mean lies between the least and the largest element.
                ((sum + (count / 2) as $sum) >> count.trailing_zeros()) as $number
            }
        }
    )*};
}

macro_rules! floats {
    ($($number:ty),*) => {$(
        impl Element for $number {
            const BYTES: usize = size_of::<$number>();
            const ABOVE_ALL: Self = <$number>::INFINITY;
            const BELOW_ALL: Self = <$number>::NEG_INFINITY;
            type Sum = f64;

            #[inline(always)]
            fn read(stored: &[u8]) -> Self {
                let number =
                    <$number>::from_le_bytes(stored.try_into().expect("the caller gives as many bytes"));
                if (number as f32).is_finite() { number } else { 0.0 }
            }

            #[inline(always)]
            fn write(self, stored: &mut [u8]) {
                stored.copy_from_slice(&self.to_le_bytes());
            }

            #[inline(always)]
            fn to_sum(self) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn mean(sum: f64, count: u32) -> Self {
                (sum / f64::from(count)) as $number
            }
        }
    )*};
}

whole_numbers!(u8, i32; i8, i32; u16, i32; i16, i32; u32, i64; i32, i64;);
floats!(f32, f64);

/// Calls a generic function with the [`Element`] of a stored type.
macro_rules! with_element {
    ($stored_type:expr, $function:ident($($argument:expr),*)) => {
        match $stored_type {
            glassbrick_volume::StoredType::U8 => $function::<u8>($($argument),*),
            glassbrick_volume::StoredType::I8 => $function::<i8>($($argument),*),
            glassbrick_volume::StoredType::U16 => $function::<u16>($($argument),*),
            glassbrick_volume::StoredType::I16 => $function::<i16>($($argument),*),
            glassbrick_volume::StoredType::U32 => $function::<u32>($($argument),*),
            glassbrick_volume::StoredType::I32 => $function::<i32>($($argument),*),
            glassbrick_volume::StoredType::F32 => $function::<f32>($($argument),*),
            glassbrick_volume::StoredType::F64 => $function::<f64>($($argument),*),
        }
    };
}
pub(crate) use with_element;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_means_are_rounded_half_up() {
        assert_eq!(u8::mean(3, 2), 2);
        assert_eq!(i16::mean(-3, 2), -1, "-1.5 is rounded up");
        assert_eq!(i16::mean(-5, 4), -1);
        assert_eq!(u32::mean(8 * i64::from(u32::MAX), 8), u32::MAX);
        assert_eq!(i32::mean(8 * i64::from(i32::MIN), 8), i32::MIN);
    }

    #[test]
    fn what_is_not_finite_is_zero() {
        assert_eq!(f32::read(&f32::NAN.to_le_bytes()), 0.0);
        assert_eq!(f64::read(&1e300f64.to_le_bytes()), 0.0, "it does not fit into f32");
        assert_eq!(f64::read(&(-2.5f64).to_le_bytes()), -2.5);
    }
}
