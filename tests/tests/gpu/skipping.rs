//! Skipping changes what is loaded and drawn, and not the picture.

use glassbrick::{BrickLayout, Skip};
use glassbrick_tests::gpu::gpu;
use glassbrick_tests::tolerance::{GPU, compare};

use super::{Memory, ONE_TEXTURE, PASSES, difference, draw, scene, scenes_and_truths};

const WAY: (BrickLayout, Memory) = (BrickLayout { edge: 24, halo: 2 }, ONE_TEXTURE);
const SMALL_BRICKS: (BrickLayout, Memory) = (BrickLayout { edge: 16, halo: 2 }, ONE_TEXTURE);

#[test]
fn skipping_changes_nothing() {
    let Some(gpu) = gpu() else { return };
    for pass in PASSES {
        for (scene, truth) in scenes_and_truths() {
            let rendered = [Skip::None, Skip::Empty, Skip::All].map(|skip| {
                let drawn = draw(gpu, pass, WAY, scene, |request| request.settings.skip = skip);
                let difference = compare(&drawn.frame.rgba, &truth.rgba);
                assert!(difference.is_within(GPU), "{}, {}, {skip:?}: {difference}", scene.name, pass.name());
                drawn.report.bricks.rendered
            });
            assert!(rendered.is_sorted_by(|a, b| a >= b), "{}, {}: {rendered:?}", scene.name, pass.name());
        }
    }
}

/// With a cutoff, bricks behind opaque pixels are neither loaded nor drawn.
#[test]
fn what_is_hidden_is_skipped() {
    let Some(gpu) = gpu() else { return };
    let scene = scene("transfer function opaque");
    for pass in PASSES {
        let [none, empty, all] = [Skip::None, Skip::Empty, Skip::All].map(|skip| {
            draw(gpu, pass, SMALL_BRICKS, scene, |request| {
                request.size = [192, 144];
                request.settings.opacity_cutoff = 0.95;
                request.settings.skip = skip;
            })
        });
        let what = pass.name();
        let same = difference(&all, &empty);
        assert!(same.is_within(GPU), "{what}: {same}");
        let [none, empty, all] = [none, empty, all].map(|drawn| drawn.report);
        assert!(all.bricks.occluded > 0, "{what}: {:?}", all.bricks);
        assert_eq!(all.bricks.rendered + all.bricks.occluded, all.bricks.in_frustum, "{what}");
        assert!(all.bricks.rendered <= empty.bricks.rendered, "{what}");
        assert!(empty.bricks.rendered < none.bricks.rendered, "{what}");
        assert!(all.residency.uploads < none.residency.uploads, "{what}");
    }
}
