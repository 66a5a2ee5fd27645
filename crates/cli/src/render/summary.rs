use glassbrick::FrameReport;

use crate::figures::{count, percent, time};
use crate::job::Output;
use crate::terminal::one_line;

/// What was written, in one line.
pub fn summary(output: &Output, reports: &[FrameReport]) -> String {
    let (Some(first), Some(last)) = (reports.first(), reports.last()) else { return String::new() };
    let [width, height] = first.size;
    let bricks = format!(
        "{} of {} bricks rendered ({})",
        count(first.bricks.rendered as u64),
        count(first.bricks.total as u64),
        percent(first.bricks.rendered_fraction())
    );
    let (render, total) = (time(first.time_ms.render), time(last.time_ms.total));
    let what = match output {
        Output::Picture(_) => format!("{width}×{height} pixels, {bricks}, drawn in {render}"),
        Output::Sequence(_) | Output::Animation { .. } => format!(
            "{} frames of {width}×{height} pixels, in the first {bricks}, drawn in {render}",
            reports.len()
        ),
    };
    one_line(&format!("{}: {what}, {total} in all", names(output)))
}

fn names(output: &Output) -> String {
    match output.files() {
        [first, .., last] => format!("{} to {}", first.display(), last.display()),
        files => files.iter().map(|file| file.display().to_string()).collect(),
    }
}
