use glassbrick_volume::{BAKED_ENTRIES, BakedTransferFunction, Rescale};

use super::brick::lerp;
use super::lanes::Lanes;

/// A baked transfer function as vectors of stored values look it up.
pub struct LaneLookUp<'a> {
    first_stored: f32,
    /// In two parts, of which the second is what the first was rounded by.
    entries_per_stored: [f32; 2],
    extinction: &'a [f32],
    /// Red, green and blue of each entry.
    color: &'a [f32],
    /// Extinction is zero at and outside these entries, which may lie beyond the ends.
    shown: [f32; 2],
}

/// Places between two entries.
pub struct LaneEntry<L: Lanes> {
    at: L::F,
}

impl<'a> LaneLookUp<'a> {
    pub fn new(baked: &'a BakedTransferFunction, rescale: Rescale) -> Self {
        let (extinction, color) = (baked.extinction.as_slice(), baked.color.as_flattened());
        assert!(extinction.len() == BAKED_ENTRIES && color.len() == 3 * BAKED_ENTRIES);
        let exact = baked.entries_per_value() * rescale.slope;
        let entries_per_stored = [exact as f32, (exact - f64::from(exact as f32)) as f32];
        let first = extinction.iter().position(|&sigma| sigma > 0.0).unwrap_or(BAKED_ENTRIES) as f32;
        let last = extinction.iter().rposition(|&sigma| sigma > 0.0).map_or(-1.0, |last| last as f32);
        Self {
            first_stored: rescale.stored(baked.first_value) as f32,
            entries_per_stored,
            extinction,
            color,
            shown: [first - 1.0, last + 1.0],
        }
    }

    #[inline(always)]
    pub fn entry<L: Lanes>(&self, stored: L::F) -> LaneEntry<L> {
        // Rounded once, so that a value at which an entry stands meets that entry exactly: where a band ends there, such
        // values are not seen.
        let above = L::sub(stored, L::splat(self.first_stored));
        let [scale, rest] = self.entries_per_stored;
        let at = L::fused_mul_add(above, L::splat(scale), L::mul(above, L::splat(rest)));
        LaneEntry { at: L::min(L::max(at, L::splat(0.0)), L::splat((BAKED_ENTRIES - 1) as f32)) }
    }

    /// The entries at which extinction may be above zero.
    #[inline(always)]
    pub fn may_show<L: Lanes>(&self, entry: &LaneEntry<L>) -> L::M {
        L::both(L::gt(entry.at, L::splat(self.shown[0])), L::lt(entry.at, L::splat(self.shown[1])))
    }

    /// Extinction per mm.
    #[inline(always)]
    pub fn extinction<L: Lanes>(&self, entry: &LaneEntry<L>) -> L::F {
        let (floor, fraction) = split::<L>(entry);
        let index = L::to_i(floor);
        // SAFETY: the index and the next are entries.
        let (a, b) = unsafe {
            let column = self.extinction.as_ptr();
            (L::gather(column, index), L::gather(column.add(1), index))
        };
        lerp::<L>(a, b, fraction)
    }

    /// Red, green and blue in linear light.
    #[inline(always)]
    pub fn color<L: Lanes>(&self, entry: &LaneEntry<L>) -> [L::F; 3] {
        let (floor, fraction) = split::<L>(entry);
        let index = L::to_i(L::mul(floor, L::splat(3.0)));
        let mut color = [fraction; 3];
        for (component, mixed) in color.iter_mut().enumerate() {
            // SAFETY: the index is three times an entry, and another entry follows.
            let (a, b) = unsafe {
                let column = self.color.as_ptr().add(component);
                (L::gather(column, index), L::gather(column.add(3), index))
            };
            *mixed = lerp::<L>(a, b, fraction);
        }
        color
    }
}

/// The entry before a place, never the last, and the fraction behind it.
#[inline(always)]
fn split<L: Lanes>(entry: &LaneEntry<L>) -> (L::F, L::F) {
    let floor = L::min(L::floor(entry.at), L::splat((BAKED_ENTRIES - 2) as f32));
    (floor, L::sub(entry.at, floor))
}
