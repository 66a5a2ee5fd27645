use std::fs;

use crate::binary::{glassbrick, glassbrick_at_length};

#[test]
fn what_cannot_be_measured_is_told_in_one_line() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    let path = |name: &str| folder.path().join(name);
    fs::write(path("text.nrrd"), "no volume").expect("a scratch file");
    fs::write(path("file"), "").expect("a scratch file");
    let out = path("out");
    for (input, output, words) in [
        (path("no-such.nrrd"), &out, "no-such.nrrd"),
        (path("text.nrrd"), &out, "text.nrrd"),
        (path("text.nrrd"), &path("file"), "file"),
    ] {
        let outcome = glassbrick_at_length(&[], "bench --executors cpu", &[&input, "-o".as_ref(), output]);
        assert_eq!(outcome.code, Some(1), "{outcome:?}");
        assert!(outcome.stderr.starts_with("error: ") && outcome.stderr.contains(words), "{outcome:?}");
        assert_eq!(outcome.stderr.lines().count(), 1, "{outcome:?}");
    }
    assert!(!out.join("bench.json").exists() && !out.join(".scratch").exists(), "nothing is left half done");
}

#[test]
fn flags_that_do_not_go_together_are_usage_errors() {
    for (line, words) in [
        ("bench", "--output <DIR>"),
        ("bench -o a --executors gpu", "possible values: hw, sw, slices, raycast, cpu"),
        ("bench -o a --compare b.json c.json", "--compare"),
        ("bench -o a --mode mip --shading phong", "--shading"),
        ("bench --compare b.json", "--compare"),
        ("bench -o a --tolerance 0.2", "--compare"),
        ("bench --compare a.json b.json --tolerance -1", "share"),
    ] {
        let outcome = glassbrick(line, &[]);
        assert_eq!(outcome.code, Some(2), "{outcome:?}");
        assert!(
            outcome.stderr.contains(words) && outcome.stderr.contains("glassbrick bench --help"),
            "{outcome:?}"
        );
    }
}
