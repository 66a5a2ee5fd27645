use std::io::{self, Seek, Write};

use exr::meta::attribute::{AttributeValue, Text};
use exr::prelude::{
    Blocks, Compression, Encoding, Image, Layer, LayerAttributes, LineOrder, SpecificChannels, Vec2,
    WritableImage,
};
use glassbrick_volume::Frame;

use super::report_text::{REPORT_KEYWORD, ascii_json};

/// Writes an EXR of 32-bit floats: R, G, B in linear light, premultiplied by A, and Z, the depth in mm.
pub fn encode(frame: &Frame, report_json: &str, writer: &mut (impl Write + Seek)) -> io::Result<()> {
    let width = frame.width as usize;
    let channels = SpecificChannels::build()
        .with_channel("R")
        .with_channel("G")
        .with_channel("B")
        .with_channel("A")
        .with_channel("Z")
        .with_pixel_fn(|Vec2(x, y)| {
            let pixel = y * width + x;
            let [red, green, blue, alpha] = frame.rgba[pixel];
            (red, green, blue, alpha, frame.depth_mm[pixel])
        });
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let layer = Layer::new((width, frame.height as usize), LayerAttributes::default(), encoding, channels);
    let mut image = Image::from_layer(layer);
    image.attributes.pixel_aspect = 1.0;
    let report = Text::new_or_none(ascii_json(report_json)).expect("ASCII is text");
    image.attributes.other.insert(Text::from(REPORT_KEYWORD), AttributeValue::Text(report));
    image.write().to_buffered(writer).map_err(|error| match error {
        exr::error::Error::Io(error) => error,
        other => io::Error::other(other.to_string()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use exr::prelude::{FlatSamples, ReadChannels, ReadLayers, read};
    use std::io::Cursor;

    fn round_trip(frame: &Frame, report: &str) -> exr::prelude::FlatImage {
        let mut file = Cursor::new(Vec::new());
        encode(frame, report, &mut file).expect("memory takes it");
        file.set_position(0);
        read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .all_layers()
            .all_attributes()
            .from_buffered(file)
            .expect("an EXR")
    }

    #[test]
    fn every_float_comes_back_in_its_place() {
        let rgba: Vec<[f32; 4]> = (0..35).map(|i| [i as f32, -0.1, 1e-20, 0.25 * i as f32]).collect();
        let mut depth_mm: Vec<f32> = (0..35).map(|i| i as f32 * 1.5).collect();
        depth_mm[3] = f32::INFINITY;
        let frame = Frame { width: 7, height: 5, rgba, depth_mm };
        let image = round_trip(&frame, "{}");
        let layer = &image.layer_data[0];
        assert_eq!(layer.size, Vec2(7, 5));
        assert_eq!(image.attributes.pixel_aspect, 1.0);
        let channel = |name: &str| {
            let list = &layer.channel_data.list;
            match &list.iter().find(|channel| channel.name == *name).expect("it is there").sample_data {
                FlatSamples::F32(samples) => samples.clone(),
                _ => panic!("{name} is not f32"),
            }
        };
        assert_eq!(layer.channel_data.list.len(), 5);
        for (index, name) in ["R", "G", "B", "A"].into_iter().enumerate() {
            let expected: Vec<f32> = frame.rgba.iter().map(|pixel| pixel[index]).collect();
            assert_eq!(channel(name), expected, "{name}");
        }
        assert_eq!(channel("Z"), frame.depth_mm);
    }

    #[test]
    fn the_report_is_an_attribute() {
        let report = format!(r#"{{"warnings":["Schädel","{}"]}}"#, "long ".repeat(100_000));
        let image = round_trip(&Frame::transparent(2, 2), &report);
        match &image.layer_data[0].attributes.other[&Text::from("glassbrick")] {
            AttributeValue::Text(text) => assert_eq!(text.to_string(), ascii_json(&report)),
            other => panic!("{other:?} is not text"),
        }
    }
}
