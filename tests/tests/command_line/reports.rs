use serde_json::{Value, json};

use super::Scratch;

/// What a field of the report is.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Text,
    Truth,
    /// A whole number, not below zero.
    Count,
    /// A number, not below zero.
    Number,
    Counts(usize),
    Numbers(usize),
    NumbersOfAny,
    Texts,
}
use Kind::{Count, Counts, Number, Numbers, NumbersOfAny, Text, Texts, Truth};

/// Every field that the report must have.
const FIELDS: [(&str, Kind); 45] = [
    ("/volume/extent", Counts(3)),
    ("/volume/spacing", Numbers(3)),
    ("/volume/dtype", Text),
    ("/volume/bytes", Count),
    ("/volume/nan", Count),
    ("/backend", Text),
    ("/adapter", Text),
    ("/pass", Text),
    ("/mode", Text),
    ("/size", Counts(2)),
    ("/level", Count),
    ("/step", Number),
    ("/opacity_cutoff", Number),
    ("/alpha", Number),
    ("/beta", Number),
    ("/bricks/total", Count),
    ("/bricks/empty", Count),
    ("/bricks/filtered_visible", Count),
    ("/bricks/in_frustum", Count),
    ("/bricks/occluded", Count),
    ("/bricks/rendered", Count),
    ("/bricks/rendered_fraction", Number),
    ("/bricks/boundary_pinned", Count),
    ("/residency/budget_bytes", Count),
    ("/residency/peak_bytes", Count),
    ("/residency/hits", Count),
    ("/residency/misses", Count),
    ("/residency/uploads", Count),
    ("/residency/bytes_uploaded", Count),
    ("/residency/evictions", Count),
    ("/residency/bytes_read", Count),
    ("/samples", Count),
    ("/complete", Truth),
    ("/time_ms/open", Number),
    ("/time_ms/tables", Number),
    ("/time_ms/plan", Number),
    ("/time_ms/load", Number),
    ("/time_ms/render", Number),
    ("/time_ms/render_all", NumbersOfAny),
    ("/time_ms/encode", Number),
    ("/time_ms/total", Number),
    ("/peak_anon_bytes", Count),
    ("/peak_rss_bytes", Count),
    ("/warnings", Texts),
    ("/version", Text),
];

fn is(value: &Value, kind: Kind) -> bool {
    let list = |count: Option<usize>, item: Kind| {
        value.as_array().is_some_and(|list| {
            count.is_none_or(|count| list.len() == count) && list.iter().all(|value| is(value, item))
        })
    };
    match kind {
        Text => value.as_str().is_some_and(|text| !text.is_empty()),
        Truth => value.is_boolean(),
        Count => value.is_u64(),
        Number => value.as_f64().is_some_and(|number| number.is_finite() && number >= 0.0),
        Counts(count) => list(Some(count), Count),
        Numbers(count) => list(Some(count), Number),
        NumbersOfAny => list(None, Number),
        Texts => list(None, Text),
    }
}

fn count(report: &Value, field: &str) -> u64 {
    report.pointer(field).and_then(Value::as_u64).unwrap_or_else(|| panic!("{field} is no count in {report}"))
}

#[test]
fn every_field_of_the_report_is_there() {
    let scratch = Scratch::new();
    for flags in ["-o {}/a.png", "-o {}/a.exr --mode mip", "-o {}/a.gif --frames 2"] {
        let report = scratch.render(flags);
        for (field, kind) in FIELDS {
            let value = report.pointer(field).unwrap_or_else(|| panic!("{field} is missing"));
            // Where the system does not tell a process its peaks, they are null.
            let may_be_null = field.starts_with("/peak_") && !cfg!(target_os = "linux");
            assert!(is(value, kind) || (may_be_null && value.is_null()), "{field} is {value}, not {kind:?}");
        }
    }
}

#[test]
fn the_report_says_what_was_asked_for_and_done() {
    let scratch = Scratch::new();
    let report = scratch.render(
        "-o {}/a.png --brick 24 --step 0.75 --opacity-cutoff 0.9 --alpha 0.01 --beta 0.99 --threads 1 \
         --memory 1MiB --skip empty",
    );
    assert_eq!(report["volume"]["extent"], json!([70, 64, 40]));
    assert_eq!(report["volume"]["spacing"], json!([0.5, 0.5, 1.0]));
    assert_eq!((&report["volume"]["dtype"], &report["volume"]["bytes"]), (&json!("u8"), &json!(179_200)));
    assert_eq!(
        (&report["backend"], &report["mode"], &report["level"]),
        (&json!("cpu"), &json!("dvr"), &json!(0))
    );
    assert_eq!((&report["size"], &report["step"]), (&json!([40, 30]), &json!(0.75)));
    assert_eq!(report["opacity_cutoff"], 0.9);
    assert_eq!((&report["alpha"], &report["beta"]), (&json!(0.01), &json!(0.99)));
    assert!(report["warnings"].to_string().contains("not exact"), "alpha and beta lose something");
    assert_eq!(report["complete"], true);
    let bricks = |name: &str| count(&report, &format!("/bricks/{name}"));
    assert_eq!(bricks("total"), 32);
    assert!(bricks("filtered_visible") + bricks("empty") <= 32 && bricks("rendered") > 0);
    let fraction = report["bricks"]["rendered_fraction"].as_f64().expect("a number");
    assert!((fraction - bricks("rendered") as f64 / 32.0).abs() < 1e-9);
    assert_eq!(count(&report, "/residency/budget_bytes"), 1 << 20);
    assert!(count(&report, "/residency/peak_bytes") <= 1 << 20);
    assert!(count(&report, "/residency/bytes_read") >= 179_200, "the scan reads the file once");
    let time = |name: &str| report["time_ms"][name].as_f64().expect("a number");
    assert!(time("total") >= time("open") + time("render"), "{}", report["time_ms"]);
}

#[test]
fn skipping_saves_samples_and_bricks() {
    let scratch = Scratch::new();
    let report = |skip: &str| scratch.render(&format!("-o {{}}/a.png --brick 24 --skip {skip}"));
    let [none, empty, all] = ["none", "empty", "all"].map(report);
    for field in ["/samples", "/bricks/rendered"] {
        assert!(count(&none, field) > count(&empty, field), "{field}");
        assert!(count(&empty, field) >= count(&all, field) && count(&all, field) > 0, "{field}");
    }
    assert_eq!(count(&none, "/bricks/filtered_visible"), 32);
    assert_eq!(count(&empty, "/bricks/filtered_visible"), 8);
}

#[test]
fn repeats_are_all_told_and_their_median_is_the_time() {
    let scratch = Scratch::new();
    let report = scratch.render("-o {}/a.png --repeat 3");
    let mut times: Vec<f64> = report["time_ms"]["render_all"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|time| time.as_f64().expect("a number"))
        .collect();
    assert_eq!(times.len(), 3);
    times.sort_by(f64::total_cmp);
    assert_eq!(report["time_ms"]["render"], times[1]);
    assert_eq!(scratch.render("-o {}/a.png")["time_ms"]["render_all"].as_array().map(Vec::len), Some(1));
}

#[test]
fn every_mode_and_shading_draws() {
    let scratch = Scratch::new();
    for mode in ["dvr", "mip", "minip", "mean"] {
        assert_eq!(scratch.render(&format!("-o {{}}/a.png --mode {mode}"))["mode"], *mode);
    }
    scratch.render("-o {}/a.png --shading phong");
    for tf in ["auto", "grey", "mr", "ct-bone"] {
        scratch.run(&format!("render {{}}/ball.nrrd --tf {tf} --size 20x20 -o {{}}/{tf}.png"));
    }
}
