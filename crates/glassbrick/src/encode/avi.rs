//! Motion JPEG in AVI 1.0: a RIFF file of a header list, a list of JPEG frames, and an index.

use std::io::{self, Seek, SeekFrom, Write};

use glassbrick_volume::Frame;
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageError};

use super::AnimationDesc;
use super::background::rgb8_over;

const JPEG_QUALITY: u8 = 92;

/// AVI 1.0 readers count in signed 32 bits.
const MAX_FILE_BYTES: u64 = i32::MAX as u64;

/// Bytes before the first frame: everything up to and with the name of the `movi` list.
const HEADER_BYTES: u64 = 224;

const INDEX_ENTRY_BYTES: u64 = 16;
const HAS_INDEX: u32 = 0x10;
const KEY_FRAME: u32 = 0x10;

/// A frame over a colour as a JPEG of full colour resolution.
pub fn jpeg(frame: &Frame, color: [u8; 3]) -> io::Result<Vec<u8>> {
    let mut jpeg = Vec::new();
    JpegEncoder::new_with_quality(&mut jpeg, JPEG_QUALITY)
        .encode(&rgb8_over(frame, color), frame.width, frame.height, ExtendedColorType::Rgb8)
        .map_err(|error| match error {
            ImageError::IoError(error) => error,
            other => io::Error::other(other.to_string()),
        })?;
    Ok(jpeg)
}

/// Writes JPEG frames as an AVI.
pub struct AviEncoder<W: Write + Seek> {
    writer: W,
    desc: AnimationDesc,
    /// Length of each frame, without the byte that evens it out.
    frame_bytes: Vec<u32>,
    /// Length of the frames' chunks so far.
    chunks_bytes: u64,
}

impl<W: Write + Seek> AviEncoder<W> {
    /// Starts the file, whose header is filled in at the end.
    pub fn new(mut writer: W, desc: &AnimationDesc) -> io::Result<Self> {
        writer.write_all(&[0; HEADER_BYTES as usize])?;
        Ok(Self { writer, desc: *desc, frame_bytes: Vec::new(), chunks_bytes: 0 })
    }

    /// Whether the file with this frame and its index stays below 2 GiB.
    pub fn has_room_for(&self, jpeg: &[u8]) -> bool {
        let frames = self.frame_bytes.len() as u64 + 1;
        let bytes = HEADER_BYTES + self.chunks_bytes + chunk_bytes(jpeg.len() as u64);
        bytes + 8 + frames * INDEX_ENTRY_BYTES <= MAX_FILE_BYTES
    }

    /// Appends a frame, for which there must be room.
    pub fn write_jpeg(&mut self, jpeg: &[u8]) -> io::Result<()> {
        let bytes = u32::try_from(jpeg.len()).map_err(io::Error::other)?;
        self.writer.write_all(b"00dc")?;
        self.writer.write_all(&bytes.to_le_bytes())?;
        self.writer.write_all(jpeg)?;
        self.writer.write_all(&[0; 1][..jpeg.len() % 2])?;
        self.frame_bytes.push(bytes);
        self.chunks_bytes += chunk_bytes(u64::from(bytes));
        Ok(())
    }

    /// Writes the index and the header, and gives the writer back, which is still to be flushed.
    pub fn finish(mut self) -> io::Result<W> {
        self.writer.write_all(&index(&self.frame_bytes))?;
        self.writer.seek(SeekFrom::Start(0))?;
        let header = header(&self.desc, &self.frame_bytes, self.chunks_bytes as u32);
        debug_assert_eq!(header.len() as u64, HEADER_BYTES);
        self.writer.write_all(&header)?;
        Ok(self.writer)
    }
}

/// Length of a chunk of `bytes`: its name, its length, and what evens it out.
fn chunk_bytes(bytes: u64) -> u64 {
    8 + bytes.next_multiple_of(2)
}

/// The `idx1` chunk: where each frame's chunk starts, counted from the name of the `movi` list.
fn index(frame_bytes: &[u32]) -> Vec<u8> {
    let mut index = b"idx1".to_vec();
    put(&mut index, &[frame_bytes.len() as u32 * INDEX_ENTRY_BYTES as u32]);
    let mut offset = 4;
    for &bytes in frame_bytes {
        index.extend(b"00dc");
        put(&mut index, &[KEY_FRAME, offset, bytes]);
        offset += chunk_bytes(u64::from(bytes)) as u32;
    }
    index
}

/// Everything before the first frame. All lengths fit, as there was room for each frame.
fn header(desc: &AnimationDesc, frame_bytes: &[u32], chunks_bytes: u32) -> Vec<u8> {
    let AnimationDesc { width, height, fps, .. } = *desc;
    let frames = frame_bytes.len() as u32;
    let largest = frame_bytes.iter().copied().max().unwrap_or(0);
    let index_bytes = 8 + frames * INDEX_ENTRY_BYTES as u32;

    let mut header = b"RIFF".to_vec();
    put(&mut header, &[HEADER_BYTES as u32 - 8 + chunks_bytes + index_bytes]);
    header.extend(b"AVI LIST");
    put(&mut header, &[192]);
    header.extend(b"hdrlavih");
    // Length, µs per frame, bytes per second, granularity, flags, frames, frames ahead, streams, buffer, size, reserved.
    put(
        &mut header,
        &[56, 1_000_000 / fps, largest.saturating_mul(fps), 0, HAS_INDEX, frames, 0, 1, largest],
    );
    put(&mut header, &[width, height, 0, 0, 0, 0]);
    header.extend(b"LIST");
    put(&mut header, &[116]);
    header.extend(b"strlstrh");
    put(&mut header, &[56]);
    header.extend(b"vidsMJPG");
    // Flags, priority and language, frames ahead, scale, rate, start, length, buffer, quality (default), sample size.
    put(&mut header, &[0, 0, 0, 1, fps, 0, frames, largest, u32::MAX, 0]);
    // The rectangle to show: left, top, right, bottom, of 16 bits.
    put(&mut header, &[0, width | height << 16]);
    header.extend(b"strf");
    // Lengths of chunk and structure, size, one plane of 24 bits.
    put(&mut header, &[40, 40, width, height, 1 | 24 << 16]);
    header.extend(b"MJPG");
    // Uncompressed bytes, resolution, palette.
    put(&mut header, &[width.saturating_mul(height).saturating_mul(3), 0, 0, 0, 0]);
    header.extend(b"LIST");
    put(&mut header, &[4 + chunks_bytes]);
    header.extend(b"movi");
    header
}

fn put(bytes: &mut Vec<u8>, words: &[u32]) {
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::encode::Background;
    use std::io::Cursor;

    const DESC: AnimationDesc =
        AnimationDesc { width: 33, height: 17, frames: 3, fps: 25, background: Background::Color([0; 3]) };

    fn frame(red: f32) -> Frame {
        Frame { rgba: vec![[red, 0.2, 0.1, 1.0]; 33 * 17], ..Frame::transparent(33, 17) }
    }

    fn encoded(jpegs: &[Vec<u8>]) -> Vec<u8> {
        let mut encoder = AviEncoder::new(Cursor::new(Vec::new()), &DESC).expect("memory takes it");
        for jpeg in jpegs {
            assert!(encoder.has_room_for(jpeg));
            encoder.write_jpeg(jpeg).expect("memory takes it");
        }
        encoder.finish().expect("memory takes it").into_inner()
    }

    fn word(bytes: &[u8], at: usize) -> usize {
        u32::from_le_bytes(bytes[at..at + 4].try_into().expect("four")) as usize
    }

    /// The chunks of a list's content, as name and content.
    fn chunks(mut bytes: &[u8]) -> Vec<(String, &[u8])> {
        let mut chunks = Vec::new();
        while !bytes.is_empty() {
            let length = word(bytes, 4);
            chunks.push((String::from_utf8_lossy(&bytes[..4]).into_owned(), &bytes[8..8 + length]));
            bytes = &bytes[8 + length.next_multiple_of(2)..];
        }
        chunks
    }

    fn names<'a>(chunks: &'a [(String, &[u8])]) -> Vec<&'a str> {
        chunks.iter().map(|(name, _)| name.as_str()).collect()
    }

    #[test]
    fn the_lists_nest_and_their_lengths_add_up() {
        let jpegs = [vec![1; 101], vec![2; 64], vec![3; 7]];
        let file = encoded(&jpegs);
        let riff = chunks(&file);
        assert_eq!(names(&riff), ["RIFF"]);
        assert_eq!(&riff[0].1[..4], b"AVI ");
        let top = chunks(&riff[0].1[4..]);
        assert_eq!(names(&top), ["LIST", "LIST", "idx1"]);
        assert_eq!((&top[0].1[..4], &top[1].1[..4]), (b"hdrl".as_slice(), b"movi".as_slice()));
        let hdrl = chunks(&top[0].1[4..]);
        assert_eq!(names(&hdrl), ["avih", "LIST"]);
        let avih = hdrl[0].1;
        assert_eq!((avih.len(), word(avih, 0), word(avih, 16)), (56, 40_000, 3));
        assert_eq!((word(avih, 32), word(avih, 36)), (33, 17));
        assert_eq!(&hdrl[1].1[..4], b"strl");
        let strl = chunks(&hdrl[1].1[4..]);
        assert_eq!(names(&strl), ["strh", "strf"]);
        let (strh, strf) = (strl[0].1, strl[1].1);
        assert_eq!((strh.len(), &strh[..8]), (56, b"vidsMJPG".as_slice()));
        assert_eq!((word(strh, 24), word(strh, 20), word(strh, 32)), (25, 1, 3));
        assert_eq!(
            (strf.len(), word(strf, 4), word(strf, 8), &strf[16..20]),
            (40, 33, 17, b"MJPG".as_slice())
        );
        let movi = chunks(&top[1].1[4..]);
        assert_eq!(names(&movi), ["00dc"; 3]);
        for (chunk, jpeg) in movi.iter().zip(&jpegs) {
            assert_eq!(chunk.1, jpeg);
        }
    }

    #[test]
    fn the_index_points_at_the_frames() {
        let jpegs = [vec![1; 101], vec![2; 64], vec![3; 7]];
        let file = encoded(&jpegs);
        let movi = HEADER_BYTES as usize - 4;
        let index = file.len() - 3 * 16;
        assert_eq!(&file[index - 8..index - 4], b"idx1");
        for (number, jpeg) in jpegs.iter().enumerate() {
            let entry = &file[index + number * 16..][..16];
            let at = movi + word(entry, 8);
            assert_eq!(&file[at..at + 4], b"00dc");
            assert_eq!((word(&file, at + 4), word(entry, 12)), (jpeg.len(), jpeg.len()));
            assert_eq!(&file[at + 8..at + 8 + jpeg.len()], jpeg);
        }
    }

    #[test]
    fn frames_are_jpegs_near_the_frame() {
        let jpeg = jpeg(&frame(0.5), [0; 3]).expect("memory takes it");
        let decoded = image::load_from_memory(&jpeg).expect("a JPEG").to_rgb8();
        assert_eq!(decoded.dimensions(), (33, 17));
        let expected = rgb8_over(&frame(0.5), [0; 3]);
        assert!(decoded.iter().zip(&expected).all(|(got, want)| got.abs_diff(*want) <= 4));
    }

    #[test]
    fn a_file_of_two_gib_is_not_begun() {
        let mut encoder = AviEncoder::new(Cursor::new(Vec::new()), &DESC).expect("memory takes it");
        encoder.chunks_bytes = MAX_FILE_BYTES - HEADER_BYTES - 24 - 108;
        assert!(encoder.has_room_for(&[0; 100]));
        assert!(!encoder.has_room_for(&[0; 101]));
    }
}
