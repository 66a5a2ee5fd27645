//! The files of a store, and what can become of them.

use std::fs;
use std::path::Path;

/// Bytes of a shard's index: offset and length of 64 bricks, and a checksum.
pub const INDEX_BYTES: usize = 64 * 16 + 4;

/// One file of each kind, and whether a picture of level 0 needs it.
pub const KINDS: [Kind; 12] = [
    Kind { file: "zarr.json", needed: true },
    Kind { file: "levels/zarr.json", needed: true },
    Kind { file: "levels/1/zarr.json", needed: true },
    Kind { file: "levels/0/bricks/zarr.json", needed: true },
    Kind { file: "levels/1/range/zarr.json", needed: true },
    Kind { file: "levels/0/vct/zarr.json", needed: true },
    Kind { file: "levels/0/range/c/0/0/0/0", needed: true },
    Kind { file: "levels/1/range/c/0/0/0/0", needed: true },
    Kind { file: "levels/0/vct/c/0/0/0/0", needed: false },
    Kind { file: "levels/0/bricks/c/0/0/0/0/0/0", needed: true },
    Kind { file: "levels/0/bricks/c/0/1/1/0/0/0", needed: true },
    Kind { file: "levels/1/bricks/c/0/0/0/0/0/0", needed: false },
];

/// A file of a store that stands for all of its kind.
#[derive(Clone, Copy, Debug)]
pub struct Kind {
    pub file: &'static str,
    pub needed: bool,
}

impl Kind {
    pub fn is_json(self) -> bool {
        self.file.ends_with("json")
    }

    pub fn is_bricks(self) -> bool {
        self.file.contains("bricks/c/")
    }
}

/// What becomes of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Damage {
    /// The byte there has other bits.
    Flipped {
        at: usize,
        bits: u8,
    },
    CutTo(usize),
    Missing,
    /// It is a folder.
    Folder,
    Trailing(&'static [u8]),
}

impl Damage {
    /// Damage of every sort, all over a file of so many bytes.
    pub fn all(file: Kind, bytes: &[u8]) -> Vec<Self> {
        let len = bytes.len();
        let mut damage =
            vec![Self::Missing, Self::Folder, Self::Trailing(b"\0"), Self::Trailing(&[255; 2000])];
        damage.extend([0, 1, len / 2, len - 5, len - 1].map(Self::CutTo));
        let mut places: Vec<usize> = (0..8).map(|part| part * len / 8).collect();
        places.extend([len - 2, len - 4, len - 5]);
        if file.is_bricks() {
            // All over the index.
            places.extend((0..6).map(|part| len - INDEX_BYTES + part * INDEX_BYTES / 6));
        }
        if file.is_json() {
            places.extend((1..20).map(|part| part * len / 20));
        }
        let flipped =
            |(number, &at): (usize, &usize)| Self::Flipped { at, bits: [0x10, 1, 0x80][number % 3] };
        damage.extend(places.iter().enumerate().map(flipped));
        if file.is_json() {
            // Spaces become line ends, which say the same.
            let spaces = (0..len).filter(|&at| bytes[at] == b' ').step_by(len / 8);
            damage.extend(spaces.map(|at| Self::Flipped { at, bits: b' ' ^ b'\n' }));
            damage.push(Self::Trailing(b"\n \n"));
        }
        damage
    }

    /// Does it to a file that holds `bytes`.
    pub fn inflict(self, path: &Path, bytes: &[u8]) {
        let mut bytes = bytes.to_vec();
        match self {
            Self::Flipped { at, bits } => bytes[at] ^= bits,
            Self::CutTo(len) => bytes.truncate(len),
            Self::Trailing(more) => bytes.extend(more),
            Self::Missing => return fs::remove_file(path).expect("it is there"),
            Self::Folder => {
                fs::remove_file(path).expect("it is there");
                return fs::create_dir(path).expect("there is nothing");
            }
        }
        fs::write(path, bytes).expect("a scratch file");
    }

    /// Makes the file what it was.
    pub fn undo(self, path: &Path, bytes: &[u8]) {
        if self == Self::Folder {
            fs::remove_dir(path).expect("it is empty");
        }
        fs::write(path, bytes).expect("a scratch file");
    }
}
