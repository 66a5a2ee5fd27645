/// A point of a transfer function: colour and opacity at a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ControlPoint {
    pub value: f64,
    /// sRGB-encoded red, green and blue, 0 to 1.
    pub color: [f64; 3],
    /// Opacity per unit length, 0 to 1.
    pub opacity: f64,
}

/// Colour and opacity as a function of value: linear between the points, constant outside them.
///
/// Points of equal value make a step, at which the later holds.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFunction {
    /// At least one, sorted by value.
    pub points: Vec<ControlPoint>,
    /// The length that opacities are of, in mm; the volume's smallest spacing where there is none.
    pub unit_mm: Option<f64>,
}

/// Entries of a baked transfer function.
pub const BAKED_ENTRIES: usize = 1024;

/// Opacities are held below 1 by this much, so that extinction stays finite.
const MOST_OPACITY: f64 = 0.9999;

/// A transfer function as executors use it: columns of equally spaced entries, to be interpolated linearly.
///
/// Entry 0 stands at the first point's value, the last entry at the last point's; values outside clamp.
#[derive(Clone, Debug, PartialEq)]
pub struct BakedTransferFunction {
    pub first_value: f64,
    pub last_value: f64,
    /// σ = −ln(1 − opacity) / unit, per mm.
    pub extinction: Vec<f32>,
    /// Opacity per unit length.
    pub opacity: Vec<f32>,
    /// Red, green and blue in linear light.
    pub color: Vec<[f32; 3]>,
}

/// An open interval of values on which a transfer function shows something; infinite ends are unbounded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    pub low: f64,
    pub high: f64,
}

impl Band {
    /// Whether any value of the closed interval [min, max] lies in the band.
    pub fn meets(&self, min: f64, max: f64) -> bool {
        min < self.high && max > self.low
    }
}

impl TransferFunction {
    /// Colour (sRGB) and opacity at a value.
    pub fn at(&self, value: f64) -> ([f64; 3], f64) {
        let after = self.points.partition_point(|point| point.value <= value);
        let (Some(left), right) = (self.points.get(after.saturating_sub(1)), self.points.get(after)) else {
            return ([0.0; 3], 0.0);
        };
        let right = right.filter(|_| after > 0).unwrap_or(left);
        let width = right.value - left.value;
        let t = if width > 0.0 { (value - left.value) / width } else { 0.0 };
        let mix = |a: f64, b: f64| a + t * (b - a);
        let color = std::array::from_fn(|c| mix(left.color[c], right.color[c]));
        (color, mix(left.opacity, right.opacity))
    }

    /// Bakes the function for opacities per `unit_mm`, or per `smallest_spacing_mm` where the function names no unit.
    pub fn bake(&self, smallest_spacing_mm: f64) -> BakedTransferFunction {
        let unit_mm = self.unit_mm.unwrap_or(smallest_spacing_mm);
        let first_value = self.points.first().map_or(0.0, |point| point.value);
        let last_value = self.points.last().map_or(0.0, |point| point.value);
        let mut baked = BakedTransferFunction {
            first_value,
            last_value,
            extinction: Vec::with_capacity(BAKED_ENTRIES),
            opacity: Vec::with_capacity(BAKED_ENTRIES),
            color: Vec::with_capacity(BAKED_ENTRIES),
        };
        for entry in 0..BAKED_ENTRIES {
            let (color, opacity) = self.at(baked.entry_value(entry));
            baked.extinction.push((-(-opacity.min(MOST_OPACITY)).ln_1p() / unit_mm) as f32);
            baked.opacity.push(opacity as f32);
            baked.color.push(color.map(|c| srgb_decode(c) as f32));
        }
        baked
    }

    /// What a user should know of these points before trusting the picture: one sentence each.
    pub fn warnings(&self) -> Vec<String> {
        let (Some(first), Some(last)) = (self.points.first(), self.points.last()) else {
            return Vec::new();
        };
        let two_entries = 2.0 * (last.value - first.value) / (BAKED_ENTRIES - 1) as f64;
        let close = self
            .points
            .windows(2)
            .find(|pair| pair[0].value < pair[1].value && pair[1].value - pair[0].value < two_entries);
        close
            .map(|pair| {
                format!(
                    "the transfer function's points at {} and {} are closer than two of its {BAKED_ENTRIES} entries ({two_entries:.4}) and are drawn less steep than they are",
                    pair[0].value, pair[1].value
                )
            })
            .into_iter()
            .collect()
    }
}

impl BakedTransferFunction {
    /// The value at which an entry stands.
    pub fn entry_value(&self, entry: usize) -> f64 {
        if entry == BAKED_ENTRIES - 1 {
            return self.last_value;
        }
        self.first_value + (self.last_value - self.first_value) * entry as f64 / (BAKED_ENTRIES - 1) as f64
    }

    /// Entries per unit of value; 0 where the function is constant.
    pub fn entries_per_value(&self) -> f64 {
        let width = self.last_value - self.first_value;
        if width > 0.0 { (BAKED_ENTRIES - 1) as f64 / width } else { 0.0 }
    }

    /// The pixel of a projected value: a(v)·c(v) in linear light, with alpha a(v).
    pub fn projected(&self, value: f64) -> [f32; 4] {
        let last = (BAKED_ENTRIES - 1) as f64;
        let at = ((value - self.first_value) * self.entries_per_value()).clamp(0.0, last);
        let index = (at as usize).min(BAKED_ENTRIES - 2);
        let fraction = (at - index as f64) as f32;
        let mix = |a: f32, b: f32| a + fraction * (b - a);
        let opacity = mix(self.opacity[index], self.opacity[index + 1]);
        let [r, g, b] =
            std::array::from_fn(|c| opacity * mix(self.color[index][c], self.color[index + 1][c]));
        [r, g, b, opacity]
    }

    /// The maximal open intervals of value on which interpolated extinction is above zero, lowest first.
    pub fn bands(&self) -> Vec<Band> {
        let shown = |entry: usize| self.extinction[entry] > 0.0;
        let last = BAKED_ENTRIES - 1;
        if self.entries_per_value() == 0.0 {
            let everything = Band { low: f64::NEG_INFINITY, high: f64::INFINITY };
            return if shown(last) { vec![everything] } else { Vec::new() };
        }
        let mut bands = Vec::new();
        let mut entry = 0;
        while entry <= last {
            if !shown(entry) {
                entry += 1;
                continue;
            }
            let start = entry;
            while entry <= last && shown(entry) {
                entry += 1;
            }
            bands.push(Band {
                low: if start == 0 { f64::NEG_INFINITY } else { self.entry_value(start - 1) },
                high: if entry > last { f64::INFINITY } else { self.entry_value(entry) },
            });
        }
        bands
    }
}

/// The linear light of an sRGB-encoded component (IEC 61966-2-1).
pub fn srgb_decode(encoded: f64) -> f64 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// The sRGB encoding of a component in linear light (IEC 61966-2-1).
pub fn srgb_encode(linear: f64) -> f64 {
    if linear <= 0.003_130_8 { linear * 12.92 } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn opacities(points: &[(f64, f64)]) -> TransferFunction {
        let points =
            points.iter().map(|&(value, opacity)| ControlPoint { value, color: [1.0; 3], opacity }).collect();
        TransferFunction { points, unit_mm: None }
    }

    #[test]
    fn at_a_step_the_later_point_holds() {
        let step = opacities(&[(0.0, 0.1), (5.0, 0.1), (5.0, 0.7), (10.0, 0.7)]);
        assert_eq!(step.at(5.0).1, 0.7);
        assert_eq!(step.at(4.999_999).1, 0.1);
        assert_eq!(step.at(-3.0).1, 0.1);
        assert_eq!(step.at(30.0).1, 0.7);
    }

    #[test]
    fn one_value_is_constant_and_visible_everywhere() {
        let constant = opacities(&[(5.0, 0.2), (5.0, 0.4)]);
        let baked = constant.bake(1.0);
        assert!(baked.opacity.iter().all(|&opacity| opacity == 0.4));
        assert_eq!(baked.bands(), vec![Band { low: f64::NEG_INFINITY, high: f64::INFINITY }]);
        assert!(opacities(&[(5.0, 0.0)]).bake(1.0).bands().is_empty());
    }

    #[test]
    fn extinction_gives_back_the_opacity_over_its_unit() {
        let baked = opacities(&[(0.0, 0.3), (1.0, 1.0)]).bake(2.0);
        assert!((1.0 - (-f64::from(baked.extinction[0]) * 2.0).exp() - 0.3).abs() < 1e-6);
        assert!((f64::from(baked.extinction[1023]) - -(0.0001f64.ln()) / 2.0).abs() < 1e-5);
    }

    #[test]
    fn bands_reach_one_entry_beyond_what_is_opaque() {
        let baked =
            opacities(&[(0.0, 0.0), (300.0, 0.0), (600.0, 0.5), (900.0, 0.0), (1023.0, 0.0)]).bake(1.0);
        assert_eq!(baked.bands(), vec![Band { low: 300.0, high: 900.0 }]);
        let open_above = opacities(&[(0.0, 0.0), (1023.0, 0.5)]).bake(1.0);
        assert_eq!(open_above.bands(), vec![Band { low: 0.0, high: f64::INFINITY }]);
        let two = opacities(&[(0.0, 0.1), (100.0, 0.0), (200.0, 0.0), (1023.0, 0.5)]).bake(1.0);
        assert_eq!(two.bands().len(), 2);
        assert_eq!(two.bands()[0], Band { low: f64::NEG_INFINITY, high: 100.0 });
    }

    #[test]
    fn a_band_is_open() {
        let band = Band { low: 10.0, high: 20.0 };
        assert!(!band.meets(0.0, 10.0) && !band.meets(20.0, 30.0));
        assert!(band.meets(0.0, 30.0), "a brick with voxels below and above the band still shows it");
        assert!(band.meets(15.0, 15.0));
    }

    #[test]
    fn points_closer_than_two_entries_are_warned_of() {
        assert_eq!(opacities(&[(0.0, 0.0), (1.0, 0.0), (1.5, 1.0), (1000.0, 1.0)]).warnings().len(), 1);
        assert!(opacities(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (500.0, 1.0)]).warnings().is_empty());
    }

    #[test]
    fn srgb_goes_there_and_back() {
        for encoded in [0.0, 0.02, 0.04045, 0.2, 0.735, 1.0] {
            assert!((srgb_encode(srgb_decode(encoded)) - encoded).abs() < 1e-7);
        }
    }
}
