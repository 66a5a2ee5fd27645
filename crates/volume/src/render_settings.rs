use crate::Rescale;

/// What a ray makes of the values that it meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Direct volume rendering: emission and absorption.
    Dvr,
    /// Maximum intensity projection.
    Mip,
    /// Minimum intensity projection.
    Minip,
    /// The arithmetic mean.
    Mean,
}

impl Mode {
    /// Every mode.
    pub const ALL: [Self; 4] = [Self::Dvr, Self::Mip, Self::Minip, Self::Mean];

    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dvr => "dvr",
            Self::Mip => "mip",
            Self::Minip => "minip",
            Self::Mean => "mean",
        }
    }
}

impl Mode {
    /// 1 where a projection looks for the largest stored value, −1 for the smallest: a negative slope turns the largest
    /// value into the smallest stored one.
    pub fn sign(self, rescale: Rescale) -> f32 {
        if (self != Self::Minip) == (rescale.slope > 0.0) { 1.0 } else { -1.0 }
    }
}

/// Light from the eye on surfaces (Phong 1975), for direct volume rendering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phong {
    pub ambient: f32,
    pub diffuse: f32,
    pub specular: f32,
    pub shininess: f32,
}

impl Default for Phong {
    fn default() -> Self {
        Self { ambient: 0.1, diffuse: 0.9, specular: 0.2, shininess: 10.0 }
    }
}

/// What an executor may leave out. The picture is the same; `None` draws it without the opacity cutoff.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skip {
    /// Every brick in the frustum is drawn, and the cutoff ignored.
    None,
    /// Empty bricks are skipped, and each ray stops at the cutoff.
    Empty,
    /// Bricks that are hidden, or cannot change any pixel, are skipped too.
    All,
}

/// How a frame is drawn, besides camera and transfer function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RenderSettings {
    pub mode: Mode,
    /// Applies to [`Mode::Dvr`].
    pub shading: Option<Phong>,
    /// A ray stops after the first sample at which its opacity reaches this; 1 never stops.
    pub opacity_cutoff: f64,
    pub skip: Skip,
}

impl Default for RenderSettings {
    fn default() -> Self {
        Self { mode: Mode::Dvr, shading: None, opacity_cutoff: 0.998, skip: Skip::All }
    }
}

impl RenderSettings {
    /// The cutoff that is in force: none at all where nothing is skipped.
    pub fn effective_cutoff(&self) -> f32 {
        if self.skip == Skip::None || self.opacity_cutoff >= 1.0 {
            f32::INFINITY
        } else {
            self.opacity_cutoff as f32
        }
    }
}
