use std::path::Path;

use anyhow::bail;
use glassbrick::{
    Mode, PRESETS, Preset, TransferFunction, Volume, auto_transfer_function, read_transfer_function,
};

/// A transfer function, as far as it can be known without the volume.
pub enum TransferFunctionChoice {
    /// Made from the volume's histogram.
    Auto,
    Preset(&'static Preset),
    File(TransferFunction),
}

impl TransferFunctionChoice {
    /// What `--tf` names: `auto`, a preset, or a file, which is read.
    ///
    /// # Errors
    /// When it is neither, or the file says something else.
    pub fn new(name: &str) -> anyhow::Result<Self> {
        if name == "auto" {
            return Ok(Self::Auto);
        }
        if let Some(preset) = PRESETS.iter().find(|preset| preset.name == name) {
            return Ok(Self::Preset(preset));
        }
        let path = Path::new(name);
        if !path.exists() {
            let presets: Vec<_> = PRESETS.iter().map(|preset| preset.name).collect();
            bail!("--tf {name}: there is no such file, and the presets are auto, {}", presets.join(", "));
        }
        Ok(Self::File(read_transfer_function(path)?))
    }

    /// The transfer function for a volume, to be drawn in a mode.
    ///
    /// # Errors
    /// When its voxels cannot be read.
    pub fn for_volume(&self, volume: &Volume, mode: Mode) -> Result<TransferFunction, glassbrick::Error> {
        Ok(match self {
            Self::Auto => auto_transfer_function(&volume.histogram()?, volume.desc(), mode),
            Self::Preset(preset) if preset.is_relative() => {
                preset.transfer_function(volume.histogram()?.typical_range())
            }
            Self::Preset(preset) => preset.transfer_function(volume.value_range()),
            Self::File(function) => function.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart() {
        assert!(matches!(TransferFunctionChoice::new("auto"), Ok(TransferFunctionChoice::Auto)));
        for preset in &PRESETS {
            assert!(matches!(
                TransferFunctionChoice::new(preset.name),
                Ok(TransferFunctionChoice::Preset(_))
            ));
        }
    }

    #[test]
    fn an_unknown_name_is_told_the_presets() {
        let error = TransferFunctionChoice::new("no-such").err().expect("refused").to_string();
        assert!(error.contains("--tf no-such") && error.contains(PRESETS[0].name), "{error}");
    }
}
