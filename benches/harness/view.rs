use glam::DVec3;
use glassbrick::{Camera, NamedView, Projection, VolumeDesc};

/// The eye's distance from the volume's middle in the views of the fly-in, of that of the default framing.
const FLY_IN: [f64; 3] = [0.75, 0.5, 0.25];

/// An eye inside sees more than one outside.
const INSIDE_FOV_Y_DEG: f64 = 60.0;

/// A view that is measured, of any volume.
#[derive(Clone, Debug, PartialEq)]
pub struct View {
    /// The name in results: `turn-045` is at 45°, `fly-25` a quarter of the way from the middle, and `inside`.
    pub name: String,
    viewpoint: Viewpoint,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Viewpoint {
    /// In the default framing, turned from the front to the patient's left.
    Turned { azimuth_deg: f64 },
    /// From the front, nearer than the default framing by this factor.
    Nearer { distance: f64 },
    /// From the middle of the volume along its longest axis.
    Inside,
}

/// A turntable of so many views, a fly-in from the front, and an eye inside.
pub fn views(turntable: u32) -> Vec<View> {
    let turned = (0..turntable).map(|turn| {
        let azimuth_deg = 360.0 * f64::from(turn) / f64::from(turntable);
        View { name: format!("turn-{azimuth_deg:03.0}"), viewpoint: Viewpoint::Turned { azimuth_deg } }
    });
    let nearer = FLY_IN.map(|distance| View {
        name: format!("fly-{:.0}", 100.0 * distance),
        viewpoint: Viewpoint::Nearer { distance },
    });
    let inside = View { name: "inside".to_owned(), viewpoint: Viewpoint::Inside };
    turned.chain(nearer).chain([inside]).collect()
}

impl View {
    /// The camera for a volume.
    pub fn camera(&self, desc: &VolumeDesc) -> Camera {
        let front = Camera::framing(desc, NamedView::Front);
        match self.viewpoint {
            Viewpoint::Turned { azimuth_deg } => Camera::framing_around(desc, azimuth_deg, 0.0),
            Viewpoint::Nearer { distance } => {
                Camera { eye_mm: front.target_mm + distance * (front.eye_mm - front.target_mm), ..front }
            }
            Viewpoint::Inside => inside(desc, front.target_mm),
        }
    }
}

fn inside(desc: &VolumeDesc, middle_mm: DVec3) -> Camera {
    let edges_mm = desc.extent.as_dvec3() * desc.spacing_mm;
    let longest = edges_mm.max_position();
    let along = desc.direction.col(longest);
    // Any other axis of the volume is a sound up.
    let up = desc.direction.col(if longest == 2 { 1 } else { 2 });
    Camera {
        projection: Projection::Perspective { fov_y_deg: INSIDE_FOV_Y_DEG },
        eye_mm: middle_mm,
        target_mm: middle_mm + along * edges_mm[longest] / 2.0,
        up,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glassbrick::StoredType;

    #[test]
    fn every_view_is_a_sound_camera_with_its_own_name() {
        let views = views(8);
        assert_eq!(views.len(), 8 + FLY_IN.len() + 1);
        let mut names: Vec<&str> = views.iter().map(|view| view.name.as_str()).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), views.len());
        for extent in [[100, 60, 400], [400, 60, 100], [60, 300, 300]] {
            let desc = VolumeDesc::new(extent.into(), StoredType::U8);
            assert!(views.iter().all(|view| view.camera(&desc).basis().is_ok()), "{extent:?}");
        }
    }

    #[test]
    fn a_turntable_begins_in_front_and_the_fly_in_comes_nearer() {
        let desc = VolumeDesc::new([100, 60, 400].into(), StoredType::U8);
        let views = views(4);
        let front = Camera::framing(&desc, NamedView::Front);
        assert!(views[0].camera(&desc).eye_mm.distance(front.eye_mm) < 1e-9);
        let distance = |view: &View| view.camera(&desc).eye_mm.distance(front.target_mm);
        assert!(views[3..7].windows(2).all(|pair| distance(&pair[1]) < distance(&pair[0])));
        assert!(distance(&views[7]) < 1e-9);
    }
}
