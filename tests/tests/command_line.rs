//! What the commands do with sound input: what they print, draw, embed and report.

mod information;
pub mod pictures;
mod reports;
mod turns;

use std::fs;
use std::path::PathBuf;

use serde_json::Value;
use tempfile::TempDir;

use crate::binary::{Outcome, glassbrick};

/// A folder with a volume and a transfer function.
struct Scratch {
    folder: TempDir,
}

/// Voxels along x, y and z: more than one brick along two axes.
const EXTENT: [usize; 3] = [70, 64, 40];

impl Scratch {
    /// A ball of 200 off the middle, in a fog of 20 that thins out toward the top. The ball is 20 voxels wide.
    fn new() -> Self {
        let scratch = Self { folder: tempfile::tempdir().expect("a scratch folder") };
        let voxel = |index: usize| {
            let [x, y, z] = [index % 70, index / 70 % 64, index / (70 * 64)];
            let from_ball = [x as f64 - 44.0, y as f64 - 20.0, z as f64 - 22.0];
            let is_ball = from_ball.iter().map(|d| d * d).sum::<f64>() < 100.0;
            if is_ball { 200 } else { 20u8.saturating_sub(z as u8) }
        };
        let voxels: Vec<u8> = (0..EXTENT.iter().product()).map(voxel).collect();
        let header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 70 64 40\nencoding: raw\n\
                      space: left-posterior-superior\nspace directions: (0.5,0,0) (0,0.5,0) (0,0,1)\n\
                      space origin: (-17,-16,-20)\n\n";
        fs::write(scratch.path("ball.nrrd"), [header.as_bytes(), &voxels].concat()).expect("a scratch file");
        let function = r#"{"points":[{"value":100,"color":[1,0.5,0.2],"opacity":0},
                                     {"value":180,"color":[1,0.8,0.4],"opacity":0.9}],"unit":1}"#;
        fs::write(scratch.path("tf.json"), function).expect("a scratch file");
        scratch
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// `glassbrick` with `{}` in the line standing for this folder.
    #[track_caller]
    fn run(&self, line: &str) -> Outcome {
        let folder = self.folder.path().to_str().expect("scratch folders have plain names");
        glassbrick(&line.replace("{}", folder), &[]).succeeded()
    }

    /// `glassbrick render` of the volume with the transfer function; returns the report.
    #[track_caller]
    fn render(&self, flags: &str) -> Value {
        let line =
            format!("render {{}}/ball.nrrd --tf {{}}/tf.json --size 40x30 --report {{}}/r.json {flags}");
        let outcome = self.run(&line);
        assert_eq!(outcome.stdout.lines().count(), 1, "one line about the picture: {outcome:?}");
        self.json("r.json")
    }

    fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&fs::read(self.path(name)).expect("it was written")).expect("JSON")
    }
}
