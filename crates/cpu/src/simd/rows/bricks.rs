use std::sync::OnceLock;

use glassbrick_volume::{PlannedBrick, ReadError};

use super::super::projection::Projection;
use super::march::Lined;
use super::voxels::{RowBrick, RowVoxel};
use crate::executor::{HeldBrick, Picture};

/// A brick that has been looked at.
pub type Prepared<'a, P, V> = Lined<'a, V, <P as Projection>::RowCells<'a>>;

/// The bricks of a frame, by place in the grid, that are loaded and looked at when a ray first needs them.
pub struct Bricks<'a, P: Projection, V> {
    planned: Vec<Option<&'a PlannedBrick>>,
    /// Bricks of a line along x.
    counts_x: usize,
    held: &'a [HeldBrick],
    prepared: Vec<OnceLock<Option<Prepared<'a, P, V>>>>,
}

impl<'a, P: Projection, V: RowVoxel> Bricks<'a, P, V> {
    pub fn new(picture: &Picture<'a>, held: &'a [HeldBrick]) -> Self {
        let mut planned = vec![None; held.len()];
        for brick in picture.scene.plan.layers.iter().flat_map(|layer| &layer.bricks) {
            planned[brick.index as usize] = Some(brick);
        }
        let counts_x = picture.grid.counts.x as usize;
        Self { planned, counts_x, held, prepared: held.iter().map(|_| OnceLock::new()).collect() }
    }

    /// The planned bricks of a line along x, by its first place in the grid.
    pub fn line(&self, first: usize) -> &[Option<&'a PlannedBrick>] {
        &self.planned[first..first + self.counts_x]
    }

    /// Whether a brick was asked for before.
    pub fn is_held(&self, planned: &PlannedBrick) -> bool {
        self.held[planned.index as usize].get().is_some()
    }

    /// A planned brick; nothing where it holds nothing to draw.
    pub fn get(
        &self,
        projection: &P,
        picture: &Picture<'a>,
        planned: &'a PlannedBrick,
    ) -> Result<Option<&Prepared<'a, P, V>>, ReadError> {
        let place = planned.index as usize;
        if let Some(prepared) = self.prepared[place].get() {
            return Ok(prepared.as_ref());
        }
        let Some(brick) = picture.hold(planned, &self.held[place])? else { return Ok(None) };
        let prepared = self.prepared[place].get_or_init(|| {
            let view = picture.view(planned, brick);
            let voxels = V::of(&brick.voxels).expect("bricks hold voxels of the volume's type");
            let cells = projection.row_cells(&view)?;
            Some(Lined { planned, brick: RowBrick::new(&view, voxels), cells })
        });
        Ok(prepared.as_ref())
    }
}
