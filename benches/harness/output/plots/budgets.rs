//! What a frame that is drawn again takes with less memory.

use super::Plot;
use super::lines::Line;
use super::sheet::{Words, label};
use super::sweep::{Sample, by_category, sweep};
use crate::output::significant;
use crate::{BenchResults, BudgetPoint, DataSetRecord};

/// Points of one kind of memory, and how it is named.
struct Memory<'a> {
    kind: &'static str,
    named: &'static str,
    x_label: String,
    points: Vec<&'a BudgetPoint>,
}

pub fn plots(results: &BenchResults, data_set: &DataSetRecord) -> Vec<Plot> {
    let mut plots = Vec::new();
    for memory in memories(results, data_set) {
        plots.push(plot(results, data_set, &memory, "time", "median time, ms", |point| {
            point.render_ms.median
        }));
        plots.push(plot(results, data_set, &memory, "misses", "bricks missed", |point| {
            point.again.misses as f64
        }));
    }
    plots
}

fn memories<'a>(results: &'a BenchResults, data_set: &DataSetRecord) -> Vec<Memory<'a>> {
    let of = || results.budgets.iter().filter(|point| point.data_set == data_set.name);
    let gpu: Vec<_> = of().filter(|point| point.textures.is_some()).collect();
    let cpu: Vec<_> = of().filter(|point| point.textures.is_none()).collect();
    let gpu = Memory {
        kind: "gpu",
        named: "GPU memory for bricks",
        x_label: "budget: atlas textures (MiB)".to_owned(),
        points: gpu,
    };
    let cpu = Memory {
        kind: "cpu",
        named: "RAM for decoded bricks",
        x_label: "budget, MiB".to_owned(),
        points: cpu,
    };
    [gpu, cpu].into_iter().filter(|memory| !memory.points.is_empty()).collect()
}

fn plot(
    results: &BenchResults,
    data_set: &DataSetRecord,
    memory: &Memory<'_>,
    what: &str,
    y_label: &str,
    value: fn(&BudgetPoint) -> f64,
) -> Plot {
    let mut budgets: Vec<(u64, Option<u32>)> =
        memory.points.iter().map(|point| (point.budget_bytes, point.textures)).collect();
    budgets.sort_unstable();
    budgets.dedup();
    let categories: Vec<String> = budgets.iter().map(|&budget| named(budget)).collect();
    let samples = memory.points.iter().filter_map(|point| {
        let category = budgets.iter().position(|budget| *budget == (point.budget_bytes, point.textures))?;
        Some(Sample { tf: &point.tf, executor: &point.executor, category, value: value(point) })
    });
    let lines: Vec<Line> = by_category(samples, data_set);
    let (title, caption) = match what {
        "time" => (
            "Time by",
            "Median time of the frame drawn again with a memory of this size; it is flat where all bricks of the frame stay \
             resident.",
        ),
        _ => (
            "Misses by",
            "Bricks that the frame drawn again had to load with a memory of this size; it is 0 where all of them stay \
             resident.",
        ),
    };
    let words = Words {
        name: format!("budget-{}-{what}-{}", memory.kind, data_set.name),
        title: format!("{title} {}: {}", memory.named, label(&data_set.name, 30)),
        caption: format!("{caption} Steps of the axis are the sizes that were tried."),
    };
    sweep(results, words, &lines, categories, [&memory.x_label, y_label])
}

fn named((bytes, textures): (u64, Option<u32>)) -> String {
    let mebibytes = bytes as f64 / f64::from(1 << 20);
    let size = if mebibytes.fract() == 0.0 { format!("{mebibytes}") } else { significant(mebibytes) };
    textures.map_or_else(|| size.clone(), |textures| format!("{textures} ({size})"))
}
