//! Numbers as people read them.

pub use glassbrick_benches::{aligned, count};

/// Significant digits of numbers whose exact value does not matter.
const DIGITS: i32 = 7;

/// A number with seven significant digits at most, without trailing zeros.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let magnitude = value.abs().log10().floor();
    if !(-5.0..15.0).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let decimals = (DIGITS - 1 - magnitude as i32).max(0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A number of bytes in units of 1000.
pub fn bytes(value: u64) -> String {
    for (unit, name) in [(1e9, "GB"), (1e6, "MB"), (1e3, "KB")] {
        if value as f64 >= unit {
            return format!("{:.1} {name}", value as f64 / unit);
        }
    }
    format!("{value} bytes")
}

/// A time that is given in milliseconds.
pub fn time(milliseconds: f64) -> String {
    if milliseconds < 1000.0 {
        format!("{milliseconds:.1} ms")
    } else {
        format!("{:.2} s", milliseconds / 1e3)
    }
}

/// A fraction in percent.
pub fn percent(fraction: f64) -> String {
    format!("{:.1} %", fraction * 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_right() {
        for (value, text) in [
            (0.0, "0"),
            (-1024.0, "-1024"),
            (0.976_562_5, "0.9765625"),
            (3071.0, "3071"),
            (1_234_567.0, "1234567"),
            (0.1 + 0.2, "0.3"),
            (-0.000_012_5, "-0.0000125"),
            (3.4e38, "3.40000e38"),
            (1e-9, "1.00000e-9"),
        ] {
            assert_eq!(number(value), text);
        }
    }

    #[test]
    fn counts_bytes_and_times_are_readable() {
        assert_eq!((count(7), count(1_558_802)), ("7".to_owned(), "1,558,802".to_owned()));
        assert_eq!((bytes(999), bytes(538_542_080)), ("999 bytes".to_owned(), "538.5 MB".to_owned()));
        assert_eq!((time(12.34), time(2500.0)), ("12.3 ms".to_owned(), "2.50 s".to_owned()));
        assert_eq!(percent(0.0213), "2.1 %");
    }
}
