//! Numbers and names as people read them.

use comfy_table::{Cell, CellAlignment};

use crate::Provenance;

/// What stands where there is nothing to tell.
pub const NOTHING: &str = "–";

/// A whole number with commas between thousands.
pub fn count(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::with_capacity(digits.len() * 4 / 3);
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Three significant digits, without an exponent where that is readable.
pub fn significant(value: f64) -> String {
    if !value.is_finite() {
        return NOTHING.to_owned();
    }
    let size = value.abs();
    match size {
        0.0 => "0".to_owned(),
        _ if !(1e-3..1e6).contains(&size) => format!("{value:.1e}"),
        _ if size >= 99.95 => format!("{value:.0}"),
        _ if size >= 9.995 => format!("{value:.1}"),
        _ if size >= 0.9995 => format!("{value:.2}"),
        _ => format!("{value:.3}"),
    }
}

/// A fraction in percent, without the sign.
pub fn percent(fraction: f64) -> String {
    format!("{:.1}", fraction * 100.0)
}

/// Bytes in units of 1,000,000.
pub fn megabytes(bytes: u64) -> String {
    format!("{:.1}", bytes as f64 / 1e6)
}

/// Text of a value that may be missing.
pub fn or_nothing<T>(value: Option<T>, text: impl FnOnce(T) -> String) -> String {
    value.map_or_else(|| NOTHING.to_owned(), text)
}

/// At most so many characters of a name: long ones keep their ends.
pub fn shortened(name: &str, most: usize) -> String {
    let length = name.chars().count();
    if length <= most {
        return name.to_owned();
    }
    let kept = most.saturating_sub(1);
    let head: String = name.chars().take(kept - kept / 2).collect();
    let tail: String = name.chars().skip(length - kept / 2).collect();
    format!("{head}…{tail}")
}

/// Words to the left, numbers to the right.
pub fn aligned(row: Vec<String>, words: usize) -> Vec<Cell> {
    let align = |(column, text)| {
        let alignment = if column < words { CellAlignment::Left } else { CellAlignment::Right };
        Cell::new(text).set_alignment(alignment)
    };
    row.into_iter().enumerate().map(align).collect()
}

impl Provenance {
    /// The GPU in words.
    pub(super) fn adapter_in_words(&self) -> String {
        let software =
            if self.machine.adapter_is_software == Some(true) { " (computes on the CPU)" } else { "" };
        self.machine
            .adapter
            .as_ref()
            .map_or_else(|| "no GPU".to_owned(), |adapter| format!("{adapter}{software}"))
    }

    /// The machine in words.
    pub(super) fn machine_in_words(&self) -> String {
        let machine = &self.machine;
        let memory = machine.memory_bytes.map_or_else(String::new, |b| format!(", {:.1} GB", b as f64 / 1e9));
        let threads = if machine.processors == 1 { "thread" } else { "threads" };
        format!(
            "{}, {} {threads}, {}{memory}, {}",
            machine.processor, machine.processors, machine.instruction_set, machine.system
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_three_digits() {
        let shown = [0.0, 0.01234, 0.5, 1.0, 9.999, 12.34, 99.99, 1234.5, 2.5e7, 3e-5].map(significant);
        assert_eq!(shown, ["0", "0.012", "0.500", "1.00", "10.0", "12.3", "100", "1234", "2.5e7", "3.0e-5"]);
        assert_eq!(significant(f64::NAN), NOTHING);
    }

    #[test]
    fn long_names_keep_both_ends_and_no_character_is_split() {
        assert_eq!(shortened("kidney", 6), "kidney");
        assert_eq!(shortened("äbcdefghijklmnö", 7), "äbc…mnö");
    }
}
