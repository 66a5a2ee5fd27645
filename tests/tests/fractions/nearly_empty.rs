//! Bricks that α and β drop are those that counting their voxels drops.

use glassbrick::{NearlyEmpty, OpenSettings, RenderRequest};
use glassbrick_tests::drawing::{camera, request};
use glassbrick_tests::reference::{ControlPoint, bricks_kept, bricks_not_empty};

use super::LAYOUTS;
use super::phantoms::{in_bytes, opened, phantoms, points, scene, views};

const NEARLY_EMPTY: [[f64; 2]; 6] =
    [[0.0, 1.0], [0.3, 1.0], [0.0, 0.7], [0.6, 0.4], [0.02, 0.98], [1.0, 0.0]];

/// Fat, and bone that is not the hardest.
fn two_bands() -> Vec<ControlPoint> {
    let point = |(value, opacity)| ControlPoint { value, color: [1.0, 0.8, 0.6], opacity };
    [(-200.0, 0.0), (-100.0, 0.3), (-10.0, 0.0), (200.0, 0.0), (500.0, 0.6), (900.0, 0.0)].map(point).to_vec()
}

/// In bytes no core spans more than 256 values, so each value has a bin of its own and tables are exact.
#[test]
fn alpha_and_beta_drop_what_counting_voxels_drops() {
    let phantom = in_bytes(&phantoms()[0]);
    for points in [points("ct-lung"), two_bands()] {
        for layout in LAYOUTS {
            let volume = opened(&phantom, &OpenSettings { layout, ..OpenSettings::default() });
            let scene = scene(&phantom, points.clone(), views(&phantom)[0]);
            let core = layout.core() as usize;
            let count = |bricks: Vec<bool>| bricks.into_iter().filter(|&is_in| is_in).count();
            let not_empty = count(bricks_not_empty(&scene.reference(), core));
            let kept = NEARLY_EMPTY.map(|[alpha, beta]| {
                let kept = count(bricks_kept(&scene.reference(), core, alpha, beta));
                let nearly_empty = NearlyEmpty { alpha, beta };
                let asked = RenderRequest { nearly_empty, size: [8, 8], ..request(&scene) };
                let bricks = volume.render(asked, &camera(&scene)).expect("it can be drawn").report.bricks;
                let what = format!("edge {}, alpha {alpha}, beta {beta}: {bricks:?}", layout.edge);
                assert_eq!(bricks.total - bricks.empty, not_empty, "{what}");
                assert_eq!(bricks.filtered_visible, kept, "{what}");
                assert!(bricks.in_frustum <= kept, "{what}");
                kept
            });
            let [all, some @ .., none] = kept;
            assert!(all == not_empty && none == 0, "{kept:?}");
            assert!(some.iter().any(|&kept| (1..all).contains(&kept)), "nothing is tested: {kept:?}");
        }
    }
}
