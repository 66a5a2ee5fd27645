use glassbrick_volume::{BAKED_ENTRIES, BakedTransferFunction, Rescale};

use super::lanes::Lanes;

/// A baked transfer function as vectors of stored values look it up.
pub struct LaneLookUp {
    first_stored: f32,
    /// In two parts, of which the second is what the first was rounded by.
    entries_per_stored: [f32; 2],
    /// Red, green, blue and extinction of each entry.
    table: Vec<[f32; 4]>,
    /// Extinction is zero at and outside these entries, which may lie beyond the ends.
    shown: [f32; 2],
}

/// Places between two entries.
pub struct LaneEntry<L: Lanes> {
    at: L::F,
}

impl LaneLookUp {
    pub fn new(baked: &BakedTransferFunction, rescale: Rescale) -> Self {
        let extinction = baked.extinction.as_slice();
        let entries = baked.color.iter().zip(extinction);
        let table: Vec<[f32; 4]> = entries.map(|(&[r, g, b], &extinction)| [r, g, b, extinction]).collect();
        assert_eq!(table.len(), BAKED_ENTRIES);
        let exact = baked.entries_per_value() * rescale.slope;
        let entries_per_stored = [exact as f32, (exact - f64::from(exact as f32)) as f32];
        let first = extinction.iter().position(|&sigma| sigma > 0.0).unwrap_or(BAKED_ENTRIES) as f32;
        let last = extinction.iter().rposition(|&sigma| sigma > 0.0).map_or(-1.0, |last| last as f32);
        Self {
            first_stored: rescale.stored(baked.first_value) as f32,
            entries_per_stored,
            table,
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

    /// Red, green and blue in linear light, and extinction per mm, of some rays; of the others, those of some other value.
    #[inline(always)]
    pub fn light_and_extinction<L: Lanes>(&self, entry: &LaneEntry<L>, rays: L::M) -> [L::F; 4] {
        let (floor, fraction) = split::<L>(entry);
        // SAFETY: an entry, and not the last.
        unsafe { L::between(self.table.as_ptr(), L::to_i(floor), fraction, rays) }
    }
}

/// The entry before a place, never the last, and the fraction behind it.
#[inline(always)]
fn split<L: Lanes>(entry: &LaneEntry<L>) -> (L::F, L::F) {
    let floor = L::min(L::floor(entry.at), L::splat((BAKED_ENTRIES - 2) as f32));
    (floor, L::sub(entry.at, floor))
}
