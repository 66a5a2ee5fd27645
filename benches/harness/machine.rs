use chrono::{SecondsFormat, Utc};
use glassbrick::{Gpu, InstructionSet, total_memory_bytes};
use sysinfo::System;

use crate::{Machine, Provenance};

/// What this machine says of itself.
fn machine(gpu: Option<&Gpu>) -> Machine {
    let processor = System::new().ok().and_then(|mut system| {
        system.refresh_cpu_all();
        system.cpus().first().map(|cpu| cpu.brand().trim().to_owned())
    });
    Machine {
        processor: processor.filter(|name| !name.is_empty()).unwrap_or_else(|| "unknown".to_owned()),
        processors: std::thread::available_parallelism().map_or(1, Into::into),
        instruction_set: InstructionSet::best().name().to_owned(),
        memory_bytes: total_memory_bytes(),
        system: System::long_os_version().unwrap_or_else(|_| std::env::consts::OS.to_owned()),
        adapter: gpu.map(|gpu| gpu.adapter().to_owned()),
        adapter_is_software: gpu.map(Gpu::is_software),
    }
}

/// Where a benchmark's figures will come from; `command` as it was typed, in words.
pub fn provenance(command: &[String], gpu: Option<&Gpu>) -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: env!("GLASSBRICK_COMMIT").to_owned(),
        command: command.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" "),
        date: Utc::now().to_rfc3339_opts(SecondsFormat::Secs, true),
        machine: machine(gpu),
    }
}

/// A word as a shell takes it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+%@".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_command_can_be_typed_again() {
        let words = ["glassbrick", "bench", "my scan.nrrd", "it's", "--size=64x64"].map(str::to_owned);
        let command = provenance(&words, None).command;
        assert_eq!(command, r"glassbrick bench 'my scan.nrrd' 'it'\''s' --size=64x64");
    }
}
