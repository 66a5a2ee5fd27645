//! The definition of the picture, evaluated plainly in `f64`: every sample of every ray, no bricks, no skipping.
//!
//! This is the truth that executors are compared with, so it favours being evidently right over being fast, and
//! shares no code with them.

mod bricks;
mod camera;
mod field;
mod transfer_function;

use glam::{DMat3, DVec3};

pub use bricks::{BricksMet, bricks_kept, bricks_met, bricks_not_empty};
pub use camera::{Camera, Projection, Ray};
use field::Field;
pub use transfer_function::{BakedTransferFunction, ControlPoint, Entry};

/// Everything that a picture depends on.
#[derive(Clone, Debug)]
pub struct ReferenceScene<'a> {
    /// Voxels along x, y and z.
    pub extent: [usize; 3],
    /// Where the volume's box ends, in voxels; at the faces of its outermost voxels where nothing is said. A level of
    /// a volume ends where the volume does, which may be within its last voxels.
    pub box_end: Option<[f64; 3]>,
    /// Stored values, x fastest.
    pub voxels: &'a [f64],
    /// Distance of neighbouring voxel centres along each axis, in mm.
    pub spacing: [f64; 3],
    /// World position of the centre of voxel (0, 0, 0), in mm.
    pub origin: [f64; 3],
    /// World directions of the voxel axes: three columns.
    pub direction: [[f64; 3]; 3],
    pub slope: f64,
    pub intercept: f64,
    /// The transfer function, sorted by value.
    pub points: Vec<ControlPoint>,
    /// The length that opacities are of, in mm; the smallest spacing where there is none.
    pub unit: Option<f64>,
    pub camera: Camera,
    pub width: usize,
    pub height: usize,
    /// Distance of the sample planes in units of the smallest spacing.
    pub step: f64,
    pub mode: Mode,
    pub phong: Option<Phong>,
    /// A DVR ray stops after the first sample at which its opacity reaches this; 1 never stops.
    pub opacity_cutoff: f64,
}

/// What a pixel shows of the values along its ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    Dvr,
    Mip,
    Minip,
    Mean,
}

/// Shading of DVR by a headlight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    pub ambient: f64,
    pub diffuse: f64,
    pub specular: f64,
    pub shininess: f64,
}

impl Default for Phong {
    fn default() -> Self {
        Self { ambient: 0.1, diffuse: 0.9, specular: 0.2, shininess: 10.0 }
    }
}

/// A picture in linear light, row 0 on top.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceFrame {
    /// Premultiplied red, green, blue and alpha.
    pub rgba: Vec<[f64; 4]>,
    /// Depth along the camera's forward direction of what a pixel shows, in mm; +inf where it shows nothing.
    pub z: Vec<f64>,
}

/// Draws the scene.
pub fn render(scene: &ReferenceScene) -> ReferenceFrame {
    let march = March::new(scene);
    let pixels = (0..scene.height).flat_map(|j| (0..scene.width).map(move |i| (i, j)));
    let (rgba, z) = pixels.map(|(i, j)| march.pixel(i, j)).unzip();
    ReferenceFrame { rgba, z }
}

/// How near a sample of any ray comes to the ends of the volume's box, on either side, in voxels.
///
/// An executor that rounds positions may take such a sample for its neighbour on the other side of the end.
pub fn nearest_sample_to_box(scene: &ReferenceScene) -> f64 {
    let march = March::new(scene);
    let pixels = (0..scene.height).flat_map(|j| (0..scene.width).map(move |i| (i, j)));
    let samples = pixels.flat_map(|(i, j)| march.samples_around(march.scene.ray(i, j)));
    samples.map(|(_, q)| march.field.distance_to_box(q)).fold(f64::INFINITY, f64::min)
}

impl ReferenceScene<'_> {
    /// The ray of pixel (i, j).
    pub fn ray(&self, i: usize, j: usize) -> Ray {
        self.camera.ray(i, j, self.width, self.height)
    }

    fn smallest_spacing(&self) -> f64 {
        self.spacing.into_iter().fold(f64::INFINITY, f64::min)
    }
}

struct March<'a> {
    scene: &'a ReferenceScene<'a>,
    field: Field<'a>,
    transfer_function: BakedTransferFunction,
    /// Distance of the sample planes, in mm.
    delta: f64,
}

impl<'a> March<'a> {
    fn new(scene: &'a ReferenceScene<'a>) -> Self {
        assert_eq!(scene.voxels.len(), scene.extent.iter().product::<usize>(), "voxels fill the extent");
        let smallest_spacing = scene.smallest_spacing();
        let spacing = DMat3::from_diagonal(DVec3::from_array(scene.spacing));
        let world_from_voxel = DMat3::from_cols_array_2d(&scene.direction) * spacing;
        Self {
            scene,
            field: Field {
                extent: scene.extent,
                voxels: scene.voxels,
                slope: scene.slope,
                intercept: scene.intercept,
                voxel_from_world: world_from_voxel.inverse(),
                origin: DVec3::from_array(scene.origin),
                box_end: DVec3::from_array(scene.box_end.unwrap_or(scene.extent.map(|n| n as f64 - 0.5))),
            },
            transfer_function: BakedTransferFunction::new(
                &scene.points,
                scene.unit.unwrap_or(smallest_spacing),
            ),
            delta: scene.step * smallest_spacing,
        }
    }

    /// Colour and depth of pixel (i, j).
    fn pixel(&self, i: usize, j: usize) -> ([f64; 4], f64) {
        let ray = self.scene.ray(i, j);
        match self.scene.mode {
            Mode::Dvr => self.dvr(ray),
            Mode::Mip => self.extremum(ray, |value, best| value > best),
            Mode::Minip => self.extremum(ray, |value, best| value < best),
            Mode::Mean => self.mean(ray),
        }
    }

    /// The samples of a ray in the volume: k and the voxel position.
    fn samples(&self, ray: Ray) -> impl Iterator<Item = (usize, DVec3)> {
        self.samples_around(ray).filter(|&(_, q)| self.field.contains(q))
    }

    /// The samples of a ray in the volume, and a few more on both sides.
    fn samples_around(&self, ray: Ray) -> impl Iterator<Item = (usize, DVec3)> {
        let start = self.field.voxel_from_world * (ray.start - self.field.origin);
        let d = self.field.voxel_from_world * ray.ray * self.delta;
        self.field.sample_indices(start, d).map(move |k| (k, start + d * (k as f64 + 0.5)))
    }

    fn depth(&self, k: usize) -> f64 {
        (k as f64 + 0.5) * self.delta
    }

    fn dvr(&self, ray: Ray) -> ([f64; 4], f64) {
        let (mut color, mut opacity, mut depth) = (DVec3::ZERO, 0.0, f64::INFINITY);
        for (k, q) in self.samples(ray) {
            let entry = self.transfer_function.at(self.field.value(q));
            let alpha = 1.0 - (-entry.extinction * self.delta * ray.ray.length()).exp();
            if alpha > 0.0 {
                color += (1.0 - opacity) * alpha * self.shaded(entry.color, q, ray.ray);
                opacity += (1.0 - opacity) * alpha;
            }
            if opacity >= 0.5 && depth == f64::INFINITY {
                depth = self.depth(k);
            }
            if opacity >= self.scene.opacity_cutoff && self.scene.opacity_cutoff < 1.0 {
                break;
            }
        }
        ([color.x, color.y, color.z, opacity], depth)
    }

    fn shaded(&self, color: DVec3, q: DVec3, ray: DVec3) -> DVec3 {
        let Some(phong) = self.scene.phong else { return color };
        let gradient = self.field.gradient_world(q);
        if gradient == DVec3::ZERO {
            return color;
        }
        let cosine = gradient.normalize().dot(-ray.normalize()).abs();
        color * (phong.ambient + phong.diffuse * cosine) + phong.specular * cosine.powf(phong.shininess)
    }

    fn extremum(&self, ray: Ray, is_better: fn(f64, f64) -> bool) -> ([f64; 4], f64) {
        let mut best: Option<(f64, usize)> = None;
        for (k, q) in self.samples(ray) {
            let value = self.field.value(q);
            if best.is_none_or(|(best, _)| is_better(value, best)) {
                best = Some((value, k));
            }
        }
        best.map_or(([0.0; 4], f64::INFINITY), |(value, k)| (self.pixel_of_value(value), self.depth(k)))
    }

    fn mean(&self, ray: Ray) -> ([f64; 4], f64) {
        let (sum, count) = self
            .samples(ray)
            .fold((0.0, 0.0), |(sum, count), (_, q)| (sum + self.field.value(q), count + 1.0));
        let rgba = if count > 0.0 { self.pixel_of_value(sum / count) } else { [0.0; 4] };
        (rgba, f64::INFINITY)
    }

    fn pixel_of_value(&self, value: f64) -> [f64; 4] {
        let entry = self.transfer_function.at(value);
        (entry.color * entry.opacity).extend(entry.opacity).to_array()
    }
}
