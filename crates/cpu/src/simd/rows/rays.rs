use glassbrick_volume::FrameRays;

/// Rays that go along the volume's rows from pixel to pixel: all rays of a row of the picture have the same place along
/// y and z at each sample, and all rays of a column the same along x.
pub struct RowRays {
    /// Position of sample number 0 and the step along x, of each column and some more that mean nothing.
    pub start_x: Vec<f32>,
    pub step_x: Vec<f32>,
    columns: usize,
    /// Of each row of the picture.
    pub rows: Vec<RowRay>,
}

/// What the rays of a row of the picture have in common: place and step along y and z.
#[derive(Clone, Copy)]
pub struct RowRay {
    pub start: [f32; 2],
    pub step: [f32; 2],
}

impl RowRays {
    /// The rays of a frame; nothing where they do not go along rows.
    pub fn new(rays: &FrameRays, padding: usize) -> Option<Self> {
        let [width, height] = rays.size.to_array();
        // Rounding keeps order: what is the same at both ends of a column or row is the same between them.
        let columns = (0..width).map(|column| {
            let (top, bottom) = (rays.ray(column, 0), rays.ray(column, height - 1));
            (top.start.x == bottom.start.x && top.step.x == bottom.step.x)
                .then_some((top.start.x, top.step.x))
        });
        let (mut start_x, mut step_x): (Vec<f32>, Vec<f32>) =
            columns.collect::<Option<Vec<_>>>()?.into_iter().unzip();
        let rows = (0..height).map(|row| {
            let [left, right] = [rays.ray(0, row), rays.ray(width - 1, row)]
                .map(|ray| RowRay { start: [ray.start.y, ray.start.z], step: [ray.step.y, ray.step.z] });
            (left.start == right.start && left.step == right.step).then_some(left)
        });
        let rows = rows.collect::<Option<Vec<_>>>()?;
        let columns = start_x.len();
        start_x.resize(start_x.len() + padding, 0.0);
        step_x.resize(step_x.len() + padding, 0.0);
        Some(Self { start_x, step_x, columns, rows })
    }

    /// The most voxels along x that so many rays side by side, and their ways through a line of bricks, take up.
    pub fn widest(&self, rays: usize, core: u32, sample_count: u32) -> f32 {
        let apart = |number: f32| {
            let at = |column: usize| self.start_x[column] + number * self.step_x[column];
            let last = self.columns - 1;
            (at(last) - at(0)).abs() / (last.max(1)) as f32 * rays as f32
        };
        // A line of bricks is left after a core along y or z, and so many more voxels along x.
        let most_along_x = self.step_x[..self.columns].iter().fold(0.0f32, |most, step| most.max(step.abs()));
        let along_others = |row: &RowRay| row.step[0].abs().max(row.step[1].abs());
        let least_along_others = self.rows.iter().map(along_others).fold(f32::INFINITY, f32::min);
        let aside = most_along_x / least_along_others * (core as f32 + least_along_others);
        apart(0.0).max(apart(sample_count as f32)) + aside
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, UVec2, UVec3};
    use glassbrick_volume::{Camera, NamedView, StoredType, VolumeDesc};

    use super::*;

    fn widest(pixels: u32, eye_mm: DVec3) -> Option<f32> {
        let desc = VolumeDesc::new(UVec3::splat(300), StoredType::U8);
        let centre = DVec3::splat(149.5);
        let camera = Camera { eye_mm, target_mm: centre, ..Camera::framing(&desc, NamedView::Front) };
        let rays =
            FrameRays::new(&desc.level(0), &camera, UVec2::splat(pixels), 1.0).expect("a sound camera");
        Some(RowRays::new(&rays, 16)?.widest(16, 60, rays.sample_count))
    }

    #[test]
    fn rays_along_x_take_up_all_of_it() {
        let along_x = widest(1, DVec3::new(-500.0, 149.5, 149.5)).expect("a single ray is a row of its own");
        assert!(along_x > 1e6, "{along_x}");
        let along_y = widest(1, DVec3::new(149.5, -500.0, 149.5)).expect("a single ray is a row of its own");
        assert!(along_y < 1.0, "{along_y}");
    }

    #[test]
    fn fewer_pixels_are_wider() {
        let eye_mm = DVec3::new(149.5, -900.0, 149.5);
        let [fine, coarse] = [512, 64].map(|pixels| widest(pixels, eye_mm).expect("seen from the front"));
        assert!(fine > 16.0 && coarse > 4.0 * fine, "{fine} {coarse}");
    }
}
