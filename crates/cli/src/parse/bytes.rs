/// Units of 1000 and of 1024 bytes.
const UNITS: [(&str, u64); 6] = [
    ("kib", 1 << 10),
    ("mib", 1 << 20),
    ("gib", 1 << 30),
    ("kb", 1_000),
    ("mb", 1_000_000),
    ("gb", 1_000_000_000),
];

/// Reads a number of bytes: `4096`, or with KB, MB, GB (1000) or KiB, MiB, GiB (1024), then fractions too.
pub fn bytes(text: &str) -> Result<u64, String> {
    parse(text).ok_or_else(|| {
        "a whole number of bytes is wanted, or a number with KB, MB, GB (1000) or KiB, MiB, GiB (1024)"
            .to_owned()
    })
}

fn parse(text: &str) -> Option<u64> {
    let text = text.trim().to_ascii_lowercase();
    let found = UNITS.iter().find_map(|(name, unit)| Some((text.strip_suffix(name)?.trim_end(), *unit)));
    let (number, unit) = found.unwrap_or((&text, 1));
    if !number.starts_with(|first: char| first.is_ascii_digit()) {
        return None;
    }
    if let Ok(whole) = number.parse::<u64>() {
        return whole.checked_mul(unit);
    }
    let is_decimal = number.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.');
    let bytes = number.parse::<f64>().ok().filter(|_| is_decimal && unit > 1)? * unit as f64;
    // Every f64 below 2⁶⁴ is a u64 once rounded.
    (bytes < u64::MAX as f64).then(|| bytes.round() as u64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_1000_and_of_1024_are_told_apart() {
        for (text, expected) in [
            ("0", 0),
            ("4096", 4096),
            ("64KB", 64_000),
            ("64 KiB", 65_536),
            ("1MB", 1_000_000),
            ("512MiB", 536_870_912),
            ("1.5GB", 1_500_000_000),
            ("2gib", 2_147_483_648),
            ("18446744073709551615", u64::MAX),
        ] {
            assert_eq!(bytes(text), Ok(expected), "{text}");
        }
    }

    #[test]
    fn what_is_no_number_of_bytes_is_refused() {
        for text in ["", "MB", "-1", "1.5", "1e3", "1TB", "0x10", "+5", ".5MB", "1..5MB", "nanKB", "infGB"] {
            assert!(bytes(text).is_err(), "{text}");
        }
    }

    #[test]
    fn more_bytes_than_can_be_counted_are_refused() {
        for text in ["18446744073709551616", "18446744074GB", "99999999999999999999.5GiB"] {
            assert!(bytes(text).is_err(), "{text}");
        }
    }
}
