use super::distribution::{ALL, Distribution};

/// What surrounds an object: it is where the volume's faces are, and darker, or brighter, than all else.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Background {
    /// Its most frequent value.
    pub level: f64,
    /// Where its values end towards the object's, noise included.
    pub edge: f64,
    /// The value that parts it from the object.
    pub threshold: f64,
    /// Whether the object has the lower values.
    pub object_below: bool,
}

impl Background {
    pub fn of(distribution: &Distribution) -> Option<Self> {
        let ends = [0.001, 0.999].map(|fraction| distribution.quantile(fraction, ALL));
        let [low, high] = if ends[1] > ends[0] { ends } else { distribution.histogram.range };
        let width = high - low;
        let level = distribution.face_mode(0.02 * width);
        let object_below = object_is_below(distribution, level, [low, high])?;
        Some(if object_below {
            let threshold = distribution.threshold([low, level.max(low + 0.5 * width)]);
            let edge = distribution.face_quantile(0.01, [threshold, ALL[1]]);
            Self { level, edge, threshold, object_below }
        } else {
            let threshold = distribution.threshold([level.min(high - 0.5 * width), high]);
            let edge = distribution.face_quantile(0.99, [ALL[0], threshold]);
            Self { level, edge, threshold, object_below }
        })
    }

    /// The values in which the object is shown.
    pub fn object(&self) -> [f64; 2] {
        let middle = 0.5 * (self.level + self.threshold);
        if self.object_below { [ALL[0], middle.min(self.edge)] } else { [middle.max(self.edge), ALL[1]] }
    }
}

/// Whether an object lies below the background's level or above it; none where there seems to be no background.
fn object_is_below(distribution: &Distribution, level: f64, [low, high]: [f64; 2]) -> Option<bool> {
    /// A background is this close to one end of the values.
    const NEAR_END: f64 = 0.35;
    /// Noise that is no wider than this on either side, and holds this much of the faces, is a background's.
    const NOISE: f64 = 0.03;
    const MUCH: f64 = 0.25;
    /// Otherwise values on the faces must differ so much from those of all voxels.
    const APART: f64 = 0.8;

    let width = high - low;
    let noise = [level - NOISE * width, level + NOISE * width];
    if level < low + NEAR_END * width {
        return Some(false);
    }
    let above = distribution.faces_above();
    if above > APART || (level > high - NEAR_END * width && distribution.face_fraction(noise) > MUCH) {
        return Some(true);
    }
    (above < 1.0 - APART).then_some(false)
}
