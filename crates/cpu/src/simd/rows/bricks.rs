use std::sync::OnceLock;

use glassbrick_volume::{BrickGrid, PlannedBrick, ReadError};

use super::super::projection::Projection;
use super::march::Lined;
use super::voxels::{RowBrick, RowVoxel};
use crate::executor::{HeldBrick, Picture};

/// A brick that has been looked at.
pub type Prepared<'a, P, V> = Lined<'a, V, <P as Projection>::RowCells<'a>>;

/// The bricks of a frame that are loaded and looked at when a ray first needs them.
pub struct Bricks<'a, P: Projection, V> {
    /// The turned grid.
    pub grid: BrickGrid,
    /// By place in the turned grid.
    planned: Vec<Option<&'a PlannedBrick>>,
    /// By place in the volume's grid.
    held: &'a [HeldBrick],
    prepared: Vec<OnceLock<Option<Prepared<'a, P, V>>>>,
}

impl<'a, P: Projection, V: RowVoxel> Bricks<'a, P, V> {
    pub fn new(picture: &Picture<'a>, held: &'a [HeldBrick]) -> Self {
        let mut planned = vec![None; held.len()];
        let row_axis = picture.row_axis;
        let grid = picture.grid.along(row_axis);
        for brick in picture.scene.plan.layers.iter().flat_map(|layer| &layer.bricks) {
            let at = picture.grid.brick_along(brick.index as usize, row_axis);
            planned[grid.index(at)] = Some(brick);
        }
        Self { grid, planned, held, prepared: held.iter().map(|_| OnceLock::new()).collect() }
    }

    /// The planned bricks of a line along the rows, by its first place in the turned grid.
    pub fn line(&self, first: usize) -> &[Option<&'a PlannedBrick>] {
        &self.planned[first..first + self.grid.counts.x as usize]
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
