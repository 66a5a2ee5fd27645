use super::Row;
use crate::vector::{Vec3, mirror};

/// A paraboloid that opens downwards.
#[derive(Clone, Copy, Debug)]
pub struct Dome {
    pub top: Vec3,
    /// How far it falls, in mm, per mm² from the top along x and y.
    pub fall: [f32; 2],
}

/// All that lies below the higher of two domes: the diaphragm is their surface.
#[derive(Clone, Debug)]
pub struct Domes(pub [Dome; 2]);

impl Domes {
    pub(super) fn mirrored(&self) -> Self {
        Self(self.0.map(|dome| Dome { top: mirror(dome.top), ..dome }))
    }

    pub(super) fn distances(&self, row: &Row, out: &mut [f32]) {
        let [left, right] = self.0;
        let crest = |dome: &Dome| dome.top[2] - dome.fall[1] * (row.first_mm[1] - dome.top[1]).powi(2);
        let (left_crest, right_crest) = (crest(&left), crest(&right));
        for (i, distance) in out.iter_mut().enumerate() {
            let x = row.x(i);
            let (dl, dr) = (x - left.top[0], x - right.top[0]);
            let height = (left_crest - left.fall[0] * dl * dl).max(right_crest - right.fall[0] * dr * dr);
            // The mean slope of the domes, so that the height above them is nearly a distance.
            *distance = (row.first_mm[2] - height) * 0.75;
        }
    }
}
