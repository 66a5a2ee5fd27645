use std::path::{Path, PathBuf};

use glassbrick_volume::{BrickGrid, StoredType};
use serde_json::{Value, json};

use super::shard::SHARD_EDGE;
use super::table_chunks::{Table, TableChunks};
use super::{Codec, StoreDesc};

/// The folder of a level within a store.
pub fn level_path(level: u32) -> PathBuf {
    Path::new("levels").join(level.to_string())
}

/// Every `zarr.json` of a store, by its path within it: what each must say. The group's own stands last, for a store
/// without it is none.
pub fn documents(store: &StoreDesc) -> Vec<(PathBuf, Value)> {
    let document = |folder: PathBuf, value| (folder.join("zarr.json"), value);
    let group = || json!({ "zarr_format": 3, "node_type": "group", "attributes": {} });
    let mut documents = vec![document("levels".into(), group())];
    for level in 0..store.levels() {
        let folder = level_path(level);
        let grid = store.layout.level_grid(store.volume.extent, level);
        documents.push(document(folder.clone(), group()));
        documents.push(document(folder.join("bricks"), bricks(store, &grid)));
        for table in Table::ALL {
            documents.push(document(folder.join(table.name()), table_array(store, &grid, table)));
        }
    }
    let mut root = group();
    root["attributes"]["glassbrick"] = store.to_attributes();
    documents.push(document(PathBuf::new(), root));
    documents
}

fn bricks(store: &StoreDesc, grid: &BrickGrid) -> Value {
    let [x, y, z] = grid.counts.to_array();
    let edge = store.layout.edge;
    let stored_type = store.volume.stored_type;
    let shards = json!({
        "name": "sharding_indexed",
        "configuration": {
            "chunk_shape": [1, 1, 1, edge, edge, edge],
            "codecs": store.codec.metadata(stored_type.bytes(), store.brick_bytes()),
            "index_codecs": Codec::None.metadata(size_of::<u64>(), 0),
            "index_location": "end",
        },
    });
    array(
        json!([z, y, x, edge, edge, edge]),
        data_type(stored_type),
        json!([SHARD_EDGE, SHARD_EDGE, SHARD_EDGE, edge, edge, edge]),
        json!([shards]),
        json!(["brick_z", "brick_y", "brick_x", "z", "y", "x"]),
    )
}

fn table_array(store: &StoreDesc, grid: &BrickGrid, table: Table) -> Value {
    let stored_type = store.volume.stored_type;
    let chunks = TableChunks::new(grid);
    let [x, y, z] = grid.counts.to_array();
    let [chunk_x, chunk_y, chunk_z] = chunks.shape.to_array();
    let columns = table.columns();
    let chunk_bytes = chunks.bricks_per_chunk() * table.row_bytes(stored_type);
    array(
        json!([z, y, x, columns]),
        data_type(table.element(stored_type)),
        json!([chunk_z, chunk_y, chunk_x, columns]),
        store.codec.metadata(table.element(stored_type).bytes(), chunk_bytes),
        json!(["brick_z", "brick_y", "brick_x", table.column_name()]),
    )
}

fn array(shape: Value, data_type: &str, chunk_shape: Value, codecs: Value, dimension_names: Value) -> Value {
    let zero = if data_type.starts_with("float") { json!(0.0) } else { json!(0) };
    json!({
        "zarr_format": 3,
        "node_type": "array",
        "shape": shape,
        "data_type": data_type,
        "chunk_grid": { "name": "regular", "configuration": { "chunk_shape": chunk_shape } },
        "chunk_key_encoding": { "name": "default", "configuration": { "separator": "/" } },
        "fill_value": zero,
        "codecs": codecs,
        "dimension_names": dimension_names,
        "attributes": {},
    })
}

/// Zarr's name of a stored type.
fn data_type(stored_type: StoredType) -> &'static str {
    match stored_type {
        StoredType::U8 => "uint8",
        StoredType::I8 => "int8",
        StoredType::U16 => "uint16",
        StoredType::I16 => "int16",
        StoredType::U32 => "uint32",
        StoredType::I32 => "int32",
        StoredType::F32 => "float32",
        StoredType::F64 => "float64",
    }
}
