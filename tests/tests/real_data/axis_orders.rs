use std::fs;

use glassbrick::{Camera, Frame, NamedView, OpenSettings, RenderRequest, Volume, preset};
use glassbrick_tests::tolerance::{CPU, compare};

use super::data;

/// The files hold one head in every order and direction of the voxel axes; in the world it is the same.
#[test]
fn a_head_is_the_same_picture_whatever_the_order_of_its_axes() {
    let Some(data) = data() else { return };
    let folder = fs::read_dir(data.join("nifti-odd/nifti_space")).expect("a folder");
    let mut paths: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    assert!(paths.len() >= 24, "{} files", paths.len());
    let mut first: Option<[Frame; 2]> = None;
    for path in paths {
        let volume = Volume::open(&path, &OpenSettings::default(), |_, _| ())
            .unwrap_or_else(|error| panic!("{error}"));
        let frames = [NamedView::Front, NamedView::Left].map(|view| front(&volume, view));
        let Some(first) = &first else {
            first = Some(frames);
            continue;
        };
        for (frame, first) in frames.iter().zip(first) {
            let expected: Vec<[f64; 4]> = first.rgba.iter().map(|pixel| pixel.map(f64::from)).collect();
            let difference = compare(&frame.rgba, &expected);
            assert!(difference.is_within(CPU), "{}: {difference}", path.display());
        }
    }
    let [front, left] = first.expect("there are files");
    assert_ne!(front, left);
}

fn front(volume: &Volume, view: NamedView) -> Frame {
    let function = preset("mr", volume.value_range()).expect("a preset");
    let request = RenderRequest { size: [96, 96], ..RenderRequest::new(function) };
    let camera = Camera::framing(volume.desc(), view).zoomed(1.6);
    volume.render(request, &camera).expect("it can be drawn").frame
}
