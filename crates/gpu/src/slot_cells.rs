use glassbrick_residency::SlotId;
use glassbrick_volume::{BrickCells, Occupancy, ShownValues};
use wgpu::BufferUsages;

use crate::grown_buffer::GrownBuffer;
use crate::{GpuDevice, GpuError};

/// Cells along an axis of the largest brick whose cells are kept.
const MOST_CELLS: usize = 64;

/// What a march asks of the cells of bricks.
#[derive(Clone, Debug, PartialEq)]
pub enum CellQuestion {
    /// How far is a cell from one that shows something?
    Distance(ShownValues),
    /// What is the rank of its best value? A rank is x times the stored value, and y.
    Rank([f32; 2]),
}

/// How answers lie in the buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CellLayout {
    /// Cells along each axis of a brick.
    pub cell_edge: u32,
    /// 32-bit words of each slot.
    pub cell_words: u32,
    /// Of each answer.
    pub cell_bytes: u32,
}

impl CellLayout {
    /// No cell is asked about.
    pub const NONE: Self = Self { cell_edge: 0, cell_words: 0, cell_bytes: 1 };
}

impl CellQuestion {
    fn answer_bytes(&self) -> usize {
        match self {
            Self::Distance(_) => 1,
            Self::Rank(_) => 2,
        }
    }
}

/// The answers about the cells of the bricks in the slots, by which marches leap over what cannot change their pixels.
pub struct SlotCells {
    /// Cells along each axis of a brick.
    cell_edge: usize,
    question: Option<CellQuestion>,
    /// By slot.
    ranges: Vec<Option<BrickCells>>,
    /// By slot, as many bytes for each.
    answers: Vec<u8>,
    /// Slots whose answers are not on the device.
    stale: Vec<u32>,
    buffer: GrownBuffer,
}

impl SlotCells {
    pub fn new(brick_edge: u32) -> Self {
        Self {
            cell_edge: BrickCells::edge(brick_edge),
            question: None,
            ranges: Vec::new(),
            answers: Vec::new(),
            stale: Vec::new(),
            buffer: GrownBuffer::new("cells", BufferUsages::STORAGE | BufferUsages::COPY_DST),
        }
    }

    /// A brick with these cells is put into a slot.
    pub fn put(&mut self, slot: SlotId, cells: &BrickCells) {
        if self.is_kept() {
            let slots = self.ranges.len().max(slot.index() + 1);
            self.ranges.resize(slots, None);
            self.ranges[slot.index()] = Some(cells.clone());
            self.stale.push(slot.0);
        }
    }

    /// The cells of the brick in a slot, where they are kept.
    pub fn of(&self, slot: SlotId) -> Option<&BrickCells> {
        self.ranges.get(slot.index())?.as_ref()
    }

    /// Answers a question for every brick in `slots` slots; what is known already is not asked again.
    pub fn answer(
        &mut self,
        device: &GpuDevice,
        question: &Option<CellQuestion>,
        slots: u32,
    ) -> Result<(), GpuError> {
        let bytes = question.as_ref().map_or(0, |question| self.slot_bytes(question));
        let needed = if self.is_kept() { slots as usize * bytes } else { 0 };
        if self.question != *question || self.answers.len() != needed {
            self.stale = (0..self.ranges.len() as u32).collect();
            self.answers = vec![0; needed];
            self.question.clone_from(question);
        }
        self.buffer.grow(device, needed as u64)?;
        let Some(question) = &self.question else { return Ok(()) };
        for slot in std::mem::take(&mut self.stale) {
            let (slot, place) = (slot as usize, slot as usize * bytes..(slot as usize + 1) * bytes);
            if let (Some(cells), Some(answers)) = (&self.ranges[slot], self.answers.get_mut(place.clone())) {
                write_answers(question, cells, answers);
                device.queue.write_buffer(self.buffer.get(), place.start as u64, answers);
            }
        }
        Ok(())
    }

    /// How the answers to the last question lie.
    pub fn layout(&self) -> CellLayout {
        match &self.question {
            Some(question) if self.is_kept() => CellLayout {
                cell_edge: self.cell_edge as u32,
                cell_words: (self.slot_bytes(question) / 4) as u32,
                cell_bytes: question.answer_bytes() as u32,
            },
            _ => CellLayout::NONE,
        }
    }

    pub fn binding(&self) -> wgpu::BindingResource<'_> {
        self.buffer.binding()
    }

    fn is_kept(&self) -> bool {
        self.cell_edge <= MOST_CELLS
    }

    fn slot_bytes(&self, question: &CellQuestion) -> usize {
        (self.cell_edge.pow(3) * question.answer_bytes()).next_multiple_of(4)
    }
}

fn write_answers(question: &CellQuestion, cells: &BrickCells, answers: &mut [u8]) {
    match question {
        CellQuestion::Distance(shown) => match Occupancy::new(cells, |min, max| shown.meets(min, max)) {
            Some(occupancy) => {
                let count = cells.min.len();
                answers[..count].copy_from_slice(&occupancy.distance[..count]);
            }
            None => answers.fill(u8::MAX),
        },
        CellQuestion::Rank([scale, offset]) => {
            let (answers, _) = answers.as_chunks_mut::<2>();
            for ((answer, &min), &max) in answers.iter_mut().zip(&cells.min).zip(&cells.max) {
                let best = (scale * min + offset).max(scale * max + offset);
                *answer = ((best * 65535.0).ceil() as u16).to_le_bytes();
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glassbrick_volume::{Band, Rescale};

    fn cells() -> BrickCells {
        let max: Vec<f32> = (0..27).map(|cell| if cell == 13 { 900.0 } else { 100.0 }).collect();
        BrickCells { edge: 3, min: vec![0.0; 27], max }
    }

    #[test]
    fn cells_tell_how_far_it_is_to_one_that_shows_something() {
        let band = Band { low: 500.0, high: f64::INFINITY };
        let shown = ShownValues::new(&[band], Rescale::IDENTITY);
        let mut answers = [0; 28];
        write_answers(&CellQuestion::Distance(shown.clone()), &cells(), &mut answers);
        assert_eq!((answers[13], answers[0], answers[26]), (0, 1, 1));
        let nothing = BrickCells { max: vec![0.0; 27], ..cells() };
        write_answers(&CellQuestion::Distance(shown), &nothing, &mut answers);
        assert_eq!(answers[13], u8::MAX);
    }

    #[test]
    fn ranks_are_never_below_what_a_cell_has() {
        let mut answers = [0; 56];
        let rank =
            |answers: &[u8], cell: usize| u16::from_le_bytes([answers[2 * cell], answers[2 * cell + 1]]);
        write_answers(&CellQuestion::Rank([1.0 / 1000.0, 0.0]), &cells(), &mut answers);
        assert_eq!((rank(&answers, 13), rank(&answers, 0)), (58982, 6554));
        write_answers(&CellQuestion::Rank([-1.0 / 1000.0, 1.0]), &cells(), &mut answers);
        assert_eq!(rank(&answers, 13), u16::MAX, "the smallest is the best");
    }
}
