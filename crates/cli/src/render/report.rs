use glassbrick::{FrameReport, report_json};
use serde_json::Value;

use crate::job::Output;

/// The report of all that was drawn. Of a turn it is that of the first frame, with times of writing, totals, peaks and
/// warnings of all, and `frames` besides: the report of each.
pub fn whole(reports: &[FrameReport], output: &Output) -> Value {
    let Some(first) = reports.first() else { return Value::Null };
    if matches!(output, Output::Picture(_)) {
        return report_json(first);
    }
    let mut whole = first.clone();
    for report in &reports[1..] {
        whole.complete &= report.complete;
        whole.time_ms.encode += report.time_ms.encode;
        whole.time_ms.total = report.time_ms.total;
        whole.peak_anon_bytes = whole.peak_anon_bytes.max(report.peak_anon_bytes);
        whole.peak_rss_bytes = whole.peak_rss_bytes.max(report.peak_rss_bytes);
        whole.residency.peak_bytes = whole.residency.peak_bytes.max(report.residency.peak_bytes);
    }
    whole.warnings = warnings(reports);
    let mut whole = report_json(&whole);
    whole["frames"] = reports.iter().map(report_json).collect();
    whole
}

/// The warnings of all frames, each once.
pub fn warnings(reports: &[FrameReport]) -> Vec<String> {
    let mut warnings: Vec<String> = Vec::new();
    for warning in reports.iter().flat_map(|report| &report.warnings) {
        if !warnings.contains(warning) {
            warnings.push(warning.clone());
        }
    }
    warnings
}
