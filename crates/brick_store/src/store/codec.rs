use serde_json::{Value, json};

use super::blosc::{self, Compressor};

/// Bytes of the checksum behind every chunk.
const CHECKSUM_BYTES: usize = size_of::<u32>();

/// Bytes that are compressed as one, at most: more do not stay in a core's cache.
const BLOCK_BYTES: usize = 1 << 19;

/// How the chunks of a store are encoded. A CRC-32C of the encoded bytes follows each.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Codec {
    /// Bytes as they are.
    None,
    /// Blosc with shuffle and LZ4: larger than zstd, and read three times as fast.
    Lz4,
    /// Blosc with shuffle and zstd.
    #[default]
    Zstd,
}

impl Codec {
    /// Every codec.
    pub const ALL: [Self; 3] = [Self::None, Self::Lz4, Self::Zstd];

    /// The name in commands and stores.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Lz4 => "lz4",
            Self::Zstd => "zstd",
        }
    }

    /// The codec of that name, if there is one.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|codec| codec.name() == name)
    }

    /// Levels are those past which more time buys next to no bytes, of 64³ voxels of CT.
    fn compressor(self, chunk_bytes: usize) -> Option<Compressor> {
        let (name, level) = match self {
            Self::None => return None,
            Self::Lz4 => (c"lz4", 5),
            Self::Zstd => (c"zstd", 1),
        };
        Some(Compressor { name, level, block_bytes: chunk_bytes.min(BLOCK_BYTES) })
    }

    /// The codecs of a chunk, as Zarr's metadata names them.
    pub fn metadata(self, element_bytes: usize, chunk_bytes: usize) -> Value {
        let mut codecs = vec![json!({ "name": "bytes", "configuration": { "endian": "little" } })];
        if let Some(compressor) = self.compressor(chunk_bytes) {
            codecs.push(json!({
                "name": "blosc",
                "configuration": {
                    "cname": self.name(),
                    "clevel": compressor.level,
                    "shuffle": "shuffle",
                    "typesize": element_bytes,
                    "blocksize": compressor.block_bytes,
                },
            }));
        }
        codecs.push(json!({ "name": "crc32c" }));
        Value::Array(codecs)
    }

    /// The most that encoding makes of so many bytes.
    pub const fn most_encoded_bytes(chunk_bytes: usize) -> usize {
        chunk_bytes + blosc::OVERHEAD + CHECKSUM_BYTES
    }

    /// Appends a chunk's encoded bytes and their checksum.
    pub fn encode(self, element_bytes: usize, chunk: &[u8], out: &mut Vec<u8>) {
        let start = out.len();
        match self.compressor(chunk.len()) {
            None => out.extend_from_slice(chunk),
            Some(compressor) => blosc::compress(&compressor, element_bytes, chunk, out),
        }
        let checksum = crc32c::crc32c(&out[start..]);
        out.extend_from_slice(&checksum.to_le_bytes());
    }

    /// Fills a chunk from its encoded bytes.
    ///
    /// # Errors
    /// Why the bytes are not what was encoded, as a part of a sentence.
    pub fn decode(self, encoded: &[u8], chunk: &mut [u8]) -> Result<(), &'static str> {
        let bytes = checked(encoded)?;
        match self {
            Self::None if bytes.len() != chunk.len() => Err("has the wrong length"),
            Self::None => {
                chunk.copy_from_slice(bytes);
                Ok(())
            }
            _ if blosc::decompress(bytes, chunk) => Ok(()),
            _ => Err("cannot be decompressed"),
        }
    }
}

/// What stands before its checksum.
///
/// # Errors
/// When the checksum is another's.
pub fn checked(encoded: &[u8]) -> Result<&[u8], &'static str> {
    let (bytes, checksum) =
        encoded.split_last_chunk::<CHECKSUM_BYTES>().ok_or("is too short for its checksum")?;
    if crc32c::crc32c(bytes) == u32::from_le_bytes(*checksum) {
        Ok(bytes)
    } else {
        Err("is damaged: its checksum does not fit")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_codec_gives_back_what_went_in() {
        let chunk: Vec<u8> = (0..100_000u32).flat_map(|i| (i % 97 * (i % 1021)).to_le_bytes()).collect();
        for codec in Codec::ALL {
            let mut encoded = vec![7];
            codec.encode(4, &chunk, &mut encoded);
            let mut decoded = vec![0; chunk.len()];
            assert_eq!(codec.decode(&encoded[1..], &mut decoded), Ok(()));
            assert!(decoded == chunk, "{}", codec.name());
            assert!(codec == Codec::None || encoded.len() < chunk.len() / 2);
        }
    }

    #[test]
    fn every_flipped_byte_and_every_cut_is_noticed() {
        let chunk: Vec<u8> = (0..512u16).flat_map(u16::to_le_bytes).collect();
        for codec in Codec::ALL {
            let mut encoded = Vec::new();
            codec.encode(2, &chunk, &mut encoded);
            let mut decoded = vec![0; chunk.len()];
            for place in 0..encoded.len() {
                let mut flipped = encoded.clone();
                flipped[place] ^= 0x10;
                assert!(codec.decode(&flipped, &mut decoded).is_err(), "{} {place}", codec.name());
                assert!(codec.decode(&encoded[..place], &mut decoded).is_err(), "{} {place}", codec.name());
            }
        }
    }

    #[test]
    fn a_container_of_another_length_is_refused_though_its_checksum_fits() {
        for codec in Codec::ALL {
            let mut encoded = Vec::new();
            codec.encode(1, &[5; 1000], &mut encoded);
            assert!(codec.decode(&encoded, &mut [0; 999]).is_err());
            assert!(codec.decode(&encoded, &mut [0; 1001]).is_err());
        }
    }
}
