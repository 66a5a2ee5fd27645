use glassbrick_volume::{FrameRays, PixelRect, RowAxis};

/// How a frame is turned for its rays to go along rows of voxels from pixel to pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Turn {
    /// The volume's axis that takes the place of x.
    pub row_axis: RowAxis,
    /// Whether the picture's columns are drawn as rows.
    pub is_transposed: bool,
}

impl Turn {
    /// Every turn, the best first: none at all, then the one for views from around the z axis, so that a turntable needs no
    /// other where it comes to a view along another axis.
    const ALL: [Self; 6] = [
        Self { row_axis: RowAxis::X, is_transposed: false },
        Self { row_axis: RowAxis::Z, is_transposed: true },
        Self { row_axis: RowAxis::Y, is_transposed: false },
        Self { row_axis: RowAxis::X, is_transposed: true },
        Self { row_axis: RowAxis::Z, is_transposed: false },
        Self { row_axis: RowAxis::Y, is_transposed: true },
    ];

    /// Two things, one for each axis of the picture, from the picture to the turned one and back.
    pub fn of_picture<T>(self, [across, down]: [T; 2]) -> [T; 2] {
        if self.is_transposed { [down, across] } else { [across, down] }
    }

    /// Pixels of the picture in the turned one.
    pub fn rect(self, rect: &PixelRect) -> PixelRect {
        PixelRect { min: self.of_picture(rect.min), max: self.of_picture(rect.max) }
    }
}

/// Rays that go along rows of voxels from pixel to pixel: in a frame and volume that are turned so, all rays of a row of
/// the picture have the same place along y and z at each sample, and all rays of a column the same along x.
pub struct RowRays {
    pub turn: Turn,
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
    /// The rays of a frame; nothing where they do not go along rows, however it is turned.
    pub fn new(rays: &FrameRays, padding: usize) -> Option<Self> {
        Turn::ALL.into_iter().find_map(|turn| Self::turned(rays, turn, padding))
    }

    fn turned(rays: &FrameRays, turn: Turn, padding: usize) -> Option<Self> {
        let [width, height] = turn.of_picture(rays.size.to_array());
        let ray = |column: u32, row: u32| {
            let [column, row] = turn.of_picture([column, row]);
            let ray = rays.ray(column, row);
            [ray.start, ray.step].map(|vector| turn.row_axis.swapped(vector.to_array()))
        };
        // Rounding keeps order: what is the same at both ends of a column or row is the same between them.
        let columns = (0..width).map(|column| {
            let [top, bottom] =
                [ray(column, 0), ray(column, height - 1)].map(|vectors| vectors.map(|[x, ..]| x));
            (top == bottom).then_some((top[0], top[1]))
        });
        let (mut start_x, mut step_x): (Vec<f32>, Vec<f32>) =
            columns.collect::<Option<Vec<_>>>()?.into_iter().unzip();
        let rows = (0..height).map(|row| {
            let [left, right] =
                [ray(0, row), ray(width - 1, row)].map(|vectors| vectors.map(|[_, y, z]| [y, z]));
            (left == right).then_some(RowRay { start: left[0], step: left[1] })
        });
        let rows = rows.collect::<Option<Vec<_>>>()?;
        let columns = start_x.len();
        start_x.resize(start_x.len() + padding, 0.0);
        step_x.resize(step_x.len() + padding, 0.0);
        Some(Self { turn, start_x, step_x, columns, rows })
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
    fn frames_are_turned_for_their_rays_to_go_along_rows() {
        let desc = VolumeDesc::new(UVec3::new(30, 50, 40), StoredType::U8);
        let turn = |camera: &Camera| {
            let rays = FrameRays::new(&desc.level(0), camera, UVec2::new(9, 7), 1.0).expect("a sound camera");
            RowRays::new(&rays, 16).map(|rays| (rays.turn.row_axis, rays.turn.is_transposed))
        };
        for (view, expected) in [
            (NamedView::Front, (RowAxis::X, false)),
            (NamedView::Top, (RowAxis::X, false)),
            (NamedView::Left, (RowAxis::Z, true)),
            (NamedView::Right, (RowAxis::Z, true)),
        ] {
            assert_eq!(turn(&Camera::framing(&desc, view)), Some(expected), "{view:?}");
        }
        let around = |azimuth, elevation| turn(&Camera::framing_around(&desc, azimuth, elevation));
        assert_eq!(around(0.0, 40.0), Some((RowAxis::X, false)), "tilted");
        assert_eq!(around(40.0, 0.0), Some((RowAxis::Z, true)), "turned");
        assert_eq!(around(90.0, 40.0), Some((RowAxis::Y, false)), "turned and tilted");
        assert_eq!(around(40.0, 30.0), None);
        // On its side, and turned or tilted so.
        let lying = |azimuth, elevation, up| {
            turn(&Camera { up, ..Camera::framing_around(&desc, azimuth, elevation) })
        };
        assert_eq!(lying(0.0, 30.0, DVec3::X), Some((RowAxis::X, true)));
        assert_eq!(lying(90.0, 30.0, DVec3::Y), Some((RowAxis::Y, true)));
        assert_eq!(lying(30.0, 0.0, DVec3::X), Some((RowAxis::Z, false)));
    }

    #[test]
    fn fewer_pixels_are_wider() {
        let eye_mm = DVec3::new(149.5, -900.0, 149.5);
        let [fine, coarse] = [512, 64].map(|pixels| widest(pixels, eye_mm).expect("seen from the front"));
        assert!(fine > 16.0 && coarse > 4.0 * fine, "{fine} {coarse}");
    }
}
