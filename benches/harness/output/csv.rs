//! One row for every run.

use std::fmt::Display;

use crate::{BenchResults, BrickFractions, BrickStages, Difference, Residency, Run};

/// A column: its name with the unit, and its cell.
pub type Column = (&'static str, fn(&Run) -> String);

/// All of a run.
pub const RUN_COLUMNS: [Column; 44] = [
    ("data_set", |run| run.data_set.clone()),
    ("tf", |run| run.tf.clone()),
    ("executor", |run| run.executor.clone()),
    ("view", |run| run.view.clone()),
    ("fps_median", |run| run.fps.median.to_string()),
    ("fps_q1", |run| run.fps.q1.to_string()),
    ("fps_q3", |run| run.fps.q3.to_string()),
    ("render_ms_median", |run| run.render_ms.median.to_string()),
    ("render_ms_q1", |run| run.render_ms.q1.to_string()),
    ("render_ms_q3", |run| run.render_ms.q3.to_string()),
    ("render_ms_all", |run| run.render_all_ms.iter().map(f64::to_string).collect::<Vec<_>>().join(" ")),
    ("open_ms", |run| run.stage_ms.open.to_string()),
    ("tables_ms", |run| run.stage_ms.tables.to_string()),
    ("plan_ms", |run| run.stage_ms.plan.to_string()),
    ("load_ms", |run| run.stage_ms.load.to_string()),
    ("first_render_ms", |run| run.stage_ms.first_render.to_string()),
    ("encode_ms", |run| run.stage_ms.encode.to_string()),
    ("bricks_total", |run| bricks(run, |bricks| bricks.total)),
    ("bricks_non_empty", |run| bricks(run, |bricks| bricks.non_empty)),
    ("bricks_filtered_visible", |run| bricks(run, |bricks| bricks.filtered_visible)),
    ("bricks_in_frustum", |run| bricks(run, |bricks| bricks.in_frustum)),
    ("bricks_not_occluded", |run| bricks(run, |bricks| bricks.not_occluded)),
    ("bricks_rendered", |run| bricks(run, |bricks| bricks.rendered)),
    ("fraction_non_empty", |run| fraction(run, |fractions| fractions.non_empty)),
    ("fraction_filtered_visible", |run| fraction(run, |fractions| fractions.filtered_visible)),
    ("fraction_in_frustum", |run| fraction(run, |fractions| fractions.in_frustum)),
    ("fraction_not_occluded", |run| fraction(run, |fractions| fractions.not_occluded)),
    ("fraction_rendered", |run| fraction(run, |fractions| fractions.rendered)),
    ("residency_budget_bytes", |run| residency(run, |residency| residency.budget_bytes)),
    ("residency_peak_bytes", |run| residency(run, |residency| residency.peak_bytes)),
    ("residency_hits", |run| residency(run, |residency| residency.hits)),
    ("residency_misses", |run| residency(run, |residency| residency.misses)),
    ("residency_uploads", |run| residency(run, |residency| residency.uploads)),
    ("residency_bytes_uploaded", |run| residency(run, |residency| residency.bytes_uploaded)),
    ("residency_evictions", |run| residency(run, |residency| residency.evictions)),
    ("residency_bytes_read", |run| residency(run, |residency| residency.bytes_read)),
    ("samples", |run| or_empty(run.samples)),
    ("complete", |run| run.complete.to_string()),
    ("peak_anon_bytes", |run| or_empty(run.peak_anon_bytes)),
    ("peak_rss_bytes", |run| or_empty(run.peak_rss_bytes)),
    ("difference_largest", |run| difference(run, |difference| difference.largest)),
    ("difference_maximum", |run| difference(run, |difference| difference.maximum)),
    ("difference_mean", |run| difference(run, |difference| difference.mean)),
    ("picture", |run| or_empty(run.picture.as_ref())),
];

/// What all rows have in common: where they come from, and what was drawn.
const COMMON_COLUMNS: [&str; 15] = [
    "version",
    "commit",
    "machine",
    "adapter",
    "date",
    "command",
    "width_pixels",
    "height_pixels",
    "step_voxels",
    "opacity_cutoff",
    "mode",
    "shading",
    "repeat",
    "threads",
    "gpu_memory_bytes",
];

/// All runs as comma-separated values, with a header; a cell is empty where nothing is known.
pub fn csv(results: &BenchResults) -> String {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let names = RUN_COLUMNS.iter().map(|&(name, _)| name).chain(COMMON_COLUMNS);
    writer.write_record(names).expect("memory takes every row");
    let common = common_cells(results);
    for run in &results.runs {
        let cells = RUN_COLUMNS.iter().map(|(_, cell)| cell(run)).chain(common.iter().cloned());
        writer.write_record(cells).expect("all rows have the header's length");
    }
    let rows = writer.into_inner().expect("memory takes every row");
    String::from_utf8(rows).expect("every cell was text")
}

fn common_cells(results: &BenchResults) -> [String; COMMON_COLUMNS.len()] {
    let (provenance, settings) = (&results.provenance, &results.settings);
    [
        provenance.version.clone(),
        provenance.commit.clone(),
        provenance.machine_in_words(),
        or_empty(provenance.machine.adapter.as_ref()),
        provenance.date.clone(),
        provenance.command.clone(),
        settings.size[0].to_string(),
        settings.size[1].to_string(),
        settings.step.to_string(),
        settings.opacity_cutoff.to_string(),
        settings.mode.clone(),
        settings.shading.clone(),
        settings.repeat.to_string(),
        settings.threads.to_string(),
        settings.gpu_memory_bytes.to_string(),
    ]
}

fn or_empty(value: Option<impl Display>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

fn bricks(run: &Run, of: fn(&BrickStages) -> usize) -> String {
    or_empty(run.bricks.as_ref().map(of))
}

fn fraction(run: &Run, of: fn(&BrickFractions) -> f64) -> String {
    or_empty(run.fractions.as_ref().map(of))
}

fn residency(run: &Run, of: fn(&Residency) -> u64) -> String {
    or_empty(run.residency.as_ref().map(of))
}

fn difference(run: &Run, of: fn(&Difference) -> f64) -> String {
    or_empty(run.difference.as_ref().map(of))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::sample::results;

    #[test]
    fn every_row_is_as_long_as_the_header_and_strange_commands_survive() {
        let mut results = results();
        results.provenance.command = "bench \"a, b\"\n-o 'c'".to_owned();
        let text = csv(&results);
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().unwrap().clone();
        let command = header.iter().position(|name| name == "command").unwrap();
        let mut rows = 0;
        for record in reader.records() {
            let record = record.unwrap();
            assert_eq!(record.len(), header.len());
            assert_eq!(record[command], results.provenance.command);
            rows += 1;
        }
        assert_eq!(rows, results.runs.len());
    }

    #[test]
    fn figures_stand_under_their_names_and_what_is_missing_is_empty() {
        let results = results();
        let text = csv(&results);
        let mut reader = ::csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().unwrap().clone();
        let at = |name| header.iter().position(|other| other == name).unwrap();
        let sw = results.runs.iter().position(|run| run.executor == "sw").unwrap();
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        assert_eq!(rows[0][at("render_ms_median")], results.runs[0].render_ms.median.to_string());
        assert_eq!(rows[0][at("bricks_in_frustum")], results.runs[0].bricks.unwrap().in_frustum.to_string());
        for name in
            ["bricks_total", "fraction_rendered", "residency_bytes_read", "difference_largest", "picture"]
        {
            assert_eq!(&rows[sw][at(name)], "", "{name}");
        }
    }

    #[test]
    fn no_two_columns_share_a_name() {
        let mut names: Vec<_> = RUN_COLUMNS.iter().map(|&(name, _)| name).chain(COMMON_COLUMNS).collect();
        names.sort_unstable();
        assert!(names.windows(2).all(|pair| pair[0] != pair[1]));
    }
}
