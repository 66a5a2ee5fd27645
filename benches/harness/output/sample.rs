//! Results made by rule, for tests of what is written of them.

use super::PagePicture;
use crate::*;

const TFS: [&str; 3] = ["bone", "skin", "haze"];
const VIEWS: [&str; 12] =
    ["front", "back", "left", "right", "top", "bottom", "a30", "a60", "a120", "a150", "a210", "a240"];
/// Name, bricks, and how much of it is not air.
const SETS: [(&str, [u32; 3], f64); 3] = [
    ("body-512x304x1730", [512, 304, 1730], 0.52),
    ("head", [256, 256, 225], 0.7),
    ("foam", [320, 320, 320], 0.95),
];
/// Name, milliseconds of a million samples, and whether it knows bricks.
const EXECUTORS: [(&str, f64, bool); 5] = [
    ("hw", 60.0, true),
    ("sw", 90.0, false),
    ("slices", 25.0, true),
    ("raycast", 12.0, true),
    ("cpu", 4.0, true),
];

/// One grey pixel.
const PNG: [u8; 67] = [
    137, 80, 78, 71, 13, 10, 26, 10, 0, 0, 0, 13, 73, 72, 68, 82, 0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0, 58,
    126, 155, 85, 0, 0, 0, 10, 73, 68, 65, 84, 120, 156, 99, 72, 0, 0, 0, 98, 0, 97, 177, 152, 121, 242, 0,
    0, 0, 0, 73, 69, 78, 68, 174, 66, 96, 130,
];

/// 3 data sets, 3 transfer functions, 5 executors and 12 views, with sweeps of memory and of α and β.
pub fn results() -> BenchResults {
    let mut results = BenchResults {
        schema: SCHEMA,
        provenance: provenance(),
        settings: settings(),
        data_sets: SETS.iter().map(data_set).collect(),
        executors: EXECUTORS.iter().map(|(name, ..)| executor(name)).collect(),
        runs: Vec::new(),
        budgets: Vec::new(),
        nearly_empty: Vec::new(),
    };
    for (set, record) in results.data_sets.iter().enumerate() {
        for tf in 0..TFS.len() {
            for &kind in &EXECUTORS {
                let views = 0..VIEWS.len();
                results.runs.extend(views.map(|view| run(record, SETS[set].2, tf, kind, view)));
                if kind.2 && kind.0 != "hw" {
                    results.budgets.extend((0..6).map(|step| budget(record, tf, kind.0, step)));
                }
                if kind.0 == "cpu" {
                    results.nearly_empty.extend((0..9).map(|step| nearly_empty(record, tf, step)));
                }
            }
        }
    }
    results
}

fn provenance() -> Provenance {
    Provenance {
        version: "0.1.0".into(),
        commit: "0123456789abcdef0123456789abcdef01234567".into(),
        command: "glassbrick bench body.nrrd \"head, scanned.nii\" -o out".into(),
        date: "2026-11-22T10:00:00Z".into(),
        machine: Machine {
            processor: "Example CPU at 2.1 GHz".into(),
            processors: 2,
            instruction_set: "AVX-512".into(),
            memory_bytes: Some(8 << 30),
            system: "Linux 6.1".into(),
            adapter: Some("example driver 1.2 (Vulkan)".into()),
            adapter_is_software: Some(true),
        },
    }
}

fn settings() -> BenchSettings {
    BenchSettings {
        size: [512, 512],
        step: 1.0,
        opacity_cutoff: 0.998,
        mode: "dvr".into(),
        shading: "off".into(),
        repeat: 5,
        threads: 2,
        gpu_memory_bytes: 1 << 30,
    }
}

fn bricks_of(extent: [u32; 3]) -> usize {
    extent.iter().map(|&edge| edge.div_ceil(60) as usize).product()
}

fn data_set(&(name, extent, _): &(&str, [u32; 3], f64)) -> DataSetRecord {
    DataSetRecord {
        name: name.into(),
        source: "phantom".into(),
        extent,
        spacing_mm: [1.0; 3],
        dtype: "u16".into(),
        bytes: extent.iter().map(|&edge| u64::from(edge)).product::<u64>() * 2,
        bricks: bricks_of(extent),
        transfer_functions: TFS.map(str::to_owned).to_vec(),
    }
}

fn executor(name: &str) -> ExecutorRecord {
    ExecutorRecord { name: name.into(), summary: format!("draws by {name}"), ran: true, reasons: Vec::new() }
}

fn stages(total: usize, non_empty: f64, kept: f64, seen: f64) -> BrickStages {
    let of = |fraction: f64| (total as f64 * fraction).round() as usize;
    BrickStages {
        total,
        non_empty: of(non_empty),
        filtered_visible: of(non_empty * kept),
        in_frustum: of(non_empty * kept * 0.97),
        not_occluded: of(non_empty * kept * 0.97 * seen),
        rendered: of(non_empty * kept * 0.97 * seen * 0.95),
    }
}

fn spread(median: f64) -> Spread {
    Spread { median, q1: median * 0.96, q3: median * 1.07 }
}

fn residency(bricks: u64, budget_bytes: u64, misses: u64) -> Residency {
    Residency {
        budget_bytes,
        peak_bytes: budget_bytes.min(bricks << 19),
        hits: bricks.saturating_sub(misses),
        misses,
        uploads: misses,
        bytes_uploaded: misses << 19,
        evictions: misses.saturating_sub(bricks / 2),
        bytes_read: misses * 432_000,
    }
}

fn run(
    record: &DataSetRecord,
    matter: f64,
    tf: usize,
    (name, cost, bricked): (&str, f64, bool),
    view: usize,
) -> Run {
    let turn = (view as f64 * 0.9).sin();
    let seen = if name == "hw" { 1.0 } else { [0.35, 0.3, 0.9][tf] * (1.0 + 0.2 * turn) };
    let bricks = stages(record.bricks, matter * [0.4, 0.7, 1.0][tf], 1.0, seen.min(1.0));
    let samples = bricks.rendered.max(20) as f64 * [9e3, 8e3, 6e4][tf] * if bricked { 1.0 } else { 1.6 };
    let render = spread(cost * samples / 1e6 + 1.5);
    Run {
        data_set: record.name.clone(),
        tf: TFS[tf].into(),
        executor: name.into(),
        view: VIEWS[view].into(),
        fps: render.per_second(),
        render_ms: render,
        render_all_ms: vec![render.q1, render.median, render.q3],
        stage_ms: StageMs {
            open: 3.0,
            tables: 25.0,
            plan: 0.2,
            load: 40.0,
            first_render: render.median * 3.0,
            encode: 8.0,
        },
        bricks: bricked.then_some(bricks),
        fractions: bricked.then(|| bricks.fractions()),
        residency: bricked.then(|| residency(bricks.rendered as u64, 1 << 30, bricks.rendered as u64)),
        samples: (name != "slices").then_some(samples as u64),
        complete: true,
        peak_anon_bytes: Some(90_000_000 + record.bricks as u64 * 100_000),
        peak_rss_bytes: Some(190_000_000),
        difference: (name != "sw").then_some(Difference { largest: 3.1e-4, maximum: 8e-4, mean: 2e-6 }),
        picture: None,
    }
}

fn budget(record: &DataSetRecord, tf: usize, executor: &str, step: u32) -> BudgetPoint {
    let needed = (record.bricks as u64) / [6, 4, 2][tf];
    let room = 64u64 << step;
    let again = needed.saturating_sub(room);
    let on_cpu = executor == "cpu";
    BudgetPoint {
        data_set: record.name.clone(),
        tf: TFS[tf].into(),
        executor: executor.into(),
        view: VIEWS[0].into(),
        budget_bytes: if on_cpu { 16 << (20 + step) } else { 64 << (20 + step) },
        textures: (!on_cpu).then_some(1 << step),
        render_ms: spread(10.0 + 4.0 * tf as f64 + again as f64 * if on_cpu { 0.1 } else { 0.3 }),
        first: residency(needed, room << 19, needed),
        again: residency(needed, room << 19, again),
        difference: Difference { largest: 0.0, maximum: 0.0, mean: 0.0 },
    }
}

fn nearly_empty(record: &DataSetRecord, tf: usize, step: usize) -> NearlyEmptyPoint {
    let sweep = [0.0_f64, 0.001, 0.01, 0.05, 0.2];
    let (alpha, beta) = if step < 5 { (sweep[step], 1.0) } else { (0.0, 1.0 - sweep[step - 4]) };
    let lost = f64::sqrt(alpha + 1.0 - beta);
    let bricks = stages(record.bricks, 0.5, 1.0 - lost, 0.5);
    NearlyEmptyPoint {
        data_set: record.name.clone(),
        tf: TFS[tf].into(),
        executor: "cpu".into(),
        view: VIEWS[0].into(),
        alpha,
        beta,
        bricks,
        fractions: bricks.fractions(),
        render_ms: spread(10.0 * (1.0 - lost)),
        difference: Difference { largest: lost * (0.2 + 0.1 * tf as f64), maximum: lost, mean: lost * 0.01 },
    }
}

/// A pixel for each run from two views, and for all of the CPU's.
pub fn pictures(results: &BenchResults) -> Vec<PagePicture> {
    let shown =
        results.runs.iter().filter(|run| VIEWS[..2].contains(&run.view.as_str()) || run.executor == "cpu");
    shown
        .map(|run| PagePicture {
            data_set: run.data_set.clone(),
            tf: run.tf.clone(),
            executor: run.executor.clone(),
            view: run.view.clone(),
            png: PNG.to_vec(),
        })
        .collect()
}
