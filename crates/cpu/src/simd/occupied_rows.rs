use glassbrick_volume::BrickCells;

/// The cells of a brick that may show something, as bits of rows along x.
pub struct OccupiedRows {
    /// By the rows' places along y, then z.
    pub rows: Vec<u8>,
}

impl OccupiedRows {
    /// Cells along an axis of the largest brick that there is room for.
    pub const MOST_CELLS: usize = 8;

    /// All cells.
    pub fn all() -> Self {
        Self { rows: vec![u8::MAX; Self::MOST_CELLS * Self::MOST_CELLS] }
    }

    /// The cells for which `shows` holds of their smallest and largest stored value; nothing where it holds for none.
    pub fn new(cells: &BrickCells, shows: impl Fn(f32, f32) -> bool) -> Option<Self> {
        let rows = cells.min.chunks_exact(cells.edge).zip(cells.max.chunks_exact(cells.edge));
        let bits = |(min, max): (&[f32], &[f32])| {
            let shown = min.iter().zip(max).map(|(&min, &max)| shows(min, max));
            shown.enumerate().fold(0, |bits, (x, shown)| bits | u8::from(shown) << x)
        };
        let rows: Vec<u8> = rows.map(bits).collect();
        rows.iter().any(|&row| row != 0).then_some(Self { rows })
    }
}
