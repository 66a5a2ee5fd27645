use std::path::Path;

use glam::{DMat3, DVec3, UVec3};
use glassbrick_volume::{BrickLayout, Rescale, StoredType, VolumeDesc};
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::{Codec, StoreError};

/// The version of the format that is written, and the only one that is read.
const FORMAT_VERSION: u64 = 1;

/// Longer edges would not fit into the compressor's containers.
const LARGEST_EDGE: u32 = 256;

/// What a store says of itself.
#[derive(Clone, Debug, PartialEq)]
pub struct StoreDesc {
    pub volume: VolumeDesc,
    pub layout: BrickLayout,
    pub codec: Codec,
    /// Voxels of level 0 that are not finite.
    pub not_finite: u64,
    /// The format that the volume was read from.
    pub source_format: String,
    /// What the user should know of how the input was understood, one sentence each.
    pub notes: Vec<String>,
}

/// The object `glassbrick` of the group's attributes, without its checksum.
#[derive(Serialize, Deserialize)]
struct Attributes {
    format_version: u64,
    extent: [u32; 3],
    dtype: String,
    spacing: [f64; 3],
    origin: [f64; 3],
    direction: [[f64; 3]; 3],
    slope: f64,
    intercept: f64,
    brick: BrickAttributes,
    levels: u32,
    codec: String,
    not_finite: u64,
    source_format: String,
    notes: Vec<String>,
}

#[derive(Serialize, Deserialize)]
struct BrickAttributes {
    edge: u32,
    halo: u32,
}

impl StoreDesc {
    /// How many levels the store has: until one brick is left.
    pub fn levels(&self) -> u32 {
        self.layout.levels(self.volume.extent)
    }

    /// Bytes of a brick as stored, before it is encoded.
    pub fn brick_bytes(&self) -> usize {
        self.layout.voxels() * self.volume.stored_type.bytes()
    }

    /// Whether a store can hold this.
    ///
    /// # Errors
    /// Why not, as a part of a sentence.
    pub fn check(&self) -> Result<(), String> {
        let BrickLayout { edge, halo } = self.layout;
        let least = 2 * halo.clamp(2, 64) + 4;
        if !(2..=64).contains(&halo) || !(least..=LARGEST_EDGE).contains(&edge) || !edge.is_multiple_of(2) {
            return Err(format!(
                "bricks of {edge} voxels with a halo of {halo} are not possible; choose a halo of 2 to 64 and an even edge from {least} to {LARGEST_EDGE}"
            ));
        }
        let counts = self.volume.extent.map(|n| n.div_ceil(self.layout.core())).as_u64vec3();
        let bricks = counts.x.checked_mul(counts.y).and_then(|bricks| bricks.checked_mul(counts.z));
        if bricks.is_none_or(|bricks| bricks == 0 || bricks > u64::from(u32::MAX)) {
            return Err(format!("{} voxels are none, or too many", self.volume.extent));
        }
        let VolumeDesc { spacing_mm, origin_mm, direction, rescale, .. } = &self.volume;
        let is_placed = spacing_mm.is_finite()
            && spacing_mm.cmpgt(DVec3::ZERO).all()
            && origin_mm.is_finite()
            && direction.is_finite()
            && direction.determinant().abs() > 0.0;
        if !is_placed {
            return Err("spacing, origin and directions give it no place in the world".to_owned());
        }
        if rescale.slope == 0.0 || !rescale.slope.is_finite() || !rescale.intercept.is_finite() {
            return Err(format!(
                "slope {} and intercept {} give no values",
                rescale.slope, rescale.intercept
            ));
        }
        Ok(())
    }

    /// The object `glassbrick` of the group's attributes.
    pub fn to_attributes(&self) -> Value {
        let VolumeDesc { extent, stored_type, spacing_mm, origin_mm, direction, rescale } = &self.volume;
        let attributes = Attributes {
            format_version: FORMAT_VERSION,
            extent: extent.to_array(),
            dtype: stored_type.name().to_owned(),
            spacing: spacing_mm.to_array(),
            origin: origin_mm.to_array(),
            direction: direction.to_cols_array_2d(),
            slope: rescale.slope,
            intercept: rescale.intercept,
            brick: BrickAttributes { edge: self.layout.edge, halo: self.layout.halo },
            levels: self.levels(),
            codec: self.codec.name().to_owned(),
            not_finite: self.not_finite,
            source_format: self.source_format.clone(),
            notes: self.notes.clone(),
        };
        let mut value = serde_json::to_value(attributes).expect("plain data becomes JSON");
        value["checksum"] = checksum(&value).into();
        value
    }

    /// Reads the object `glassbrick` of the group's attributes.
    ///
    /// # Errors
    /// When it is of another version, damaged, or says what cannot be; `path` names the file.
    pub fn from_attributes(mut value: Value, path: &Path) -> Result<Self, StoreError> {
        let damaged = |what: &str| StoreError::Damaged {
            path: path.to_owned(),
            what: format!("the attributes of glassbrick are damaged: {what}"),
        };
        let version = value["format_version"].as_u64().ok_or_else(|| damaged("no format version"))?;
        if version != FORMAT_VERSION {
            return Err(StoreError::Version { path: path.to_owned(), version });
        }
        let written = value.as_object_mut().and_then(|attributes| attributes.remove("checksum"));
        if written.and_then(|checksum| checksum.as_u64()) != Some(checksum(&value).into()) {
            return Err(damaged("their checksum does not fit"));
        }
        let told: Attributes = serde_json::from_value(value).map_err(|error| damaged(&error.to_string()))?;
        let store = Self {
            volume: VolumeDesc {
                extent: UVec3::from_array(told.extent),
                stored_type: StoredType::from_name(&told.dtype).ok_or_else(|| damaged("dtype"))?,
                spacing_mm: DVec3::from_array(told.spacing),
                origin_mm: DVec3::from_array(told.origin),
                direction: DMat3::from_cols_array_2d(&told.direction),
                rescale: Rescale { slope: told.slope, intercept: told.intercept },
            },
            layout: BrickLayout { edge: told.brick.edge, halo: told.brick.halo },
            codec: Codec::from_name(&told.codec).ok_or_else(|| damaged("codec"))?,
            not_finite: told.not_finite,
            source_format: told.source_format,
            notes: told.notes,
        };
        store.check().map_err(|what| damaged(&what))?;
        if store.levels() != told.levels {
            return Err(damaged("levels"));
        }
        Ok(store)
    }
}

/// CRC-32C of the attributes as compact JSON, keys in alphabetical order.
fn checksum(attributes: &Value) -> u32 {
    crc32c::crc32c(attributes.to_string().as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    pub fn desc() -> StoreDesc {
        let mut volume = VolumeDesc::new(UVec3::new(130, 7, 61), StoredType::I16);
        volume.spacing_mm = DVec3::new(0.1, 1.0 / 3.0, 1e-7);
        volume.rescale = Rescale { slope: -0.3, intercept: -1024.0 };
        StoreDesc {
            volume,
            layout: BrickLayout::default(),
            codec: Codec::Lz4,
            not_finite: 3,
            source_format: "NIfTI".to_owned(),
            notes: vec!["a “note”".to_owned()],
        }
    }

    #[test]
    fn attributes_go_there_and_back_by_way_of_text() {
        let text = desc().to_attributes().to_string();
        let value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(StoreDesc::from_attributes(value, Path::new("zarr.json")).expect("sound"), desc());
    }

    #[test]
    fn a_changed_attribute_is_noticed() {
        for (key, lie) in
            [("extent", Value::from(vec![131, 7, 61])), ("slope", 0.3.into()), ("codec", "zstd".into())]
        {
            let mut value = desc().to_attributes();
            value[key] = lie;
            let error = StoreDesc::from_attributes(value, Path::new("zarr.json")).expect_err("damaged");
            assert!(error.to_string().contains("checksum"), "{error}");
        }
    }

    #[test]
    fn what_cannot_be_is_refused_though_its_checksum_fits() {
        for (key, lie) in [
            ("extent", Value::from(vec![u32::MAX; 3])),
            ("extent", Value::from(vec![0, 1, 1])),
            ("spacing", Value::from(vec![0.0; 3])),
            ("levels", 7.into()),
            ("brick", serde_json::json!({ "edge": 63, "halo": 2 })),
            ("brick", serde_json::json!({ "edge": 64, "halo": 40 })),
            ("dtype", "f16".into()),
        ] {
            let mut value = desc().to_attributes();
            value[key] = lie;
            value.as_object_mut().expect("an object").remove("checksum");
            value["checksum"] = checksum(&value).into();
            assert!(StoreDesc::from_attributes(value, Path::new("zarr.json")).is_err(), "{key}");
        }
    }
}
