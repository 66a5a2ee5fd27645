//! Usage errors, each in one line that names the flag, what is allowed, and where to read more.

use std::ffi::OsString;

/// Flags that do not go together, though each alone is sound.
#[derive(Debug)]
pub struct UsageError(pub String);

impl std::fmt::Display for UsageError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for UsageError {}

/// Where the help for a command line is.
pub fn see_help(words: &[OsString]) -> String {
    let command = words.iter().skip(1).filter_map(|word| word.to_str()).find(|word| !word.starts_with('-'));
    match command {
        Some(command @ ("info" | "ingest" | "verify" | "render" | "bench" | "demo")) => {
            format!("see glassbrick {command} --help")
        }
        _ => "see glassbrick --help".to_owned(),
    }
}

/// What clap says over several lines, as one, without its usage and its pointers to the help.
pub fn condensed(clap_message: &str) -> String {
    let message = clap_message.trim_start();
    let message = message.strip_prefix("error: ").unwrap_or(message);
    let mut condensed = String::new();
    for line in message.lines().map(str::trim).filter(|line| !line.is_empty()) {
        if line.starts_with("Usage: ") || line.starts_with("For more information") {
            break;
        }
        if line.starts_with("tip: ") && !line.contains("similar") {
            continue;
        }
        let joint = if condensed.is_empty() {
            ""
        } else if line.starts_with("tip: ") {
            "; "
        } else if condensed.ends_with(':') || line.starts_with('[') {
            " "
        } else {
            ", "
        };
        condensed.push_str(joint);
        condensed.push_str(line);
    }
    condensed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Cli;
    use clap::Parser;

    fn message(line: &str) -> String {
        let error = Cli::try_parse_from(line.split(' ')).err().expect("refused");
        condensed(&error.render().to_string())
    }

    #[test]
    fn clap_is_content_with_the_definitions() {
        use clap::CommandFactory;
        Cli::command().debug_assert();
    }

    #[test]
    fn every_usage_error_is_one_line_that_names_the_flag() {
        for (line, words) in [
            ("glassbrick render a.nrrd", "--output <OUT>"),
            ("glassbrick render a.nrrd -o b.png --mode xray", "[possible values: dvr, mip, minip, mean]"),
            ("glassbrick render a.nrrd -o b.png --size 12", "such as 640x480"),
            ("glassbrick render a.nrrd -o b.png --step -1", "'--step <VOXELS>': a number above 0"),
            ("glassbrick render a.nrrd -o b.png --view front --azimuth -3", "cannot be used with"),
            ("glassbrick render a.nrrd -o b.png --camera c --eye 1,2,3 --target 0,0,0", "'--camera <FILE>'"),
            ("glassbrick render a.nrrd -o b.png --eye 1,2,3", "--target <X,Y,Z>"),
            ("glassbrick render a.nrrd -o b.png --fov 20", "--eye <X,Y,Z>"),
            ("glassbrick render a.nrrd -o b.png --extent 1x2x3", "--dtype <TYPE>"),
            ("glassbrick render a.nrrd -o b.png --endian big", "--extent <NXxNYxNZ>"),
            ("glassbrick render a.nrrd -o b.png --memory -1", "KiB"),
            ("glassbrick render a.nrrd -o b.png --frams 3", "similar argument exists: '--frames'"),
            ("glassbrick render a.nrrd -o b.png --threads 0", "1..=1024"),
            ("glassbrick ingest a.nrrd", "--output <STORE>"),
            ("glassbrick ingest a.nrrd -o a.zarr --codec gzip", "[possible values: none, lz4, zstd]"),
            ("glassbrick ingest a.nrrd -o a.zarr --halo 1", "2..=64"),
            ("glassbrick verify", "<STORE>"),
            ("glassbrick paint a.nrrd", "unrecognized subcommand 'paint'"),
            ("glassbrick", "requires a subcommand"),
        ] {
            let message = message(line);
            assert!(message.contains(words), "{line}: {message}");
            assert!(!message.contains("Usage:") && !message.contains("For more"), "{message}");
            assert_eq!(message.lines().count(), 1, "{message}");
        }
    }

    #[test]
    fn numbers_below_zero_are_values_not_flags() {
        let line = "glassbrick render a.nrrd -o b.png --eye -10,0,5 --target -1,-2,-3 --up 0,0,-1";
        assert!(Cli::try_parse_from(line.split(' ')).is_ok());
        let line = "glassbrick render a.nrrd -o b.png --azimuth -30 --elevation -12.5 --extent 1x1x1 --dtype u8 --rescale -1,-1024";
        assert!(Cli::try_parse_from(line.split(' ')).is_ok());
    }

    #[test]
    fn the_help_is_that_of_the_command() {
        let words = |line: &str| line.split(' ').map(OsString::from).collect::<Vec<_>>();
        assert_eq!(see_help(&words("glassbrick render -x")), "see glassbrick render --help");
        assert_eq!(see_help(&words("glassbrick -x info")), "see glassbrick info --help");
        assert_eq!(see_help(&words("glassbrick")), "see glassbrick --help");
    }
}
