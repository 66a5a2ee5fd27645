use std::time::Duration;

use glassbrick::BrickSource;
use serde_json::{Value, json};

use super::{Info, Needs};

/// What is told as one JSON object; its fields are fixed.
pub fn json(info: &Info) -> Value {
    let (volume, desc) = (info.volume, info.volume.desc());
    let direction = desc.direction;
    let mut told = json!({
        "path": info.job.input.path.to_string_lossy(),
        "format": volume.format(),
        "volume": {
            "extent": desc.extent.to_array(),
            "spacing": desc.spacing_mm.to_array(),
            "origin": desc.origin_mm.to_array(),
            "direction": [direction.x_axis.to_array(), direction.y_axis.to_array(), direction.z_axis.to_array()],
            "dtype": desc.stored_type.name(),
            "slope": desc.rescale.slope,
            "intercept": desc.rescale.intercept,
            "range": volume.value_range(),
            "bytes": desc.bytes(),
            "nan": volume.bricks().not_finite(),
        },
        "bricks": bricks(volume.bricks(), info.needs.as_ref()),
        "levels": volume.bricks().levels(),
        "backend": { "auto": info.backend_auto.0, "why": info.backend_auto.1 },
        "notes": volume.notes(),
        "time_ms": {
            "open": milliseconds(info.times.open),
            "tables": milliseconds(info.times.tables),
            "total": milliseconds(info.times.total),
        },
    });
    if let Some(store) = volume.store() {
        told["store"] = json!({
            "codec": store.codec.name(),
            "source_format": store.source_format,
            "levels": (0..store.levels())
                .map(|level| json!({
                    "extent": volume.bricks().grid(level).extent.to_array(),
                    "bricks": volume.bricks().grid(level).len(),
                }))
                .collect::<Vec<Value>>(),
        });
    }
    if let Some(needs) = &info.needs {
        // An end that is not bounded is null.
        let bands: Vec<Value> = needs.bands.iter().map(|band| json!([band.low, band.high])).collect();
        told["transfer_function"] = json!({
            "bands": bands,
            "visible_voxel_fraction": needs.visible_voxels,
            "file_bytes": needs.file_bytes.round() as u64,
            "load_seconds": needs.load_seconds,
        });
    }
    told
}

fn bricks(source: &dyn BrickSource, needs: Option<&Needs>) -> Value {
    let grid = source.grid(0);
    let mut bricks = json!({
        "layout": { "edge": grid.layout.edge, "halo": grid.layout.halo },
        "grid": grid.counts.to_array(),
        "total": grid.len(),
    });
    if let Some(needs) = needs {
        bricks["empty"] = needs.empty.into();
        bricks["filtered_visible"] = needs.filtered_visible.into();
        bricks["bytes_needed"] = needs.bytes.into();
    }
    bricks
}

fn milliseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}
