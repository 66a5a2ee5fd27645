use glassbrick_volume::{Mode, TransferFunction};

use crate::{Error, PRESETS, Preset, Volume, auto_transfer_function};

/// A transfer function, as far as it can be known without the volume.
#[derive(Clone, Debug, PartialEq)]
pub enum TransferFunctionChoice {
    /// Made from the volume's histogram.
    Auto,
    Preset(&'static Preset),
    /// Given as it is, by a file or otherwise.
    Exact(TransferFunction),
}

impl TransferFunctionChoice {
    /// The name of the choice that [`auto_transfer_function`] makes.
    pub const AUTO: &'static str = "auto";

    /// `auto` or a preset by name, if there is one.
    pub fn named(name: &str) -> Option<Self> {
        if name == Self::AUTO {
            return Some(Self::Auto);
        }
        PRESETS.iter().find(|preset| preset.name == name).map(Self::Preset)
    }

    /// The transfer function for a volume, to be drawn in a mode. Presets that stretch over values do so over those that
    /// are typical of it.
    ///
    /// # Errors
    /// When its voxels cannot be read.
    pub fn for_volume(&self, volume: &Volume, mode: Mode) -> Result<TransferFunction, Error> {
        Ok(match self {
            Self::Auto => auto_transfer_function(&volume.histogram()?, volume.desc(), mode),
            Self::Preset(preset) if preset.is_relative() => {
                preset.transfer_function(volume.histogram()?.typical_range())
            }
            Self::Preset(preset) => preset.transfer_function(volume.value_range()),
            Self::Exact(function) => function.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart() {
        assert_eq!(TransferFunctionChoice::named("auto"), Some(TransferFunctionChoice::Auto));
        for known in &PRESETS {
            let choice = TransferFunctionChoice::named(known.name);
            assert_eq!(choice, Some(TransferFunctionChoice::Preset(known)));
        }
        assert_eq!(TransferFunctionChoice::named("bone.json"), None);
    }
}
