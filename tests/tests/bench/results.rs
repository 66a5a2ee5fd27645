use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::binary::{NO_DRIVERS, Outcome, glassbrick_at_length};

/// A benchmark of one small body, into a folder; the results, and what was said.
pub fn bench(variables: &[(&str, &str)], flags: &str, folder: &Path) -> (Value, Outcome) {
    let line = format!("bench --size 64x64 --views 2 --repeat 1 {flags} -o");
    let outcome = glassbrick_at_length(variables, &line, &[folder]).succeeded();
    let text = fs::read_to_string(folder.join("bench.json")).expect("bench.json is written");
    (serde_json::from_str(&text).expect("it is JSON"), outcome)
}

/// The elements of an array.
pub fn list<'a>(results: &'a Value, field: &str) -> &'a Vec<Value> {
    results[field].as_array().expect("a list")
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("the folder is there");
    let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name().into_string();
    let mut names: Vec<String> = entries.map(|entry| name(entry).expect("plain names")).collect();
    names.sort();
    names
}

#[test]
fn a_benchmark_writes_results_a_page_plots_and_pictures_and_nothing_else() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    // What a killed benchmark left.
    fs::create_dir(folder.path().join(".scratch")).expect("a folder");
    let (results, outcome) = bench(&[], "--phantom 96x64x80 --executors sw,cpu", folder.path());
    assert_eq!(files(folder.path()), ["bench.csv", "bench.json", "pictures", "plots", "report.html"]);

    assert_eq!(results["schema"], 1);
    for field in ["version", "commit", "command", "date", "machine"] {
        assert!(!results["provenance"][field].is_null(), "{field}");
    }
    assert!(
        results["provenance"]["command"]
            .as_str()
            .is_some_and(|command| command.starts_with("glassbrick bench "))
    );
    // Two of the turntable, three of the fly-in, one inside; three transfer functions; two executors.
    let runs = list(&results, "runs");
    assert_eq!(runs.len(), 6 * 3 * 2);
    for run in runs {
        assert!(run["fps"]["median"].as_f64().is_some_and(|fps| fps > 0.0), "{run}");
        assert_eq!(run["complete"], true, "{run}");
        let is_cpu = run["executor"] == "cpu";
        assert_eq!(run["bricks"].is_object(), is_cpu, "{run}");
        assert_eq!(run["difference"].is_object(), is_cpu, "{run}");
        if let Some(picture) = run["picture"].as_str() {
            assert!(folder.path().join(picture).is_file(), "{picture}");
        }
    }
    assert_eq!(files(&folder.path().join("pictures")).len(), 3 * (6 + 1));
    assert_eq!(list(&results, "budgets").len(), 2 * 6);
    assert_eq!(list(&results, "nearly_empty").len(), 3 * 11);

    let csv = fs::read_to_string(folder.path().join("bench.csv")).expect("bench.csv is written");
    assert_eq!(csv.lines().count(), 1 + runs.len());
    let commit = results["provenance"]["commit"].as_str().expect("a text");
    let hash = commit.split(' ').next().expect("a word");
    let page = fs::read_to_string(folder.path().join("report.html")).expect("report.html is written");
    let plot = files(&folder.path().join("plots")).into_iter().find(|name| name.starts_with("fps"));
    let plot =
        fs::read_to_string(folder.path().join("plots").join(plot.expect("a plot of fps"))).expect("a text");
    for (what, text) in [("csv", &csv), ("page", &page), ("plot", &plot), ("table", &outcome.stdout)] {
        assert!(text.contains(hash), "{what} says which commit it is of");
    }
}

#[test]
fn the_page_asks_nothing_of_a_network() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    bench(&[], "--phantom 64x64x64 --executors cpu --tf ct-bone", folder.path());
    let page = fs::read_to_string(folder.path().join("report.html")).expect("report.html is written");
    // Names of XML namespaces look like addresses, and are none; url(#…) is a part of the page itself, and an
    // empty icon keeps browsers from asking for one.
    let page = page.replace("url(#", "").replace("<link rel=\"icon\" href=\"data:,\">", "");
    let page = page.replace("http://www.w3.org/2000/svg", "").replace("http://www.w3.org/1999/xlink", "");
    for sign in ["http://", "https://", "src=\"//", "@import", "url(", "<link", "fetch(", "XMLHttpRequest"] {
        assert!(!page.contains(sign), "{sign}");
    }
    assert!(page.contains("data:image/png;base64,"));
}

#[test]
fn executors_that_cannot_run_are_listed_with_the_reason() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let flags = "--phantom 64x64x64 --tf ct-bone --executors hw,raycast,cpu";
    let (results, outcome) = bench(&NO_DRIVERS, flags, folder.path());
    for executor in list(&results, "executors") {
        let (name, ran) = (executor["name"].as_str().expect("a name"), executor["ran"] == true);
        assert_eq!(ran, name == "cpu", "{executor}");
        let reason = executor["reasons"][0].as_str().unwrap_or_default();
        match name {
            "cpu" => assert!(reason.is_empty(), "{executor}"),
            "hw" | "raycast" => assert!(reason.contains("GPU") || reason.contains("adapter"), "{executor}"),
            _ => assert_eq!(reason, "not asked for"),
        }
    }
    assert!(outcome.stdout.contains("raycast"), "the table tells of it: {}", outcome.stdout);
    assert!(results["provenance"]["machine"]["adapter"].is_null());
}

#[test]
fn any_volume_is_measured_by_what_suits_it() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let raw = folder.path().join("ramp.raw");
    let ramp: Vec<u8> = (0..40 * 40 * 40).map(|voxel: u32| (voxel / 256) as u8).collect();
    fs::write(&raw, ramp).expect("a scratch file");
    let results_folder = folder.path().join("results");
    let input = raw.display();
    let flags = format!("{input} --extent 40x40x40 --dtype u8 --phantom 64x64x64 --executors cpu");
    let (results, _) = bench(&[], &flags, &results_folder);
    let [file, body] = list(&results, "data_sets").as_slice() else { panic!("two data sets") };
    assert_eq!(file["name"], "ramp");
    assert_eq!(file["transfer_functions"], serde_json::json!(["auto", "mr", "grey"]));
    assert_eq!((&body["name"], &body["bricks"]), (&"phantom-64x64x64".into(), &8.into()));
    assert_eq!(body["transfer_functions"], serde_json::json!(["ct-bone", "ct-skin", "haze"]));
}

#[test]
fn projections_and_light_are_measured_too() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    for flags in ["--mode mip", "--mode minip", "--mode mean", "--shading phong --tf ct-skin"] {
        let (results, _) =
            bench(&[], &format!("--phantom 64x64x64 --executors sw,cpu {flags}"), folder.path());
        let compared = list(&results, "runs").iter().filter_map(|run| run["difference"]["largest"].as_f64());
        let largest =
            compared.fold(None, |largest: Option<f64>, next| Some(largest.unwrap_or(0.0).max(next)));
        assert!(largest.is_some_and(|largest| largest < 1e-4), "{flags}: {largest:?}");
    }
}
