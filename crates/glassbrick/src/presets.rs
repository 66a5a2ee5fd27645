use glassbrick_volume::{ControlPoint, TransferFunction};

/// A transfer function that comes with glassbrick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    pub name: &'static str,
    /// What it shows, in one line.
    pub summary: &'static str,
    scale: Scale,
    points: &'static [Point],
}

/// What a preset's values mean.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scale {
    /// Hounsfield units, opacities per mm.
    Hounsfield,
    /// Fractions of the volume's range of values, opacities per smallest spacing.
    Relative,
}

/// Value, colour as 0xRRGGBB (sRGB), opacity.
type Point = (f64, u32, f64);

/// Every preset. Opacity is zero wherever a preset shows nothing, so that bricks of air, say, are empty.
pub const PRESETS: [Preset; 8] = [
    // Spongy bone from about 150 HU in the brown of marrow, then ivory, and enamel near white.
    Preset {
        name: "ct-bone",
        summary: "CT: bones and teeth, opaque, in ivory",
        scale: Scale::Hounsfield,
        points: &[
            (140.0, 0x6E3A28, 0.0),
            (260.0, 0xA9674A, 0.06),
            (450.0, 0xDDBB8E, 0.35),
            (900.0, 0xF1E3C6, 0.75),
            (1800.0, 0xFFFBF0, 0.95),
        ],
    },
    // Starts above foams and blankets, well below fat, so that the surface is closed.
    Preset {
        name: "ct-skin",
        summary: "CT: the body's surface, opaque, in skin tone",
        scale: Scale::Hounsfield,
        points: &[
            (-250.0, 0xB9806A, 0.0),
            (-50.0, 0xDDA78E, 0.6),
            (60.0, 0xE8B79C, 0.9),
            (250.0, 0xE6B89E, 0.95),
            (700.0, 0xF3E6CC, 0.95),
        ],
    },
    // Fat, at −100 HU, is left out; skin remains as a veil because it is as dense as muscle.
    Preset {
        name: "ct-muscle",
        summary: "CT: muscle and organs in red-brown over ivory bone, without fat",
        scale: Scale::Hounsfield,
        points: &[
            (-10.0, 0x6A1F1A, 0.0),
            (40.0, 0x8A332A, 0.12),
            (75.0, 0xAE4E42, 0.45),
            (140.0, 0xB65A4A, 0.5),
            (230.0, 0xC98A6C, 0.5),
            (450.0, 0xE6D2AE, 0.7),
            (1500.0, 0xFFFBF0, 0.95),
        ],
    },
    // Parenchyma around −850 HU as a bluish haze, the boundary of air and tissue as a rose shell.
    Preset {
        name: "ct-lung",
        summary: "CT: lungs and airways, see-through blue and rose, with every surface to air",
        scale: Scale::Hounsfield,
        points: &[
            (-930.0, 0x5B7FC7, 0.0),
            (-860.0, 0x7FA3E0, 0.003),
            (-720.0, 0xB4B4E2, 0.008),
            (-550.0, 0xE6A9B6, 0.05),
            (-400.0, 0xEFA3A0, 0.1),
            (-200.0, 0xF2B8A4, 0.02),
            (-50.0, 0xF2B8A4, 0.0),
        ],
    },
    // Contrast medium lies between 150 and 450 HU, where spongy bone is too: it reddens with the vessels.
    Preset {
        name: "ct-angio",
        summary: "CT with contrast medium: vessels in red beside ivory bone",
        scale: Scale::Hounsfield,
        points: &[
            (110.0, 0x6A0A0E, 0.0),
            (170.0, 0x8E1212, 0.04),
            (260.0, 0xC2211B, 0.3),
            (380.0, 0xDB4A36, 0.45),
            (520.0, 0xE3B28C, 0.5),
            (900.0, 0xF1E3C6, 0.75),
            (1800.0, 0xFFFBF0, 0.95),
        ],
    },
    Preset {
        name: "haze",
        summary: "CT: see-through, soft tissue as a haze around glowing bone",
        scale: Scale::Hounsfield,
        points: &[
            (-400.0, 0xCFE0F5, 0.0),
            (-150.0, 0xF0C8A8, 0.004),
            (60.0, 0xE8A080, 0.008),
            (180.0, 0xE9A888, 0.01),
            (350.0, 0xEAD9B8, 0.045),
            (1000.0, 0xFFF6E4, 0.14),
            (2000.0, 0xFFFFFF, 0.25),
        ],
    },
    Preset {
        name: "mr",
        summary: "MR: dark tissue see-through in brown, bright tissue denser and nearly white",
        scale: Scale::Relative,
        points: &[
            (0.1, 0x3A1E1A, 0.0),
            (0.25, 0x7A4A40, 0.02),
            (0.5, 0xB98C7C, 0.1),
            (0.75, 0xE2CDBB, 0.35),
            (1.0, 0xFFFAF0, 0.7),
        ],
    },
    Preset {
        name: "grey",
        summary: "anything: brighter and denser with the value, black and clear at the lowest",
        scale: Scale::Relative,
        points: &[(0.0, 0x000000, 0.0), (0.25, 0x404040, 0.01), (1.0, 0xFFFFFF, 0.3)],
    },
];

/// The preset of that name. CT presets are in Hounsfield units whatever the volume holds; the others stretch over
/// `value_range`, the values between which the volume's lie, rare outliers best left out.
pub fn preset(name: &str, value_range: [f64; 2]) -> Option<TransferFunction> {
    PRESETS.iter().find(|preset| preset.name == name).map(|preset| preset.transfer_function(value_range))
}

impl Preset {
    /// Whether it stretches over the volume's values, instead of standing at values of its own.
    pub fn is_relative(&self) -> bool {
        self.scale == Scale::Relative
    }

    /// The preset as a transfer function; see [`preset`].
    pub fn transfer_function(&self, value_range: [f64; 2]) -> TransferFunction {
        let [low, high] = widened(value_range);
        let points = self.points.iter().map(|&(value, color, opacity)| ControlPoint {
            value: match self.scale {
                Scale::Hounsfield => value,
                Scale::Relative => low * (1.0 - value) + high * value,
            },
            color: srgb(color),
            opacity,
        });
        let unit_mm = match self.scale {
            Scale::Hounsfield => Some(1.0),
            Scale::Relative => None,
        };
        TransferFunction { points: points.collect(), unit_mm }
    }
}

/// A range of one value, or none, made wide enough to stretch over.
fn widened([low, high]: [f64; 2]) -> [f64; 2] {
    match (low.is_finite(), high.is_finite()) {
        (true, true) if high > low => [low, high],
        (true, _) => [low, low + (low.abs() * 1e-6).max(1.0)],
        _ => [0.0, 1.0],
    }
}

fn srgb(rgb: u32) -> [f64; 3] {
    let [_, red, green, blue] = rgb.to_be_bytes();
    [red, green, blue].map(|code| f64::from(code) / 255.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_preset_is_a_sound_transfer_function() {
        for range in [[0.0, 255.0], [-1024.0, 3071.0], [-1e30, 1e30], [-1e-3, 2e-3]] {
            for known in &PRESETS {
                let function = preset(known.name, range).expect("it is listed");
                assert!(function.points.is_sorted_by(|a, b| a.value < b.value), "{}", known.name);
                assert_eq!(function.points[0].opacity, 0.0, "{}", known.name);
                for point in &function.points {
                    assert!(point.value.is_finite() && (0.0..=1.0).contains(&point.opacity));
                    assert!(point.color.iter().all(|channel| (0.0..=1.0).contains(channel)));
                }
            }
        }
    }

    #[test]
    fn no_two_points_of_a_preset_fall_into_two_entries_of_the_baked_table() {
        for known in &PRESETS {
            let points = known.transfer_function([0.0, 1.0]).points;
            let entry = (points[points.len() - 1].value - points[0].value) / 1023.0;
            assert!(points.windows(2).all(|pair| pair[1].value - pair[0].value > 2.0 * entry));
        }
    }

    #[test]
    fn ct_presets_are_in_hounsfield_units_whatever_the_range() {
        let bone = preset("ct-bone", [0.0, 1.0]).expect("it is listed");
        assert_eq!(bone, preset("ct-bone", [-5000.0, 9000.0]).expect("it is listed"));
        assert_eq!(bone.unit_mm, Some(1.0));
        assert_eq!(bone.at(60.0).1, 0.0, "soft tissue is clear");
        assert!(bone.at(1200.0).1 > 0.7, "cortical bone is opaque");
        let skin = preset("ct-skin", [0.0, 1.0]).expect("it is listed");
        assert_eq!(skin.at(-1000.0).1, 0.0, "air is clear");
        assert!(skin.at(-100.0).1 > 0.3, "fat closes the surface");
        assert_eq!(preset("ct-lung", [0.0, 1.0]).expect("it is listed").at(40.0).1, 0.0, "muscle is clear");
    }

    #[test]
    fn relative_presets_stretch_over_the_range() {
        let grey = preset("grey", [100.0, 300.0]).expect("it is listed");
        assert_eq!((grey.points[0].value, grey.points[2].value), (100.0, 300.0));
        assert_eq!(grey.unit_mm, None);
    }

    #[test]
    fn a_range_without_width_still_gives_a_ramp() {
        for range in [[7.0, 7.0], [1e20, 1e20], [3.0, 1.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
            let points = preset("mr", range).expect("it is listed").points;
            assert!(points.is_sorted_by(|a, b| a.value < b.value), "{range:?}");
        }
    }

    #[test]
    fn names_are_unique_and_summaries_one_line() {
        for (index, known) in PRESETS.iter().enumerate() {
            assert!(PRESETS[..index].iter().all(|earlier| earlier.name != known.name));
            assert!(!known.summary.contains('\n') && known.summary.len() < 90);
        }
        assert!(preset("rainbow", [0.0, 1.0]).is_none());
    }
}
