//! Damage anywhere in a store is found by verifying it, and never drawn.

use std::fs;
use std::path::{Path, PathBuf};

use glassbrick::{Codec, Error, Frame, OpenSettings, RenderRequest, Rendered, verify};
use glassbrick_tests::scenes::{Scene, scenes};

use super::damage_kinds::{Damage, INDEX_BYTES, KINDS, Kind};
use super::{Scratch, assert_one_line, draw_stored};

/// A scene with enough bricks of 16 for several shards, of which its transfer function shows a part.
pub fn scene() -> Scene {
    let scene = scenes().iter().find(|scene| scene.name == "transfer function opaque").expect("a scene");
    Scene { width: 24, height: 18, ..scene.clone() }
}

pub const EDGE: u32 = 16;

/// The scene in a store, and a transfer function beside it for the command.
pub fn prepared() -> Scratch {
    let scratch = Scratch::new();
    scratch.store(&scene(), EDGE, Codec::Lz4);
    let tf = r#"{"points":[{"value":500,"color":[1,1,1],"opacity":0},{"value":900,"color":[1,1,1],"opacity":0.1}]}"#;
    scratch.file("tf.json", tf.as_bytes());
    scratch
}

fn settings() -> OpenSettings {
    OpenSettings { threads: Some(2), ..OpenSettings::default() }
}

fn draw(store: &Path, change: impl Fn(&mut RenderRequest)) -> Result<Rendered, Error> {
    draw_stored(store, &scene(), &settings(), change)
}

/// What verifying says: nothing of a sound store.
fn complaints(store: &Path) -> Vec<String> {
    match verify(store, Some(2), |_, _| ()) {
        Ok(verified) => verified.damage,
        Err(error) => vec![error.to_string()],
    }
}

/// Whether a message names the file, or a brick or table that lies in it.
fn names(message: &str, store: &Path, kind: Kind) -> bool {
    // A store that does not say what it is, is named itself.
    message.contains(kind.file)
        || (kind.file == "zarr.json" && message.contains(&store.display().to_string()))
}

/// Calls `check` with every damage to every kind of file, one after the other.
fn for_all_damage(codec: Codec, mut check: impl FnMut(&Path, Kind, Damage)) {
    let scratch = Scratch::new();
    let store = scratch.store(&scene(), EDGE, codec);
    for kind in KINDS {
        let path = store.join(kind.file);
        let bytes = fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", kind.file));
        for damage in Damage::all(kind, &bytes) {
            damage.inflict(&path, &bytes);
            check(&store, kind, damage);
            damage.undo(&path, &bytes);
        }
    }
    assert!(complaints(&store).is_empty(), "all damage was undone");
}

/// Whether the file says what it said before: white space is nothing in JSON.
fn is_harmless(store: &Path, kind: Kind, sound: &Path) -> bool {
    let parsed = |store: &Path| -> Option<serde_json::Value> {
        serde_json::from_slice(&fs::read(store.join(kind.file)).ok()?).ok()
    };
    kind.is_json() && parsed(store).is_some() && parsed(store) == parsed(sound)
}

#[test]
fn verifying_names_every_damage() {
    let sound = Scratch::new();
    let sound = sound.store(&scene(), EDGE, Codec::Lz4);
    for_all_damage(Codec::Lz4, |store, kind, damage| {
        let complaints = complaints(store);
        if is_harmless(store, kind, &sound) {
            assert!(complaints.is_empty(), "{kind:?} {damage:?}: {complaints:?}");
            return;
        }
        assert!(!complaints.is_empty(), "{kind:?} {damage:?} is not found");
        complaints.iter().for_each(|complaint| assert_one_line(complaint));
        let named = complaints.iter().any(|complaint| names(complaint, store, kind));
        assert!(named, "{kind:?} {damage:?} is not named: {complaints:?}");
    });
}

#[test]
fn what_is_drawn_of_a_damaged_store_is_the_undamaged_picture() {
    let sound = Scratch::new();
    let sound = sound.store(&scene(), EDGE, Codec::None);
    let expected = draw(&sound, |_| ()).expect("sound").frame;
    let (mut drawn, mut refused) = (0, 0);
    for_all_damage(Codec::None, |store, kind, damage| match draw(store, |_| ()) {
        Ok(rendered) => {
            assert!(rendered.frame.rgba == expected.rgba, "{kind:?} {damage:?}: another picture");
            assert!(rendered.report.complete);
            let may_draw = !kind.needed || kind.is_bricks() || is_harmless(store, kind, &sound);
            assert!(may_draw, "{kind:?} {damage:?} is drawn");
            drawn += 1;
        }
        Err(error) => {
            let message = error.to_string();
            assert_one_line(&message);
            assert!(names(&message, store, kind), "{kind:?} {damage:?} is not named: {message}");
            assert!(kind.needed && !is_harmless(store, kind, &sound), "{kind:?} {damage:?}: {message}");
            refused += 1;
        }
    });
    assert!(drawn > 50 && refused > 100, "{drawn} drawn, {refused} refused");
}

/// The picture then lacks something, and the report says so, whatever the damage of a shard.
#[test]
fn damaged_bricks_are_left_out_where_that_is_allowed() {
    let whole = Scratch::new();
    let whole = draw(&whole.store(&scene(), EDGE, Codec::Zstd), |_| ()).expect("sound").frame;
    let mut changed = 0;
    for_all_damage(Codec::Zstd, |store, kind, damage| {
        if !kind.is_bricks() {
            return;
        }
        let strict = draw(store, |_| ());
        let drawn = draw(store, |request| request.allow_damaged = true)
            .unwrap_or_else(|error| panic!("{kind:?} {damage:?}: {error}"));
        let report = drawn.report;
        let is_whole = strict.is_ok();
        assert_eq!(report.complete, is_whole, "{kind:?} {damage:?}");
        assert_eq!(report.bricks.damaged == 0, is_whole, "{kind:?} {damage:?}");
        let told = report.warnings.iter().filter(|warning| warning.contains("left out")).count();
        assert_eq!(told > 0, !is_whole, "{:?}", report.warnings);
        if let Err(error) = strict {
            let named = report
                .warnings
                .iter()
                .any(|warning| warning.contains("brick ") && names(warning, store, kind));
            assert!(named, "{error}: {:?}", report.warnings);
            changed += usize::from(drawn.frame.rgba != whole.rgba);
        } else {
            assert!(drawn.frame.rgba == whole.rgba);
        }
    });
    assert!(changed > 20, "{changed} pictures lack something that is seen");
}

/// Where dropping nearly empty bricks needs the tables, they are checked.
#[test]
fn damaged_tables_are_refused_where_they_are_needed() {
    let scratch = Scratch::new();
    let store = scratch.store(&scene(), EDGE, Codec::None);
    let (path, bytes) = table(&store);
    let lossy = |request: &mut RenderRequest| request.nearly_empty.alpha = 0.01;
    draw(&store, lossy).expect("sound");
    for at in [0, bytes.len() / 3, bytes.len() - 1] {
        Damage::Flipped { at, bits: 4 }.inflict(&path, &bytes);
        let error = draw(&store, lossy).expect_err("the table is damaged").to_string();
        assert!(error.contains("levels/0/vct/c/0/0/0/0"), "{error}");
        draw(&store, |_| ()).expect("nothing needs the table");
    }
}

fn table(store: &Path) -> (PathBuf, Vec<u8>) {
    let path = store.join("levels/0/vct/c/0/0/0/0");
    let bytes = fs::read(&path).expect("there");
    (path, bytes)
}

/// Bricks that change places are as sound as before, but for their ranges; verifying finds them.
#[test]
fn bricks_that_changed_places_are_found() {
    let scratch = Scratch::new();
    let store = scratch.store(&scene(), EDGE, Codec::None);
    let path = store.join("levels/0/bricks/c/0/1/1/0/0/0");
    let mut bytes = fs::read(&path).expect("there");
    let index = bytes.len() - INDEX_BYTES;
    let (first, second) = bytes[index..index + 32].split_at(16);
    let exchanged = [second, first].concat();
    bytes[index..index + 32].copy_from_slice(&exchanged);
    let end = bytes.len() - 4;
    let checksum = crc32c::crc32c(&bytes[index..end]);
    bytes[end..].copy_from_slice(&checksum.to_le_bytes());
    fs::write(&path, bytes).expect("a scratch file");
    let complaints = complaints(&store);
    assert!(complaints.iter().any(|complaint| complaint.contains("brick 4,4,0")), "{complaints:?}");
}

/// Frames of nothing would make the tests above prove nothing.
#[test]
fn the_picture_of_these_tests_shows_something() {
    let scratch = Scratch::new();
    let drawn = draw(&scratch.store(&scene(), EDGE, Codec::None), |_| ()).expect("sound");
    let Frame { rgba, .. } = &drawn.frame;
    assert!(rgba.iter().filter(|pixel| pixel[3] > 0.5).count() > rgba.len() / 10);
    assert!(drawn.report.bricks.empty > 20 && drawn.report.bricks.rendered > 20);
}
