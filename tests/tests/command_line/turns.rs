use std::fs;
use std::fs::File;

use super::Scratch;

#[test]
fn a_turn_is_a_picture_for_each_frame() {
    let scratch = Scratch::new();
    let report = scratch.render("-o {}/turn-{frame}.png --frames 3");
    let frames = report["frames"].as_array().expect("a list");
    assert_eq!(frames.len(), 3);
    for frame in frames {
        assert_eq!(frame["size"], serde_json::json!([40, 30]));
        assert!(frame["samples"].as_u64() > Some(0));
    }
    for (frame, azimuth) in [0, 120, 240].into_iter().enumerate() {
        scratch.render(&format!("-o {{}}/still.png --azimuth {azimuth}"));
        let [a, b] =
            [format!("turn-{frame}.png"), "still.png".to_owned()].map(|name| pixels(&scratch, &name));
        let most = a.iter().zip(&b).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(most <= Some(1), "frame {frame} is off by {most:?}");
    }
}

fn pixels(scratch: &Scratch, name: &str) -> Vec<u8> {
    let bytes = fs::read(scratch.path(name)).expect("it was written");
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("small")];
    reader.next_frame(&mut pixels).expect("a picture");
    pixels
}

#[test]
fn a_turn_is_a_gif() {
    let scratch = Scratch::new();
    let report = scratch.render("-o {}/turn.gif --frames 3 --repeat 2");
    let frames = report["frames"].as_array().expect("a list");
    assert_eq!(frames.len(), 3);
    assert!(frames.iter().all(|frame| frame["time_ms"]["render_all"].as_array().map(Vec::len) == Some(2)));
    let file = File::open(scratch.path("turn.gif")).expect("it was written");
    let mut reader = gif::DecodeOptions::new().read_info(file).expect("a GIF");
    assert_eq!((reader.width(), reader.height()), (40, 30));
    let mut count = 0;
    while reader.read_next_frame().expect("a frame").is_some() {
        count += 1;
    }
    assert_eq!(count, 3);
}

#[test]
fn a_turn_is_an_animated_png_or_a_video() {
    let scratch = Scratch::new();
    for (name, magic) in [("turn.apng", &b"\x89PNG"[..]), ("turn.avi", b"RIFF")] {
        scratch.render(&format!("-o {{}}/{name} --frames 2"));
        assert!(fs::read(scratch.path(name)).expect("it was written").starts_with(magic), "{name}");
    }
}
