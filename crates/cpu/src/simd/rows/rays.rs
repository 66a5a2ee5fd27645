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

    /// The most voxels along x that so many rays side by side are apart at any sample.
    pub fn widest(&self, rays: usize, sample_count: u32) -> f32 {
        let apart = |number: f32| {
            let at = |column: usize| self.start_x[column] + number * self.step_x[column];
            let last = self.columns - 1;
            (at(last) - at(0)).abs() / (last.max(1)) as f32 * rays as f32
        };
        apart(0.0).max(apart(sample_count as f32))
    }
}
