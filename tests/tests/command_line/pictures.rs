use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use exr::prelude::{AttributeValue, FlatSamples, ReadChannels, ReadLayers, Text, read};
use glassbrick_tests::srgb;
use serde_json::Value;

use super::Scratch;

struct Png {
    width: u32,
    height: u32,
    /// Bytes of a pixel.
    channels: usize,
    bytes: Vec<u8>,
    report: Value,
}

fn png(path: &Path) -> Png {
    let file = BufReader::new(File::open(path).expect("it was written"));
    let mut reader = png::Decoder::new(file).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("small")];
    reader.next_frame(&mut bytes).expect("a picture");
    reader.finish().expect("an end");
    let info = reader.info();
    let text = info.utf8_text.iter().find(|text| text.keyword == "glassbrick").expect("the report");
    Png {
        width: info.width,
        height: info.height,
        channels: info.bytes_per_pixel(),
        bytes,
        report: serde_json::from_str(&text.get_text().expect("UTF-8")).expect("JSON"),
    }
}

pub struct Exr {
    /// R, G, B, A and Z.
    pub channels: [Vec<f32>; 5],
    report: Value,
}

pub fn exr(path: &Path) -> Exr {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_file(path)
        .expect("an EXR");
    let layer = &image.layer_data[0];
    let channels = ["R", "G", "B", "A", "Z"].map(|name| {
        let found = layer.channel_data.list.iter().find(|channel| channel.name == *name).expect("a channel");
        match &found.sample_data {
            FlatSamples::F32(samples) => samples.clone(),
            _ => panic!("{name} is not f32"),
        }
    });
    let keyword = Text::from("glassbrick");
    let attributes = [&image.attributes.other, &layer.attributes.other];
    let report = attributes.into_iter().find_map(|attributes| attributes.get(&keyword));
    let Some(AttributeValue::Text(report)) = report else { panic!("there is no report") };
    Exr { channels, report: serde_json::from_str(&report.to_string()).expect("JSON") }
}

/// A report without the times of writing, which a picture cannot hold of itself.
fn before_writing(mut report: Value) -> Value {
    report["time_ms"]["encode"] = Value::Null;
    report["time_ms"]["total"] = Value::Null;
    report["peak_anon_bytes"] = Value::Null;
    report["peak_rss_bytes"] = Value::Null;
    report
}

#[test]
fn a_png_is_the_exr_in_srgb_and_both_carry_the_report() {
    let scratch = Scratch::new();
    let told = scratch.render("-o {}/a.png");
    let png = png(&scratch.path("a.png"));
    assert_eq!((png.width, png.height, png.channels), (40, 30, 3));
    assert_eq!(before_writing(png.report), before_writing(told));

    let told = scratch.render("-o {}/a.exr");
    let exr = exr(&scratch.path("a.exr"));
    assert_eq!(before_writing(exr.report), before_writing(told));
    for (pixel, bytes) in png.bytes.chunks_exact(3).enumerate() {
        for (channel, &byte) in bytes.iter().enumerate() {
            let code = 255.0 * srgb::encode(f64::from(exr.channels[channel][pixel]));
            assert!((code - f64::from(byte)).abs() <= 0.5 + 1e-3, "pixel {pixel}: {code} and {byte}");
        }
    }
}

/// The ball is 5 mm in front of and 5 mm to the left of the volume's middle, which the front view looks at.
#[test]
fn the_picture_shows_the_ball_where_it_is() {
    let scratch = Scratch::new();
    scratch.render("-o {}/a.exr");
    let Exr { channels: [_, _, _, alpha, depth], .. } = exr(&scratch.path("a.exr"));
    let opaque: Vec<usize> = (0..alpha.len()).filter(|&pixel| alpha[pixel] > 0.5).collect();
    let middle = |of: fn(usize) -> usize| {
        opaque.iter().map(|&pixel| of(pixel) as f64 + 0.5).sum::<f64>() / opaque.len() as f64
    };
    let (column, row) = (middle(|pixel| pixel % 40), middle(|pixel| pixel / 40));
    // World x 5, y −6, z 2: the box spans x −17.25 to 17.75, y −16.25 to 15.75, z −20.5 to 19.5.
    let radius = (17.5f64.powi(2) + 16f64.powi(2) + 20f64.powi(2)).sqrt();
    let distance = radius / 15f64.to_radians().sin();
    let pixels_per_mm = 15.0 / (15f64.to_radians().tan() * (distance - 5.75));
    assert!((column - (20.0 + 4.75 * pixels_per_mm)).abs() < 0.5, "column {column}");
    assert!((row - (15.0 - 2.5 * pixels_per_mm)).abs() < 0.5, "row {row}");
    let nearest = depth.iter().copied().fold(f32::INFINITY, f32::min);
    assert!((f64::from(nearest) - (distance - 5.75 - 5.0)).abs() < 1.5, "{nearest} of {distance}");
    for pixel in 0..alpha.len() {
        assert_eq!(depth[pixel].is_finite(), alpha[pixel] >= 0.5);
    }
}

#[test]
fn backgrounds_are_behind_the_picture() {
    let scratch = Scratch::new();
    scratch.render("-o {}/black.png");
    scratch.render("-o {}/blue.png --background #0000ff");
    scratch.render("-o {}/clear.png --background transparent");
    let [black, blue, clear] =
        ["black", "blue", "clear"].map(|name| png(&scratch.path(&format!("{name}.png"))));
    assert_eq!((&black.bytes[..3], &blue.bytes[..3]), (&[0, 0, 0][..], &[0, 0, 255][..]));
    assert_eq!((clear.channels, &clear.bytes[..4]), (4, &[0, 0, 0, 0][..]));
}

#[test]
fn a_picture_replaces_the_one_that_was_there() {
    let scratch = Scratch::new();
    std::fs::write(scratch.path("a.png"), vec![7; 100_000]).expect("a scratch file");
    scratch.render("-o {}/a.png");
    assert_eq!(png(&scratch.path("a.png")).width, 40);
    let mut names: Vec<_> = std::fs::read_dir(scratch.folder.path())
        .expect("there")
        .map(|entry| entry.expect("there").file_name())
        .collect();
    names.sort();
    assert_eq!(names, ["a.png", "ball.nrrd", "r.json", "tf.json"]);
}

/// The same place said in different ways, in numbers below zero too.
#[test]
fn views_that_are_the_same_give_the_same_picture() {
    let scratch = Scratch::new();
    scratch.run("info {}/ball.nrrd");
    let camera = r#"{"projection":"perspective","eye":[-30,-60,-8],"target":[0,-1,-2],"up":[0.1,0,-1],"fov_y_deg":24}"#;
    std::fs::write(scratch.path("camera.json"), camera).expect("a scratch file");
    for (a, b) in [
        ("--view front", "--azimuth 0"),
        ("--view left", "--azimuth 90 --elevation 0"),
        ("--view right", "--azimuth -90"),
        ("--view top", "--elevation 90"),
        ("--view back", "--azimuth 180"),
        ("--azimuth -30 --elevation -12.5", "--azimuth 330 --elevation -12.5"),
        ("--camera {}/camera.json", "--eye -30,-60,-8 --target 0,-1,-2 --up 0.1,0,-1 --fov 24"),
        ("--eye -1e2,-60,-8 --target 0,-1,-2", "--eye=-100,-60,-8 --target 0,-1,-2 --zoom 1"),
    ] {
        scratch.render(&format!("-o {{}}/a.png {a}"));
        scratch.render(&format!("-o {{}}/b.png {b}"));
        let [a_png, b_png] = ["a.png", "b.png"].map(|name| png(&scratch.path(name)).bytes);
        let most = a_png.iter().zip(&b_png).map(|(a, b)| a.abs_diff(*b)).max();
        assert!(most <= Some(1), "{a} and {b} differ by {most:?}");
        assert!(a_png.iter().any(|&byte| byte > 100), "{a} shows the ball");
    }
}
