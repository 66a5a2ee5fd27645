use std::collections::HashSet;

use glassbrick::{OpenSettings, RenderRequest, Volume};
use glassbrick_volume::{ControlPoint, Mode, Skip, TransferFunction};
use proptest::prelude::*;
use proptest::sample::select;

use super::any::{View, view};
use super::cases;
use super::stored::hash;

/// The samples in the volume and the bricks that they belong to, ray by ray and sample by sample.
fn by_hand(view: &View) -> (u64, usize) {
    let (grid, rays) = (view.grid(), view.rays());
    let (mut samples, mut bricks) = (0, HashSet::new());
    for row in 0..view.size.y {
        for column in 0..view.size.x {
            let ray = rays.ray(column, row);
            for number in 0..rays.sample_count {
                if let Some(brick) = grid.owner(ray.sample(number)) {
                    samples += 1;
                    bricks.insert(grid.index(brick));
                }
            }
        }
    }
    (samples, bricks.len())
}

fn opaque() -> TransferFunction {
    let point = |value, opacity| ControlPoint { value, color: [1.0; 3], opacity };
    TransferFunction { points: vec![point(0.0, 0.0), point(128.0, 0.0), point(200.0, 1.0)], unit_mm: None }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn with_nothing_skipped_the_report_counts_every_sample_in_the_volume(
        view in view(36), seed in any::<u64>(), mode in select(Mode::ALL.to_vec()), threads in 1..=3usize,
    ) {
        let voxels: Vec<u8> = (0..view.desc.voxels()).map(|voxel| hash(seed, voxel) as u8).collect();
        let settings = OpenSettings { layout: view.layout, threads: Some(threads), ..OpenSettings::default() };
        let volume = Volume::from_array(view.desc.clone(), voxels, &settings).expect("a sound array");
        let draw = |skip| {
            let mut request = RenderRequest::new(opaque());
            (request.size, request.step_voxels) = (view.size.to_array(), view.step_voxels);
            (request.settings.mode, request.settings.skip) = (mode, skip);
            volume.render(request, &view.camera).expect("it can be drawn").report
        };
        let (samples, bricks) = by_hand(&view);
        let report = draw(Skip::None);
        prop_assert_eq!(report.samples, Some(samples));
        prop_assert_eq!(report.bricks.rendered, bricks);
        prop_assert_eq!(report.bricks.total, view.grid().len());
        prop_assert_eq!((report.bricks.empty, report.bricks.occluded), (0, 0));
        prop_assert!(report.bricks.in_frustum >= bricks && report.complete);

        let skipped = draw(Skip::All);
        prop_assert!(skipped.samples <= report.samples && skipped.bricks.rendered <= bricks);
        let counts = skipped.bricks;
        prop_assert_eq!(counts.filtered_visible + counts.empty, counts.total);
        prop_assert!(counts.in_frustum <= counts.filtered_visible);
        prop_assert!(counts.rendered + counts.occluded <= counts.in_frustum);
    }
}
