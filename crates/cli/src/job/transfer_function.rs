use std::path::Path;

use anyhow::bail;
use glassbrick::{PRESETS, TransferFunctionChoice, read_transfer_function};

/// What `--tf` names: `auto`, a preset, or a file, which is read.
///
/// # Errors
/// When it is neither, or the file says something else.
pub fn transfer_function_choice(name: &str) -> anyhow::Result<TransferFunctionChoice> {
    if let Some(choice) = TransferFunctionChoice::named(name) {
        return Ok(choice);
    }
    let path = Path::new(name);
    if !path.exists() {
        let presets: Vec<_> = PRESETS.iter().map(|preset| preset.name).collect();
        bail!("--tf {name}: there is no such file, and the presets are auto, {}", presets.join(", "));
    }
    Ok(TransferFunctionChoice::Exact(read_transfer_function(path)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unknown_name_is_told_the_presets() {
        let error = transfer_function_choice("no-such").expect_err("refused").to_string();
        assert!(error.contains("--tf no-such") && error.contains(PRESETS[0].name), "{error}");
    }
}
