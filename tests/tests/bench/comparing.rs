use std::fs;
use std::path::Path;

use serde_json::Value;

use super::results::bench;
use crate::binary::{Outcome, glassbrick};

fn compare(old: &Path, new: &Path, flags: &str) -> Outcome {
    glassbrick(&format!("bench {flags} --compare"), &[old, new])
}

/// Changes each run of a benchmark that was written down.
fn changed(results: &Value, to: &Path, change: impl Fn(&mut Value)) {
    let mut results = results.clone();
    results["runs"].as_array_mut().expect("a list").iter_mut().for_each(change);
    fs::write(to, results.to_string()).expect("a scratch file");
}

fn scale_times(run: &mut Value, factor: f64) {
    for field in ["median", "q1", "q3"] {
        run["render_ms"][field] = (run["render_ms"][field].as_f64().expect("a time") * factor).into();
    }
}

#[test]
fn a_benchmark_is_as_good_as_itself_and_better_than_a_slower_one() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let (results, _) = bench(&[], "--phantom 64x64x64 --tf ct-bone --executors sw,cpu", folder.path());
    let old = folder.path().join("bench.json");
    let new = folder.path().join("changed.json");
    assert_eq!(compare(&old, &old, "").code, Some(0));

    changed(&results, &new, |run| scale_times(run, 1.5));
    let slower = compare(&old, &new, "");
    assert_eq!(slower.code, Some(1), "{slower:?}");
    assert!(slower.stderr.contains("changed.json: is worse than"), "{slower:?}");
    assert_eq!(compare(&new, &old, "").code, Some(0), "the other way round, it is faster");
    assert_eq!(compare(&old, &new, "--tolerance 60%").code, Some(0), "so much is tolerated");

    changed(&results, &new, |run| {
        if let Some(rendered) = run["bricks"]["rendered"].as_u64() {
            run["bricks"]["rendered"] = (rendered + 3).into();
        }
    });
    assert_eq!(compare(&old, &new, "").code, Some(1), "more bricks are worse, however fast");
}

#[test]
fn what_is_no_benchmark_is_told_in_one_line() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let path = folder.path().join("bench.json");
    for (text, words) in [
        ("", "is no benchmark"),
        ("{\"schema\":1,\"runs\":[", "is no benchmark"),
        ("{\"schema\":2}", "schema is 2"),
        ("{\"schema\":1}", "provenance"),
        ("[1,2,3]", "is no benchmark"),
    ] {
        fs::write(&path, text).expect("a scratch file");
        let outcome = compare(&path, &path, "");
        assert_eq!(outcome.code, Some(1), "{outcome:?}");
        assert!(outcome.stderr.contains("bench.json") && outcome.stderr.contains(words), "{outcome:?}");
        assert_eq!(outcome.stderr.lines().count(), 1, "{outcome:?}");
    }
    let missing = folder.path().join("no-such.json");
    let outcome = compare(&missing, &path, "");
    assert!(outcome.code == Some(1) && outcome.stderr.contains("no-such.json"), "{outcome:?}");
}
