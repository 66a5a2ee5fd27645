use glassbrick_volume::{BAKED_ENTRIES, BakedTransferFunction, Rescale};

/// A baked transfer function addressed by stored values.
pub struct LookUp<'a> {
    /// The stored value at which entry 0 stands.
    first_stored: f32,
    entries_per_stored: f64,
    baked: &'a BakedTransferFunction,
}

/// A place between two entries.
#[derive(Clone, Copy)]
pub struct Entry {
    index: usize,
    fraction: f32,
}

impl<'a> LookUp<'a> {
    pub fn new(baked: &'a BakedTransferFunction, rescale: Rescale) -> Self {
        Self {
            first_stored: rescale.stored(baked.first_value) as f32,
            entries_per_stored: baked.entries_per_value() * rescale.slope,
            baked,
        }
    }

    #[inline(always)]
    pub fn entry(&self, stored: f32) -> Entry {
        // Rounded once, so that a value at which an entry stands meets that entry exactly: where a band ends there, such
        // values are not seen.
        let at = (f64::from(stored - self.first_stored) * self.entries_per_stored) as f32;
        let at = at.max(0.0).min((BAKED_ENTRIES - 1) as f32);
        let index = (at as usize).min(BAKED_ENTRIES - 2);
        Entry { index, fraction: at - index as f32 }
    }

    /// Extinction per mm.
    #[inline(always)]
    pub fn extinction(&self, entry: Entry) -> f32 {
        between(&self.baked.extinction, entry)
    }

    /// Opacity per unit length.
    fn opacity(&self, entry: Entry) -> f32 {
        between(&self.baked.opacity, entry)
    }

    /// The pixel of a projected stored value: a(v)·c(v) with alpha a(v).
    pub fn projected(&self, stored: f32) -> [f32; 4] {
        let entry = self.entry(stored);
        let opacity = self.opacity(entry);
        let [r, g, b] = self.color(entry).map(|component| component * opacity);
        [r, g, b, opacity]
    }

    /// Linear light.
    #[inline(always)]
    pub fn color(&self, entry: Entry) -> [f32; 3] {
        let (a, b) = (self.baked.color[entry.index], self.baked.color[entry.index + 1]);
        std::array::from_fn(|c| a[c] + entry.fraction * (b[c] - a[c]))
    }
}

#[inline(always)]
fn between(column: &[f32], Entry { index, fraction }: Entry) -> f32 {
    column[index] + fraction * (column[index + 1] - column[index])
}
