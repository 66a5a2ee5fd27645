//! An organ or a tissue: solids joined, cut to size, and filled from the outside in.

use crate::solid::{Cut, Solid};

/// What a voxel of one tissue holds.
#[derive(Clone, Copy, Debug)]
pub struct Tissue {
    /// Hounsfield units.
    pub hu: f32,
    /// Grain: largest difference from `hu`, and its size.
    pub grain_hu: f32,
    pub grain_mm: f32,
}

impl Tissue {
    /// The same everywhere.
    pub const fn plain(hu: f32) -> Self {
        Self { hu, grain_hu: 0.0, grain_mm: 1.0 }
    }

    pub const fn grained(hu: f32, grain_hu: f32, grain_mm: f32) -> Self {
        Self { hu, grain_hu, grain_mm }
    }
}

/// One solid of a shape.
#[derive(Clone, Debug)]
pub struct Part {
    pub solid: Solid,
    /// How softly it joins the parts before it: 0 keeps the crease.
    pub blend_mm: f32,
    /// How far the inner surface lies inside the outer one: cortex of a bone, fat under the skin, wall of a gut.
    pub shell_mm: f32,
    /// Whether it is taken away from the parts before it rather than joined to them.
    pub carve: bool,
}

impl Part {
    fn cut(&self, z_mm: f32, margin_mm: f32) -> Option<Cut<'_>> {
        self.solid.cut(z_mm, margin_mm)
    }

    /// The mirror image in the body's midplane.
    pub fn mirrored(&self) -> Self {
        Self { solid: self.solid.mirrored(), ..*self }
    }
}

/// Something that bounds a shape.
#[derive(Clone, Debug)]
pub struct Clip {
    pub solid: Solid,
    pub keep: Keep,
    /// The gap between the solid and the shape; for the inner surface `shell_mm` more.
    pub gap_mm: f32,
    pub shell_mm: f32,
}

/// Which side of a clip a shape keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Keep {
    Inside,
    Outside,
}

/// The surface from which a layer's depth is counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    Outer,
    Inner,
}

/// All deeper than `inset_mm` under a surface is of one tissue, until the next layer.
#[derive(Clone, Copy, Debug)]
pub struct Layer {
    pub surface: Surface,
    pub inset_mm: f32,
    pub tissue: Tissue,
}

impl Layer {
    pub const fn outer(inset_mm: f32, tissue: Tissue) -> Self {
        Self { surface: Surface::Outer, inset_mm, tissue }
    }

    pub const fn inner(inset_mm: f32, tissue: Tissue) -> Self {
        Self { surface: Surface::Inner, inset_mm, tissue }
    }
}

/// A body part: painted over what was painted before it.
#[derive(Clone, Debug)]
pub struct Shape {
    pub parts: Vec<Part>,
    pub clips: Vec<Clip>,
    /// Outermost first.
    pub layers: Vec<Layer>,
}

impl Shape {
    pub fn new(parts: Vec<Part>, layers: Vec<Layer>) -> Self {
        Self { parts, clips: Vec::new(), layers }
    }

    /// What of the shape meets the slice at `z_mm`; `ramp_mm` is the width of its partial-volume edge.
    pub fn cut(&self, z_mm: f32, ramp_mm: f32) -> Option<ShapeCut<'_>> {
        let mut clips = Vec::new();
        for clip in &self.clips {
            match clip.solid.cut(z_mm, ramp_mm + clip.gap_mm) {
                Some(cut) => clips.push((cut, clip)),
                None if clip.keep == Keep::Inside => return None,
                None => {}
            }
        }
        // A part is felt as far away as the softest join of the shape reaches; distances that far off are rough.
        let softest_mm = self.parts.iter().fold(0.0, |widest: f32, part| widest.max(part.blend_mm));
        let margin_mm = 0.5 * ramp_mm + 1.4 * softest_mm;
        let cut = |part| Some((Part::cut(part, z_mm, margin_mm)?, part));
        let parts: Vec<_> = self.parts.iter().filter_map(cut).collect();
        let has_inner = self.layers.iter().any(|layer| layer.surface == Surface::Inner);
        (!parts.is_empty()).then_some(ShapeCut { parts, clips, layers: &self.layers, has_inner })
    }
}

/// A shape at one slice.
#[derive(Clone, Debug)]
pub struct ShapeCut<'a> {
    pub parts: Vec<(Cut<'a>, &'a Part)>,
    pub clips: Vec<(Cut<'a>, &'a Clip)>,
    pub layers: &'a [Layer],
    pub has_inner: bool,
}
