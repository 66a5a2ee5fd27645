use std::fs;
use std::path::{Path, PathBuf};

use glassbrick::{check_text_file, write_text_file};

use crate::places::Places;
use crate::{BenchError, BenchResults, PagePicture, Run, csv, page, plots};

const JSON: &str = "bench.json";
const CSV: &str = "bench.csv";
const PAGE: &str = "report.html";

/// The folder of plots beside bench.json.
const PLOTS: &str = "plots";

/// Whether results can be written to a folder, asked before the work is done; it is made where there is none.
///
/// # Errors
/// When not, and why.
pub fn check_folder(folder: &Path) -> Result<(), BenchError> {
    for folder in [folder.to_owned(), folder.join(PLOTS), Places::pictures_in(folder)] {
        fs::create_dir_all(&folder).map_err(|source| BenchError::File { path: folder, source })?;
    }
    for file in [JSON, CSV, PAGE] {
        check_text_file(&folder.join(file))?;
    }
    Ok(())
}

/// Writes bench.json, bench.csv, report.html, plots and pictures; those of an earlier benchmark are replaced. The pictures
/// are moved from the scratch folder, which lies on the same disk. Returns the files that a reader begins with.
///
/// # Errors
/// When a file cannot be written.
pub fn write_results(
    results: &BenchResults,
    folder: &Path,
    scratch: &Path,
) -> Result<Vec<PathBuf>, BenchError> {
    let pictures = page_pictures(results, scratch)?;
    let plots = plots(results);
    write_text_file(
        &folder.join(JSON),
        &serde_json::to_string_pretty(results).expect("results are plain data"),
    )?;
    write_text_file(&folder.join(CSV), csv(results).trim_end())?;
    write_text_file(&folder.join(PAGE), &page(results, &plots, &pictures))?;
    for plot in &plots {
        write_text_file(&folder.join(PLOTS).join(format!("{}.svg", plot.name)), &plot.light)?;
        write_text_file(&folder.join(PLOTS).join(format!("{}-dark.svg", plot.name)), &plot.dark)?;
    }
    let places = Places::new(scratch)?;
    for run in &results.runs {
        if let Some(file) = picture_file(run) {
            let to = Places::pictures_in(folder).join(file);
            fs::rename(places.picture(file), &to).map_err(|source| BenchError::File { path: to, source })?;
        }
    }
    Ok([PAGE, JSON, CSV].map(|file| folder.join(file)).to_vec())
}

/// The name of a run's picture, if it was kept.
fn picture_file(run: &Run) -> Option<&str> {
    Path::new(run.picture.as_deref()?).file_name()?.to_str()
}

/// The pictures that were kept, in the page's size.
fn page_pictures(results: &BenchResults, scratch: &Path) -> Result<Vec<PagePicture>, BenchError> {
    let places = Places::new(scratch)?;
    let kept = results.runs.iter().filter_map(|run| Some((run, places.smaller_picture(picture_file(run)?))));
    kept.map(|(run, path)| {
        let png = fs::read(&path).map_err(|source| BenchError::File { path, source })?;
        Ok(PagePicture {
            data_set: run.data_set.clone(),
            tf: run.tf.clone(),
            executor: run.executor.clone(),
            view: run.view.clone(),
            png,
        })
    })
    .collect()
}

/// Reads a bench.json.
///
/// # Errors
/// When the file cannot be read, or is something else.
pub fn read_results(path: &Path) -> Result<BenchResults, BenchError> {
    let text = fs::read_to_string(path)
        .map_err(|source| BenchError::Unreadable { path: path.to_owned(), source })?;
    let not_a_benchmark = |what: String| BenchError::NotABenchmark { path: path.to_owned(), what };
    #[derive(serde::Deserialize)]
    struct Versioned {
        schema: u32,
    }
    let Versioned { schema } =
        serde_json::from_str(&text).map_err(|error| not_a_benchmark(error.to_string()))?;
    if schema != crate::SCHEMA {
        let what = format!("its schema is {schema}, and this glassbrick reads {}", crate::SCHEMA);
        return Err(not_a_benchmark(what));
    }
    serde_json::from_str(&text).map_err(|error| not_a_benchmark(error.to_string()))
}
