use glassbrick_volume::{ControlPoint, Mode, TransferFunction, srgb_decode};

use super::Content;
use super::distribution::{ALL, Distribution};

/// Straight pieces of the ramp. In linear light it is a curve, so that it is straight to the eye.
const PIECES: u32 = 8;

/// A window for a projection: white, and the more opaque the higher the value.
pub(super) fn transfer_function(
    content: &Content,
    distribution: &Distribution,
    mode: Mode,
) -> TransferFunction {
    let [low, high] = window(content, distribution, mode);
    // What surrounds an object is all that the smallest values show of it: it must not be quite black.
    let black: f64 = if mode == Mode::Minip { 0.12 } else { 0.0 };
    let points = (0..=PIECES).map(|piece| {
        let part = f64::from(piece) / f64::from(PIECES);
        ControlPoint {
            value: low + part * (high - low),
            color: [1.0; 3],
            opacity: srgb_decode(black.max(part)),
        }
    });
    TransferFunction { points: points.collect(), unit_mm: None }
}

fn window(content: &Content, distribution: &Distribution, mode: Mode) -> [f64; 2] {
    let all = |fraction| distribution.quantile(fraction, ALL);
    let robust = [all(0.001), all(0.999)];
    let wanted = match (content, mode) {
        (Content::Hounsfield { offset }, Mode::Mip) => {
            [offset - 150.0, all(0.9995).clamp(offset + 600.0, offset + 2000.0)]
        }
        (Content::Hounsfield { offset }, Mode::Minip) => [offset - 1024.0, offset - 400.0],
        (Content::Hounsfield { offset }, _) => means(distribution, offset - 1000.0, offset - 200.0),
        (Content::Signed(signed), Mode::Mip) => [0.0, signed.reach],
        (Content::Signed(signed), Mode::Minip) => [-signed.reach, 0.0],
        (Content::Signed(signed), _) => [-signed.quiet, signed.quiet],
        (Content::Labels, Mode::Mean) => {
            let level = distribution.face_mode(distribution.histogram.bin_width());
            means(distribution, level, level + distribution.histogram.bin_width())
        }
        (Content::Object(background), Mode::Minip) => {
            [robust[0], if background.object_below { background.edge } else { background.threshold }]
        }
        (Content::Object(background), Mode::Mip) if !background.object_below => {
            let rare = distribution.quantile(0.9, background.object());
            [0.5 * (background.level + background.edge), all(0.9995).max(rare)]
        }
        (Content::Object(background), Mode::Mean) if !background.object_below => {
            means(distribution, background.level, background.threshold)
        }
        (Content::Block, Mode::Mean) => [all(0.1), all(0.9)],
        _ => robust,
    };
    let range = distribution.histogram.range;
    [wanted, robust, range].into_iter().find(|[low, high]| high > low).unwrap_or([0.0, 1.0])
}

/// Where the means of rays through an object and what surrounds it lie, if the object's values begin at `threshold`.
fn means(distribution: &Distribution, level: f64, threshold: f64) -> [f64; 2] {
    let object = [threshold, ALL[1]];
    let inside = distribution.quantile(0.8, object);
    [level, level + (inside - level) * (1.2 * distribution.fraction(object).cbrt()).min(1.0)]
}
