use std::path::Path;

use glassbrick_volume::{ControlPoint, TransferFunction};
use serde::Deserialize;

use crate::Error;
use crate::settings_file::{read_json, settings_error};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with points and, if wanted, unit")]
struct FunctionInFile {
    points: Vec<PointInFile>,
    unit: Option<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a point with value, color and opacity")]
struct PointInFile {
    value: f64,
    color: [f64; 3],
    opacity: f64,
}

/// Reads a transfer function: `{"points":[{"value":300,"color":[1,0.8,0.6],"opacity":0.0}, …],"unit":1.0}`, with
/// points sorted by value, sRGB colours and opacities from 0 to 1 and, where it is given, the unit in mm.
///
/// # Errors
/// When the file cannot be read or says something else.
pub fn read_transfer_function(path: &Path) -> Result<TransferFunction, Error> {
    let function: FunctionInFile = read_json(path)?;
    if function.points.is_empty() {
        return Err(settings_error(path, "points is empty; give at least one"));
    }
    if function.unit.is_some_and(|unit| !(unit.is_finite() && unit > 0.0)) {
        return Err(settings_error(path, "unit must be a length in mm above 0; correct it or leave it out"));
    }
    for (index, point) in function.points.iter().enumerate() {
        check_point(point).map_err(|what| settings_error(path, format!("points[{index}]{what}")))?;
    }
    if let Some(index) = function.points.windows(2).position(|pair| pair[0].value > pair[1].value) {
        let what = format!(
            "points[{}].value is {}, below the one before it, {}; sort the points by value",
            index + 1,
            function.points[index + 1].value,
            function.points[index].value
        );
        return Err(settings_error(path, what));
    }
    let points = function.points.into_iter();
    Ok(TransferFunction {
        points: points
            .map(|PointInFile { value, color, opacity }| ControlPoint { value, color, opacity })
            .collect(),
        unit_mm: function.unit,
    })
}

/// What is wrong with a point, to be read after its name.
fn check_point(point: &PointInFile) -> Result<(), String> {
    let unit_range = 0.0..=1.0_f64;
    if !point.value.is_finite() {
        return Err(".value must be a finite number".to_owned());
    }
    if let Some(channel) = point.color.iter().find(|channel| !unit_range.contains(*channel)) {
        return Err(format!(".color holds {channel}; red, green and blue go from 0 to 1"));
    }
    if !unit_range.contains(&point.opacity) {
        return Err(format!(".opacity is {}; it goes from 0 to 1", point.opacity));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn read(json: &str) -> Result<TransferFunction, Error> {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let path = folder.path().join("tf.json");
        fs::write(&path, json).expect("a scratch file");
        read_transfer_function(&path)
    }

    #[test]
    fn a_sound_file_is_read_as_it_stands() {
        let function = read(
            r#"{"points":[{"value":300,"color":[1,0.8,0.6],"opacity":0.0},
                          {"value":300,"color":[0,0,1],"opacity":0.5}],"unit":2.5}"#,
        )
        .expect("it is sound");
        let point = |color, opacity| ControlPoint { value: 300.0, color, opacity };
        assert_eq!(function.points, [point([1.0, 0.8, 0.6], 0.0), point([0.0, 0.0, 1.0], 0.5)]);
        assert_eq!(function.unit_mm, Some(2.5));
    }

    #[test]
    fn the_unit_may_be_left_out() {
        let function = read(r#"{"points":[{"value":-1e3,"color":[0,0,0],"opacity":1}]}"#);
        assert_eq!(function.expect("it is sound").unit_mm, None);
    }

    #[test]
    fn what_is_wrong_is_named_in_one_line() {
        let point = |fields: &str| format!(r#"{{"points":[{{{fields}}}]}}"#);
        for (json, words) in [
            (String::new(), "not a JSON object"),
            ("{".to_owned(), "EOF"),
            (r#"{"points":[1]}"#.to_owned(), "expected a point with value, color and opacity at line 1"),
            ("{}".to_owned(), "missing field `points`"),
            (r#"{"points":[]}"#.to_owned(), "points is empty"),
            (point(r#""value":1,"color":[0,0,0]"#), "missing field `opacity`"),
            (point(r#""value":1,"color":[0,0,0],"opacity":0,"alpha":1"#), "unknown field `alpha`"),
            (point(r#""value":1,"color":[0,0],"opacity":0"#), "length 2"),
            (point(r#""value":1e999,"color":[0,0,0],"opacity":0"#), "out of range"),
            (point(r#""value":1,"color":[0,255,0],"opacity":0"#), "points[0].color holds 255"),
            (point(r#""value":1,"color":[0,0,0],"opacity":-0.1"#), "points[0].opacity is -0.1"),
            (point(r#""value":"1","color":[0,0,0],"opacity":0"#), "invalid type"),
            (
                r#"{"points":[{"value":1,"color":[0,0,0],"opacity":0}],"unit":0}"#.to_owned(),
                "unit must be a length",
            ),
            (
                r#"{"points":[{"value":2,"color":[0,0,0],"opacity":0},{"value":1,"color":[0,0,0],"opacity":0}]}"#
                    .to_owned(),
                "points[1].value is 1, below the one before it, 2",
            ),
        ] {
            let error = read(&json).expect_err(&json).to_string();
            assert!(error.contains(words) && error.contains("tf.json"), "{error}");
            assert_eq!(error.lines().count(), 1, "{error}");
        }
    }
}
