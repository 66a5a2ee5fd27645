//! The solids that the body is made of: signed distances in mm, negative inside, evaluated along rows of voxels.
//!
//! Distances are exact near the surface to first order, which is where they are turned into partial volumes, and
//! of the right sign and rough size elsewhere. A solid knows nothing of tissues.

mod domes;
mod drum;
mod ellipsoid;
mod half_space;
mod loft;
mod plate;
mod round_cone;

pub use domes::{Dome, Domes};
pub use drum::Drum;
pub use ellipsoid::Ellipsoid;
pub use half_space::HalfSpace;
pub use loft::{Loft, Section};
pub use plate::Plate;
pub use round_cone::RoundCone;

use loft::LoftCut;

use crate::vector::Vec3;

/// A row of voxel centres along +x.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The first centre.
    pub first_mm: Vec3,
    /// Distance of neighbouring centres.
    pub step_mm: f32,
}

impl Row {
    /// The x of the row's voxel `i`.
    #[inline(always)]
    fn x(&self, i: usize) -> f32 {
        self.first_mm[0] + i as i32 as f32 * self.step_mm
    }
}

/// A rectangle of a slice, in mm.
#[derive(Clone, Copy, Debug)]
pub struct Rect {
    pub x: [f32; 2],
    pub y: [f32; 2],
}

impl Rect {
    const EVERYWHERE: Self =
        Self { x: [f32::NEG_INFINITY, f32::INFINITY], y: [f32::NEG_INFINITY, f32::INFINITY] };

    fn around(center: [f32; 2], half: [f32; 2]) -> Self {
        Self { x: [center[0] - half[0], center[0] + half[0]], y: [center[1] - half[1], center[1] + half[1]] }
    }
}

/// A part of space with a surface.
#[derive(Clone, Debug)]
pub enum Solid {
    RoundCone(RoundCone),
    Ellipsoid(Ellipsoid),
    Loft(Loft),
    Plate(Plate),
    Drum(Drum),
    Domes(Domes),
    HalfSpace(HalfSpace),
}

/// A solid at one slice: what its rows need, and the rectangle outside which it is farther than the asked margin.
#[derive(Clone, Debug)]
pub struct Cut<'a> {
    pub rect: Rect,
    kind: CutKind<'a>,
}

#[derive(Clone, Debug)]
enum CutKind<'a> {
    RoundCone(&'a RoundCone),
    Ellipsoid(&'a Ellipsoid),
    Loft(LoftCut),
    Plate(&'a Plate),
    Drum(&'a Drum),
    Domes(&'a Domes),
    HalfSpace(&'a HalfSpace),
}

impl Solid {
    /// The solid at height `z_mm`, if any of that slice is nearer to it than `margin_mm`.
    pub fn cut(&self, z_mm: f32, margin_mm: f32) -> Option<Cut<'_>> {
        let (rect, kind) = match self {
            Self::RoundCone(solid) => (solid.rect(z_mm, margin_mm)?, CutKind::RoundCone(solid)),
            Self::Ellipsoid(solid) => (solid.rect(z_mm, margin_mm)?, CutKind::Ellipsoid(solid)),
            Self::Loft(solid) => {
                let cut = solid.cut(z_mm)?;
                (cut.rect(margin_mm), CutKind::Loft(cut))
            }
            Self::Plate(solid) => (solid.rect(z_mm, margin_mm)?, CutKind::Plate(solid)),
            Self::Drum(solid) => (solid.rect(z_mm, margin_mm)?, CutKind::Drum(solid)),
            Self::Domes(solid) => (Rect::EVERYWHERE, CutKind::Domes(solid)),
            Self::HalfSpace(solid) => (Rect::EVERYWHERE, CutKind::HalfSpace(solid)),
        };
        Some(Cut { rect, kind })
    }

    /// The mirror image in the body's midplane.
    pub fn mirrored(&self) -> Self {
        match self {
            Self::RoundCone(solid) => Self::RoundCone(solid.mirrored()),
            Self::Ellipsoid(solid) => Self::Ellipsoid(solid.mirrored()),
            Self::Loft(solid) => Self::Loft(solid.mirrored()),
            Self::Plate(solid) => Self::Plate(solid.mirrored()),
            Self::Drum(solid) => Self::Drum(solid.mirrored()),
            Self::Domes(solid) => Self::Domes(solid.mirrored()),
            Self::HalfSpace(solid) => Self::HalfSpace(solid.mirrored()),
        }
    }

    /// The signed distance of one point, +inf where the solid ends far from it.
    pub fn distance(&self, point: Vec3) -> f32 {
        let mut distance = [f32::INFINITY];
        if let Some(cut) = self.cut(point[2], f32::INFINITY) {
            cut.distances(&Row { first_mm: point, step_mm: 0.0 }, &mut distance);
        }
        distance[0]
    }
}

impl Cut<'_> {
    /// The signed distances of a row of this slice.
    pub fn distances(&self, row: &Row, out: &mut [f32]) {
        match &self.kind {
            CutKind::RoundCone(solid) => solid.distances(row, out),
            CutKind::Ellipsoid(solid) => solid.distances(row, out),
            CutKind::Loft(cut) => cut.distances(row, out),
            CutKind::Plate(solid) => solid.distances(row, out),
            CutKind::Drum(solid) => solid.distances(row, out),
            CutKind::Domes(solid) => solid.distances(row, out),
            CutKind::HalfSpace(solid) => solid.distances(row, out),
        }
    }
}
