use comfy_table::Table;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use glassbrick::FrameReport;

use super::DemoPicture;
use crate::figures::{aligned, count, percent};

const HEADER: [&str; 9] =
    ["picture", "bricks", "empty", "in frustum", "occluded", "rendered", "fraction", "samples", "ms"];

/// How many of the columns are words.
const WORDS: usize = 1;

/// What each picture took: how many bricks each stage left, and its time.
pub fn table(drawn: &[(DemoPicture, FrameReport)]) -> String {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(HEADER);
    for (picture, report) in drawn {
        let bricks = report.bricks;
        let stages = [bricks.total, bricks.empty, bricks.in_frustum, bricks.occluded, bricks.rendered];
        let mut row = vec![picture.shows.to_owned()];
        row.extend(stages.map(|bricks| count(bricks as u64)));
        row.push(percent(bricks.rendered_fraction()));
        row.push(report.samples.map_or("—".to_owned(), count));
        row.push(format!("{:.1}", report.time_ms.render));
        table.add_row(aligned(row, WORDS));
    }
    table.to_string()
}
