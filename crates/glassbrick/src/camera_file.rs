use std::path::Path;

use glam::DVec3;
use glassbrick_volume::{Camera, Projection};
use serde::Deserialize;

use crate::Error;
use crate::settings_file::{read_json, settings_error};

/// Below this sine of the angle between up and the line of sight, which way is up is a matter of rounding.
const LEAST_SINE_OF_UP: f64 = 1e-9;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct CameraInFile {
    projection: ProjectionInFile,
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    fov_y_deg: Option<f64>,
    height: Option<f64>,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum ProjectionInFile {
    Perspective,
    Orthographic,
}

/// Reads a camera: `{"projection":"perspective","eye":[…],"target":[…],"up":[…],"fov_y_deg":30}`, or
/// `"orthographic"` with `"height"` in place of `fov_y_deg`; positions and height in world millimetres.
///
/// # Errors
/// When the file cannot be read, says something else, or describes a camera that sees nothing.
pub fn read_camera(path: &Path) -> Result<Camera, Error> {
    let camera: CameraInFile = read_json(path)?;
    let projection = projection(&camera).map_err(|what| settings_error(path, what))?;
    let camera = Camera {
        projection,
        eye_mm: DVec3::from_array(camera.eye),
        target_mm: DVec3::from_array(camera.target),
        up: DVec3::from_array(camera.up),
    };
    let basis = camera.basis().map_err(|what| settings_error(path, what))?;
    if basis.forward.cross(camera.up.normalize()).length() < LEAST_SINE_OF_UP {
        return Err(settings_error(path, "the camera's up lies along its line of sight; turn it aside"));
    }
    Ok(camera)
}

fn projection(camera: &CameraInFile) -> Result<Projection, &'static str> {
    match (&camera.projection, camera.fov_y_deg, camera.height) {
        (ProjectionInFile::Perspective, Some(fov_y_deg), None) => Ok(Projection::Perspective { fov_y_deg }),
        (ProjectionInFile::Orthographic, None, Some(height_mm)) => Ok(Projection::Orthographic { height_mm }),
        (ProjectionInFile::Perspective, ..) => {
            Err("a perspective camera has fov_y_deg, in degrees, and no height; correct the file")
        }
        (ProjectionInFile::Orthographic, ..) => {
            Err("an orthographic camera has height, in mm, and no fov_y_deg; correct the file")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    fn read(json: &str) -> Result<Camera, Error> {
        let folder = tempfile::tempdir().expect("a scratch folder");
        let path = folder.path().join("camera.json");
        fs::write(&path, json).expect("a scratch file");
        read_camera(&path)
    }

    /// A camera 5 mm in front of the origin, with the given projection, up and lens.
    fn file(projection: &str, up: &str, lens: &str) -> String {
        format!(r#"{{"projection":"{projection}","eye":[0,-5,0],"target":[0,0,0],"up":{up},{lens}}}"#)
    }

    #[test]
    fn both_projections_are_read() {
        let camera = read(&file("perspective", "[0,0,2]", r#""fov_y_deg":30"#)).expect("it is sound");
        assert_eq!(camera.projection, Projection::Perspective { fov_y_deg: 30.0 });
        assert_eq!(camera.eye_mm, DVec3::new(0.0, -5.0, 0.0));
        assert_eq!((camera.target_mm, camera.up), (DVec3::ZERO, DVec3::new(0.0, 0.0, 2.0)));
        let camera = read(&file("orthographic", "[0,0,1]", r#""height":250.5"#)).expect("it is sound");
        assert_eq!(camera.projection, Projection::Orthographic { height_mm: 250.5 });
    }

    #[test]
    fn what_is_wrong_is_named_in_one_line() {
        let up = "[0,0,1]";
        for (json, words) in [
            (file("fisheye", up, r#""height":1"#), "unknown variant `fisheye`"),
            (file("perspective", up, r#""height":1"#), "has fov_y_deg"),
            (file("orthographic", up, r#""fov_y_deg":30"#), "has height"),
            (file("orthographic", up, r#""fov_y_deg":30,"height":1"#), "no fov_y_deg"),
            (file("perspective", up, r#""fov_y_deg":180"#), "between 0 and 180"),
            (file("orthographic", up, r#""height":0"#), "positive"),
            (file("orthographic", up, r#""height":1,"zoom":2"#), "unknown field `zoom`"),
            (file("orthographic", up, r#""height":1,"a\nb":2"#), "unknown field `a b`"),
            (file("perspective", "[0,3,0]", r#""fov_y_deg":30"#), "along its line of sight"),
            (file("perspective", "[1e-12,-1,0]", r#""fov_y_deg":30"#), "along its line of sight"),
            (file("perspective", "[0,0,0]", r#""fov_y_deg":30"#), "up is zero"),
            (
                r#"{"projection":"perspective","eye":[1,1,1],"target":[1,1,1],"up":[0,0,1],"fov_y_deg":30}"#
                    .to_owned(),
                "same point",
            ),
            (r#"{"projection":"perspective"}"#.to_owned(), "missing field `eye`"),
        ] {
            let error = read(&json).expect_err(&json).to_string();
            assert!(error.contains(words) && error.contains("camera.json"), "{error}");
            assert_eq!(error.lines().count(), 1, "{error}");
        }
    }
}
