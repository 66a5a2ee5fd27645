//! The shaders of glassbrick's GPU passes, and the structs that they share with Rust.
//!
//! Each pass is a file in `passes/`, what passes share stands in `shared/`. The build composes and validates every
//! variant that is used; [`wgsl`] gives one. Nothing here knows a GPU.
//!
//! | pass | what it does |
//! | --- | --- |
//! | `raycast` | one march per pixel through the page table of resident bricks |
//! | `slices` | the slices of one brick in slabs, farthest first |
//! | `boxes` | the boxes of bricks, for occlusion queries |
//! | `visible` | turns the queries' counts into indirect draws |
//! | `under` | puts a layer's image under what lies in front of it |
//! | `erase` | empties the part of a layer's image that is drawn next |
//! | `opaque` | finds the pixels that the stencil keeps |
//! | `filter_probe` | measures how exact a texture unit filters |

mod layout;

pub use layout::{DrawArgs, Frame, QueryRange, RayFan, RayState, SLAB_SLICES, SlicedBrick};

include!(concat!(env!("OUT_DIR"), "/variants.rs"));

/// Textures of an atlas that one pass can choose from.
pub const MOST_TEXTURES: usize = 16;

/// What a ray makes of its samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pixels {
    Dvr,
    DvrShaded,
    Extremum,
    Mean,
}

impl Pixels {
    /// Whether colours are composited; else values are projected.
    pub const fn is_dvr(self) -> bool {
        matches!(self, Self::Dvr | Self::DvrShaded)
    }

    fn defined(self) -> &'static [&'static str] {
        match self {
            Self::Dvr => &["DVR"],
            Self::DvrShaded => &["DVR", "SHADED"],
            Self::Extremum => &["EXTREMUM"],
            Self::Mean => &["MEAN"],
        }
    }
}

/// A pass in one of its variants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Pass {
    /// `filters`: between texels by the texture unit; `many_textures`: one of sixteen for each brick.
    Raycast {
        pixels: Pixels,
        filters: bool,
        many_textures: bool,
    },
    Slices {
        pixels: Pixels,
        filters: bool,
    },
    /// `ranked`: the box's depth is the best value in it.
    Boxes {
        ranked: bool,
    },
    Visible,
    Under,
    Erase,
    Opaque,
    FilterProbe,
}

impl Pass {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Raycast { .. } => "raycast",
            Self::Slices { .. } => "slices",
            Self::Boxes { .. } => "boxes",
            Self::Visible => "visible",
            Self::Under => "under",
            Self::Erase => "erase",
            Self::Opaque => "opaque",
            Self::FilterProbe => "filter_probe",
        }
    }
}

/// The WGSL of a pass.
pub fn wgsl(pass: Pass) -> &'static str {
    let flag = |is_set: bool, name: &'static str| is_set.then_some(name);
    let defined: Vec<&str> = match pass {
        Pass::Raycast { pixels, filters, many_textures } => {
            let flags = [flag(filters, "FILTERS"), flag(many_textures, "MANY_TEXTURES")];
            pixels.defined().iter().copied().chain(flags.into_iter().flatten()).collect()
        }
        Pass::Slices { pixels, filters } => {
            pixels.defined().iter().copied().chain(flag(filters, "FILTERS")).collect()
        }
        Pass::Boxes { ranked } => flag(ranked, "EXTREMUM").into_iter().collect(),
        Pass::Visible | Pass::Under | Pass::Erase | Pass::Opaque | Pass::FilterProbe => Vec::new(),
    };
    let found = VARIANTS.iter().find(|(name, variant, _)| *name == pass.name() && *variant == defined);
    found.map(|&(_, _, wgsl)| wgsl).expect("the build composes every variant that a pass has")
}

#[cfg(test)]
mod tests;
