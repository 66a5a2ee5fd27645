//! Prints what a volume is, and the range of its values, as one JSON object.
//!
//! `cargo run -p glassbrick-formats --example describe -- FILE [--time N] [--extent 64x64x64 --dtype u8]`

use std::path::PathBuf;

use glam::{DVec3, UVec3};
use glassbrick_formats::{OpenOptions, RawLayout, open};
use glassbrick_volume::{Endian, Rescale, StoredType, VolumeReader};
use serde_json::json;

type Failure = Box<dyn std::error::Error + Send + Sync>;

fn main() {
    if let Err(failure) = describe() {
        eprintln!("{failure}");
        std::process::exit(1);
    }
}

fn describe() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let mut path = None;
    let mut options = OpenOptions::default();
    let (mut extent, mut stored_type) = (None, None);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--time" => options.time = arguments.next().map(|time| time.parse()).transpose()?,
            "--extent" => extent = arguments.next(),
            "--dtype" => stored_type = arguments.next().and_then(|name| StoredType::from_name(&name)),
            _ => path = Some(PathBuf::from(argument)),
        }
    }
    if let Some((extent, stored_type)) = extent.zip(stored_type) {
        let sizes: Vec<u32> = extent.split('x').map(str::parse).collect::<Result<_, _>>()?;
        options.raw = Some(RawLayout {
            extent: UVec3::from_slice(&sizes),
            stored_type,
            endian: Endian::Little,
            spacing_mm: DVec3::ONE,
            offset_bytes: 0,
            rescale: Rescale::IDENTITY,
        });
    }
    let mut reader = open(&path.ok_or("name a file")?, &options)?;
    let [low, high] = range(reader.as_mut())?;
    let desc = reader.desc();
    let direction = desc.direction;
    let described = json!({
        "volume": {
            "extent": desc.extent.to_array(),
            "spacing": desc.spacing_mm.to_array(),
            "origin": desc.origin_mm.to_array(),
            "direction": [direction.x_axis.to_array(), direction.y_axis.to_array(), direction.z_axis.to_array()],
            "dtype": desc.stored_type.name(),
            "slope": desc.rescale.slope,
            "intercept": desc.rescale.intercept,
            "range": [desc.rescale.value(low), desc.rescale.value(high)],
        },
        "format": reader.format(),
        "flat": reader.flat_placement().is_some(),
        "notes": reader.notes(),
    });
    println!("{described}");
    Ok(())
}

/// The least and greatest stored value; what is not finite counts as 0.
fn range(reader: &mut dyn VolumeReader) -> Result<[f64; 2], Failure> {
    let (stored_type, slices) = (reader.desc().stored_type, reader.desc().extent.z);
    let mut slice = vec![0; reader.desc().slice_bytes() as usize];
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for _ in 0..slices {
        reader.read_slices(&mut slice)?;
        for voxel in slice.chunks_exact(stored_type.bytes()) {
            let value = stored_value(voxel, stored_type)?;
            let value = if value.is_finite() { value } else { 0.0 };
            range = [range[0].min(value), range[1].max(value)];
        }
    }
    Ok(range)
}

fn stored_value(voxel: &[u8], stored_type: StoredType) -> Result<f64, Failure> {
    Ok(match stored_type {
        StoredType::U8 => voxel[0].into(),
        StoredType::I8 => (voxel[0] as i8).into(),
        StoredType::U16 => u16::from_ne_bytes(voxel.try_into()?).into(),
        StoredType::I16 => i16::from_ne_bytes(voxel.try_into()?).into(),
        StoredType::U32 => u32::from_ne_bytes(voxel.try_into()?).into(),
        StoredType::I32 => i32::from_ne_bytes(voxel.try_into()?).into(),
        StoredType::F32 => f32::from_ne_bytes(voxel.try_into()?).into(),
        StoredType::F64 => f64::from_ne_bytes(voxel.try_into()?),
    })
}
