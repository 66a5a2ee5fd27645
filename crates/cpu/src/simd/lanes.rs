//! Vectors of rays: what kernels need of a set of instructions.

/// Lanes of `f32` and `i32` that go through the same steps together.
///
/// # Safety
/// The methods may use instructions that only some processors have. A type that implements this must only be used
/// where the processor was seen to have them.
pub unsafe trait Lanes: Copy {
    /// Rays that go together.
    const COUNT: usize;

    type F: Copy;
    type I: Copy;
    type M: Copy;

    fn splat(x: f32) -> Self::F;
    fn splat_i(x: i32) -> Self::I;
    /// Reads the first `COUNT` elements.
    fn load(from: &[f32]) -> Self::F;
    fn load_i(from: &[i32]) -> Self::I;
    /// Writes the first `COUNT` elements.
    fn store(x: Self::F, to: &mut [f32]);
    fn store_i(x: Self::I, to: &mut [i32]);

    fn add(a: Self::F, b: Self::F) -> Self::F;
    fn sub(a: Self::F, b: Self::F) -> Self::F;
    fn mul(a: Self::F, b: Self::F) -> Self::F;
    fn div(a: Self::F, b: Self::F) -> Self::F;
    /// a · b + c, rounded once or twice.
    fn mul_add(a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    /// a · b + c, rounded as if once.
    fn fused_mul_add(a: Self::F, b: Self::F, c: Self::F) -> Self::F;
    fn min(a: Self::F, b: Self::F) -> Self::F;
    fn max(a: Self::F, b: Self::F) -> Self::F;
    fn abs(a: Self::F) -> Self::F;
    fn sqrt(a: Self::F) -> Self::F;
    /// ⌊a⌋ for |a| below 2²².
    fn floor(a: Self::F) -> Self::F;
    /// Of whole numbers below 2²⁴.
    fn to_i(a: Self::F) -> Self::I;
    fn to_f(a: Self::I) -> Self::F;
    fn bits(a: Self::F) -> Self::I;
    fn from_bits(a: Self::I) -> Self::F;

    fn add_i(a: Self::I, b: Self::I) -> Self::I;
    fn and_i(a: Self::I, b: Self::I) -> Self::I;
    fn shift_left<const BITS: u32>(a: Self::I) -> Self::I;
    /// Keeps the sign.
    fn shift_right<const BITS: u32>(a: Self::I) -> Self::I;

    fn lt(a: Self::F, b: Self::F) -> Self::M;
    fn ge(a: Self::F, b: Self::F) -> Self::M;
    fn gt(a: Self::F, b: Self::F) -> Self::M;
    fn gt_i(a: Self::I, b: Self::I) -> Self::M;
    fn both(a: Self::M, b: Self::M) -> Self::M;
    fn either(a: Self::M, b: Self::M) -> Self::M;
    /// a, and not b.
    fn but_not(a: Self::M, b: Self::M) -> Self::M;
    /// The lanes whose bits are set.
    fn mask(bits: u32) -> Self::M;
    fn mask_bits(m: Self::M) -> u32;
    /// `yes` where the mask is set, `no` elsewhere.
    fn select(m: Self::M, yes: Self::F, no: Self::F) -> Self::F;
    fn select_i(m: Self::M, yes: Self::I, no: Self::I) -> Self::I;

    /// Whether any lane is set.
    #[inline(always)]
    fn any(m: Self::M) -> bool {
        Self::mask_bits(m) != 0
    }

    /// Reads four bytes at each byte offset, aligned or not.
    ///
    /// # Safety
    /// Four bytes must lie behind each offset.
    unsafe fn gather_bytes(base: *const u8, offsets: Self::I) -> Self::I;

    /// Reads the `f32` of each index.
    ///
    /// # Safety
    /// Each index must lie in the array.
    unsafe fn gather(base: *const f32, indices: Self::I) -> Self::F;

    /// Between each entry and the next, by a fraction: a + t·(b − a) of each of the four columns. Of lanes that are not
    /// asked for, what the table has between some entries.
    ///
    /// # Safety
    /// Each entry and the next must lie in the table.
    #[inline(always)]
    unsafe fn between(
        table: *const [f32; 4],
        entries: Self::I,
        fraction: Self::F,
        _asked: Self::M,
    ) -> [Self::F; 4] {
        let mut mixed = [fraction; 4];
        let first = Self::shift_left::<2>(entries);
        for column in 0..4 {
            // SAFETY: the caller's promise.
            let (a, b) = unsafe {
                let base = table.cast::<f32>().add(column);
                (Self::gather(base, first), Self::gather(base.add(4), first))
            };
            mixed[column] = Self::mul_add(fraction, Self::sub(b, a), a);
        }
        mixed
    }
}

/// Sixteen lanes that can pick from rows of cells and voxels without a gather.
///
/// # Safety
/// As of [`Lanes`].
pub unsafe trait RowLanes: Lanes {
    /// Whether the bit at each place, below 8, is set.
    fn bits_at(bits: u8, places: Self::I) -> Self::M;

    /// The element at each place of a row of 16 or fewer; anything for places beyond.
    fn pick(row: &[f32], places: Self::I) -> Self::F;
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "x86_64")]
    use super::super::instruction_set::InstructionSet;
    use super::super::portable::Portable;
    use super::*;

    const TABLE: usize = 40;

    /// Looks up entry `7 · lane mod 39` and a sixteenth further each lane, some lanes at a time.
    fn check_between<L: Lanes>() {
        let table: [[f32; 4]; TABLE] =
            std::array::from_fn(|entry| [1, 3, 5, 7].map(|column| (entry * entry * column) as f32));
        let entries: [usize; 16] = std::array::from_fn(|lane| lane * 7 % (TABLE - 1));
        let fractions: [f32; 16] = std::array::from_fn(|lane| lane as f32 / 16.0);
        for asked in [0x0001, 0x8080, 0x0810, 0x1248, 0xF0F0, 0x8421, 0x001F, 0x5555, 0xFFFF] {
            let at = L::load_i(&entries.map(|entry| entry as i32));
            // SAFETY: each entry and the next lie in the table.
            let columns = unsafe { L::between(table.as_ptr(), at, L::load(&fractions), L::mask(asked)) };
            for (column, &mixed) in columns.iter().enumerate() {
                let mut lanes = [0.0; 16];
                L::store(mixed, &mut lanes);
                for lane in (0..L::COUNT).filter(|lane| asked >> lane & 1 == 1) {
                    let [a, b] = [entries[lane], entries[lane] + 1].map(|entry| table[entry][column]);
                    // All numbers here are exact.
                    let expected = a + fractions[lane] * (b - a);
                    assert_eq!(lanes[lane], expected, "{asked:x}, lane {lane}, column {column}");
                }
            }
        }
    }

    #[test]
    fn each_lane_that_is_asked_for_is_between_its_entries() {
        check_between::<Portable>();
        #[cfg(target_arch = "x86_64")]
        for set in InstructionSet::ALL.into_iter().filter(|set| set.is_available()) {
            match set {
                InstructionSet::Avx2 => check_between::<super::super::avx2::Avx2>(),
                InstructionSet::Avx512 => check_between::<super::super::avx512::Avx512>(),
                InstructionSet::Scalar | InstructionSet::Portable => {}
            }
        }
    }
}
