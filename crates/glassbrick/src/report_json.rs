use glassbrick_volume::FrameReport;
use serde_json::{Value, json};

/// The report as the JSON object that users and checks read; its fields are fixed.
pub fn report_json(report: &FrameReport) -> Value {
    let FrameReport { volume, bricks, residency, time_ms, .. } = report;
    json!({
        "volume": {
            "extent": volume.extent.to_array(),
            "spacing": volume.spacing_mm.to_array(),
            "dtype": volume.stored_type.name(),
            "bytes": volume.bytes(),
            "nan": report.not_finite,
        },
        "backend": report.backend,
        "adapter": report.adapter,
        "pass": report.pass,
        "mode": report.mode,
        "size": report.size,
        "level": report.level,
        "step": report.step,
        "opacity_cutoff": report.opacity_cutoff,
        "alpha": report.alpha,
        "beta": report.beta,
        "bricks": {
            "total": bricks.total,
            "empty": bricks.empty,
            "filtered_visible": bricks.filtered_visible,
            "in_frustum": bricks.in_frustum,
            "occluded": bricks.occluded,
            "rendered": bricks.rendered,
            "rendered_fraction": bricks.rendered_fraction(),
            "boundary_pinned": bricks.boundary_pinned,
            "damaged": bricks.damaged,
        },
        "residency": {
            "budget_bytes": residency.budget_bytes,
            "peak_bytes": residency.peak_bytes,
            "hits": residency.hits,
            "misses": residency.misses,
            "uploads": residency.uploads,
            "bytes_uploaded": residency.bytes_uploaded,
            "evictions": residency.evictions,
            "bytes_read": residency.bytes_read,
        },
        "samples": report.samples,
        "complete": report.complete,
        "time_ms": {
            "open": time_ms.open,
            "tables": time_ms.tables,
            "plan": time_ms.plan,
            "load": time_ms.load,
            "render": time_ms.render,
            "render_all": time_ms.render_all,
            "encode": time_ms.encode,
            "total": time_ms.total,
        },
        "peak_anon_bytes": report.peak_anon_bytes,
        "peak_rss_bytes": report.peak_rss_bytes,
        "warnings": report.warnings,
        "version": env!("CARGO_PKG_VERSION"),
    })
}
