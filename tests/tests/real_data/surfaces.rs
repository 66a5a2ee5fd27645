use glam::DVec3;
use glassbrick::{Camera, ControlPoint, Projection, RenderRequest, Renderer, TransferFunction, Volume};

use super::{data, open};

/// Half of SimpleITK's sampling and a whole step of ours, and what a steep edge may be blurred by.
const TOLERANCE_MM: f64 = 0.75;

/// Nothing below the threshold, opaque from it on.
pub fn opaque_from(threshold: f64) -> TransferFunction {
    let point = |value, opacity| ControlPoint { value, color: [1.0; 3], opacity };
    TransferFunction {
        points: vec![point(threshold - 0.5, 0.0), point(threshold + 0.5, 1.0)],
        unit_mm: Some(0.02),
    }
}

/// A picture of one pixel that looks along +y from before the volume.
fn line(volume: &Volume, x: f64, z: f64) -> Camera {
    let front = volume.desc().corners_mm().map(|corner| corner.y).into_iter().fold(f64::INFINITY, f64::min);
    let eye_mm = DVec3::new(x, front - 10.0, z);
    Camera {
        projection: Projection::Orthographic { height_mm: 1.0 },
        eye_mm,
        target_mm: eye_mm + DVec3::Y,
        up: DVec3::Z,
    }
}

/// Flipped, rotated, oblique or mirrored on the way, a surface would lie elsewhere.
#[test]
fn surfaces_lie_where_another_program_finds_them() {
    let Some(data) = data() else { return };
    let mut blocks: Vec<(&str, f64, Vec<[f64; 3]>)> = Vec::new();
    for row in include_str!("surfaces.txt").lines().filter(|row| !row.starts_with('#') && !row.is_empty()) {
        let words: Vec<&str> = row.split_whitespace().collect();
        let number = |word: &str| word.parse::<f64>().expect("a number");
        match (&words[..], blocks.last_mut()) {
            (&[name, threshold], _) => blocks.push((name, number(threshold), Vec::new())),
            (&[x, z, y], Some((.., points))) => points.push([x, z, y].map(number)),
            _ => panic!("{row} is no row of the table"),
        }
    }
    assert_eq!(blocks.len(), 10);
    for volume_blocks in blocks.chunk_by(|a, b| a.0 == b.0) {
        let volume = open(&data, volume_blocks[0].0);
        for (name, threshold, points) in volume_blocks {
            assert_eq!(points.len(), 14, "{name}");
            surfaces_lie_there(name, &volume, *threshold, points);
        }
    }
}

fn surfaces_lie_there(name: &str, volume: &Volume, threshold: f64, points: &[[f64; 3]]) {
    let request = RenderRequest {
        size: [1, 1],
        step_voxels: 0.25 / volume.desc().smallest_spacing_mm(),
        ..RenderRequest::new(opaque_from(threshold))
    };
    let renderer = Renderer::new(volume, request).expect("a sound request");
    for &[x, z, y] in points {
        let camera = line(volume, x, z);
        let drawn = renderer.draw(&camera, 1).expect("it can be drawn");
        let found = camera.eye_mm.y + f64::from(drawn.frame.depth_mm[0]);
        assert!((found - y).abs() < TOLERANCE_MM, "{name} from {threshold} at {x}, {z}: {found}, not {y}");
    }
}
