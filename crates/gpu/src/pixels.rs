//! From what passes gather to the pixels of a frame.

use glassbrick_shaders::{Pixels, RayState};
use glassbrick_volume::{BakedTransferFunction, Frame, FrameRays, Mode, PixelRect, RenderSettings, Rescale};

/// How passes form the pixels of these settings.
pub fn pixels(settings: &RenderSettings) -> Pixels {
    match (settings.mode, settings.shading) {
        (Mode::Dvr, None) => Pixels::Dvr,
        (Mode::Dvr, Some(_)) => Pixels::DvrShaded,
        (Mode::Mip | Mode::Minip, _) => Pixels::Extremum,
        (Mode::Mean, _) => Pixels::Mean,
    }
}

/// Turns what was gathered into pixels.
pub struct Finish<'a> {
    pub pixels: Pixels,
    pub rays: &'a FrameRays,
    pub transfer_function: &'a BakedTransferFunction,
    pub rescale: Rescale,
    /// 1 where the largest stored value was looked for, −1 for the smallest.
    pub sign: f32,
}

impl Finish<'_> {
    /// Writes a tile of marched rays into the frame.
    pub fn rays(&self, frame: &mut Frame, tile: &PixelRect, states: &[RayState]) {
        self.place(frame, tile, states, |state| {
            let (rgba, has_depth) = match self.pixels {
                Pixels::Dvr | Pixels::DvrShaded => (state.gathered, true),
                Pixels::Extremum if state.surface == 0 => ([0.0; 4], false),
                Pixels::Extremum => (self.projected((self.sign * state.gathered[0]).into()), true),
                Pixels::Mean => (self.mean(state.gathered[0].into(), state.gathered[2]), false),
            };
            let number = state.surface.checked_sub(1).filter(|_| has_depth);
            (rgba, number.map_or(f32::INFINITY, |number| self.rays.depth_mm(number) as f32))
        });
    }

    /// Writes a tile of what slices added up into the frame: colours, extremal values, or sums and counts.
    pub fn slices(&self, frame: &mut Frame, tile: &PixelRect, gathered: &[[f32; 4]]) {
        self.place(frame, tile, gathered, |&gathered| {
            let rgba = match self.pixels {
                Pixels::Dvr | Pixels::DvrShaded => gathered,
                Pixels::Extremum if gathered[3] == 0.0 => [0.0; 4],
                Pixels::Extremum => self.projected(gathered[0].into()),
                Pixels::Mean => self.mean(gathered[0].into(), gathered[1]),
            };
            (rgba, f32::INFINITY)
        });
    }

    fn mean(&self, sum: f64, samples: f32) -> [f32; 4] {
        if samples == 0.0 { [0.0; 4] } else { self.projected(sum / f64::from(samples)) }
    }

    fn projected(&self, stored: f64) -> [f32; 4] {
        self.transfer_function.projected(self.rescale.value(stored))
    }

    fn place<T>(
        &self,
        frame: &mut Frame,
        tile: &PixelRect,
        gathered: &[T],
        pixel: impl Fn(&T) -> ([f32; 4], f32),
    ) {
        let width = (tile.max[0] - tile.min[0]) as usize;
        for (row, gathered) in gathered.chunks_exact(width).enumerate() {
            let start = (tile.min[1] as usize + row) * frame.width as usize + tile.min[0] as usize;
            for (place, gathered) in (start..).zip(gathered) {
                (frame.rgba[place], frame.depth_mm[place]) = pixel(gathered);
            }
        }
    }
}
