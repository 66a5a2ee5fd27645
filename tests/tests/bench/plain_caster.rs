//! SW is the truth that a benchmark holds executors to, so it is held to the reference itself.

use glassbrick::{OpenSettings, Volume};
use glassbrick_benches::plain_caster::{PlainVolume, draw};
use glassbrick_tests::drawing::{camera, desc, native_bytes, request};
use glassbrick_tests::reference::render;
use glassbrick_tests::scenes::scenes;
use glassbrick_tests::tolerance::{CPU, assert_depths, compare};

#[test]
fn it_draws_every_scene_as_the_reference_does() {
    let mut off = Vec::new();
    for scene in scenes() {
        let truth = render(&scene.reference());
        let volume = Volume::from_array(desc(scene), native_bytes(scene), &OpenSettings::default())
            .expect("a scene's array is sound");
        let plain = PlainVolume::read(&volume).expect("a scene's volume is small");
        let (frame, _) = draw(&plain, &request(scene), &camera(scene)).expect("a scene can be drawn");
        let difference = compare(&frame.rgba, &truth.rgba);
        if !difference.is_within(CPU) {
            off.push(format!("{}: {difference}", scene.name));
        }
        let plane_mm = scene.step * desc(scene).smallest_spacing_mm();
        assert_depths(&scene.name, scene.mode, plane_mm, &frame.depth_mm, &truth.z);
    }
    assert!(off.is_empty(), "{}", off.join("\n"));
}
