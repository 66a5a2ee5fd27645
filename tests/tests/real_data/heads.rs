use glam::DVec3;
use glassbrick::{Camera, Frame, NamedView, RenderRequest, TransferFunction, Volume, preset};

use super::surfaces::opaque_from;
use super::{data, open};

const PIXELS: u32 = 256;

/// What is seen from a named side, as points in the world, pixel by pixel; nothing where a pixel shows nothing opaque.
struct Seen {
    points: Vec<Option<DVec3>>,
}

fn seen(volume: &Volume, view: NamedView, function: TransferFunction) -> Seen {
    let request = RenderRequest { size: [PIXELS; 2], step_voxels: 0.5, ..RenderRequest::new(function) };
    let camera = Camera::framing(volume.desc(), view);
    let Frame { depth_mm, .. } = volume.render(request, &camera).expect("it can be drawn").frame;

    // By the definition of the default framing: the eye looks at the box's centre, 30° high.
    let corners = volume.desc().corners_mm();
    let centre = corners.iter().sum::<DVec3>() / 8.0;
    let radius = corners.iter().map(|corner| corner.distance(centre)).fold(0.0, f64::max);
    let distance = radius / 15f64.to_radians().sin();
    let (toward_eye, up) = match view {
        NamedView::Front => (DVec3::NEG_Y, DVec3::Z),
        NamedView::Left => (DVec3::X, DVec3::Z),
        _ => panic!("only these two are looked at"),
    };
    let (eye, forward) = (centre + toward_eye * distance, -toward_eye);
    let right = forward.cross(up);
    let point = |(pixel, &depth): (usize, &f32)| {
        let at =
            |index: usize| (2.0 * (index as f64 + 0.5) / f64::from(PIXELS) - 1.0) * 15f64.to_radians().tan();
        let (x, y) = (at(pixel % PIXELS as usize), -at(pixel / PIXELS as usize));
        depth.is_finite().then(|| eye + f64::from(depth) * (forward + x * right + y * up))
    };
    Seen { points: depth_mm.iter().enumerate().map(point).collect() }
}

impl Seen {
    /// The pixel, as column and row, and the point at which something is smallest.
    fn least(&self, of: impl Fn(DVec3) -> f64) -> ([u32; 2], DVec3) {
        let seen =
            self.points.iter().enumerate().filter_map(|(pixel, point)| Some((pixel as u32, (*point)?)));
        let (pixel, point) = seen.min_by(|a, b| of(a.1).total_cmp(&of(b.1))).expect("something is seen");
        ([pixel % PIXELS, pixel / PIXELS], point)
    }

    /// How many pixels show a point in the box.
    fn pixels_in(&self, low: DVec3, high: DVec3) -> usize {
        let inside = |point: &&DVec3| point.cmpge(low).all() && point.cmple(high).all();
        self.points.iter().flatten().filter(inside).count()
    }

    /// How many pixels of the row through `z_mm` show something before `behind_mm`.
    fn width(&self, z_mm: f64, behind_mm: f64) -> usize {
        let width = |row: &[Option<DVec3>]| {
            let before = row.iter().flatten().filter(|point| point.y < behind_mm);
            (before.clone().map(|point| (point.z - z_mm).abs()).fold(f64::INFINITY, f64::min), before.count())
        };
        let rows = self.points.chunks_exact(PIXELS as usize).map(width);
        rows.min_by(|a, b| a.0.total_cmp(&b.0)).expect("there are rows").1
    }
}

fn assert_near(found: DVec3, expected: [f64; 3], tolerance_mm: f64) {
    let off = (found - DVec3::from_array(expected)).length();
    assert!(off < tolerance_mm, "{found} is {off} mm from {expected:?}");
}

/// The places were found in the voxels with SimpleITK. The scan ends at the crown and below the shoulders.
#[test]
fn the_visible_human_looks_at_the_viewer() {
    let Some(data) = data() else { return };
    let volume = open(&data, "vhp-male-head-ct/head-245-dicom.tar.xz:Head");
    let named = |name| preset(name, volume.value_range()).expect("a preset");

    let skin = seen(&volume, NamedView::Front, named("ct-skin"));
    let (nose_pixel, nose) = skin.least(|point| point.y);
    assert_near(nose, [253.0, 136.0, 1080.0], 5.0);
    assert!(nose_pixel[0].abs_diff(PIXELS / 2) < 4 && nose_pixel[1] > PIXELS / 2, "{nose_pixel:?}");
    let (crown, crown_point) = skin.least(|point| if point.y < 330.0 { -point.z } else { 0.0 });
    assert!(crown_point.z > 1240.0 && crown[1] < PIXELS / 2, "{crown:?} shows {crown_point}");
    // The row on top is above the face, the face above the shoulders.
    let [crown, face, shoulders] = [1240.0, 1110.0, 1003.0].map(|z| skin.width(z, 330.0));
    assert!(crown < face * 3 / 4 && face < shoulders * 3 / 4, "{crown}, {face}, {shoulders} pixels wide");

    // The tip of the left shoulder is the only bone beside the neck.
    let bone = seen(&volume, NamedView::Front, named("ct-bone"));
    let beside = |x: [f64; 2]| bone.pixels_in(DVec3::new(x[0], 0.0, 999.0), DVec3::new(x[1], 512.0, 1012.0));
    let (left, right) = (beside([370.0, 425.0]), beside([512.0 - 425.0, 512.0 - 370.0]));
    assert!(left > 10 && right == 0, "{left} pixels on the patient's left, {right} on the right");
    let (outermost, shoulder) = bone.least(|point| if point.z < 1012.0 { -point.x } else { 0.0 });
    assert_near(shoulder, [415.0, 273.0, 1003.0], 15.0);
    assert!(outermost[0] > PIXELS / 2 && outermost[1] > PIXELS / 2, "the patient's left is on the right");

    // From the patient's left, the face is on the picture's left.
    let profile = seen(&volume, NamedView::Left, named("ct-skin"));
    let (nose_pixel, nose) = profile.least(|point| point.y);
    assert!(nose.y < 142.0 && nose_pixel[0] < PIXELS / 2, "{nose_pixel:?} shows {nose}");
}

#[test]
fn an_oblique_head_looks_at_the_viewer_too() {
    let Some(data) = data() else { return };
    let volume = open(&data, "studyforrest-t1-mri-dicom/dicoms-384.tar.xz:dicoms");
    let head = seen(&volume, NamedView::Front, opaque_from(60.0));
    let (forehead_pixel, forehead) = head.least(|point| point.y);
    assert_near(forehead, [-3.5, -107.9, 24.7], 4.0);
    assert!(forehead_pixel[0].abs_diff(PIXELS / 2) < 16, "{forehead_pixel:?}");
    let (crown, crown_point) = head.least(|point| -point.z);
    assert!((crown_point.z - 86.5).abs() < 4.0 && crown[1] < PIXELS / 2, "{crown:?} shows {crown_point}");
    assert!(head.width(80.0, 100.0) < head.width(20.0, 100.0));
    let profile = seen(&volume, NamedView::Left, opaque_from(60.0));
    let (forehead_pixel, _) = profile.least(|point| point.y);
    assert!(forehead_pixel[0] < PIXELS / 2, "{forehead_pixel:?}");
}
