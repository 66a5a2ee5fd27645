//! On what, from what and how the figures came to be.

use maud::{Markup, html};

use crate::BenchResults;
use crate::output::figures::{count, significant};
use crate::output::table::printable;

pub fn section(results: &BenchResults) -> Markup {
    let (provenance, settings) = (&results.provenance, &results.settings);
    let [width, height] = settings.size;
    let facts = [
        ("Machine", provenance.machine_in_words()),
        ("Adapter and driver", provenance.adapter_in_words()),
        ("glassbrick", format!("{}, commit {}", provenance.version, provenance.commit)),
        ("Date", provenance.date.clone()),
        (
            "Pictures",
            format!(
                "{width} × {height} pixels, mode {}, shading {}, a sample every {} voxels, opacity cutoff {}",
                settings.mode, settings.shading, settings.step, settings.opacity_cutoff
            ),
        ),
        ("Repeats", format!("{} at most, after the first", settings.repeat)),
        ("Threads", settings.threads.to_string()),
        (
            "GPU memory for bricks",
            format!("{:.0} MiB", settings.gpu_memory_bytes as f64 / f64::from(1 << 20)),
        ),
    ];
    html! {
        section #provenance {
            h2 { "Machine, version and command" }
            dl .facts {
                @for (name, fact) in facts {
                    dt { (name) }
                    dd { (printable(&fact)) }
                }
                dt { "Command" }
                dd { code { (printable(&provenance.command)) } }
            }
            h3 { "Data sets" }
            (data_sets(results))
        }
    }
}

fn data_sets(results: &BenchResults) -> Markup {
    html! {
        div .wide tabindex="0" role="region" aria-label="Data sets" {
            table {
                thead {
                    tr {
                        @for name in ["data set", "source"] {
                            th .text scope="col" { (name) }
                        }
                        @for name in ["extent, voxels", "spacing, mm", "type", "MB", "bricks"] {
                            th scope="col" { (name) }
                        }
                    }
                }
                tbody {
                    @for set in &results.data_sets {
                        tr {
                            th scope="row" { (printable(&set.name)) }
                            td .text { (printable(&set.source)) }
                            td { (set.extent.map(|edge| edge.to_string()).join(" × ")) }
                            td { (set.spacing_mm.map(significant).join(" × ")) }
                            td { (set.dtype) }
                            td { (format!("{:.0}", set.bytes as f64 / 1e6)) }
                            td { (count(set.bricks as u64)) }
                        }
                    }
                }
            }
        }
    }
}
