//! Anything that may be done with a working set.

use glam::UVec3;
use glassbrick_volume::{BrickGrid, BrickId, BrickLayout};
use proptest::prelude::*;
use proptest::sample::subsequence;

/// One thing that is done.
#[derive(Clone, Debug)]
pub enum Deed {
    BeginFrame,
    SetDrawn(BrickId),
    Hold(BrickId),
    Admit(BrickId),
    EndRound,
    Remove(BrickId),
    Clear,
    Limit(u32),
    Pin(Vec<BrickId>),
    Plan(Vec<u32>),
    Round(Vec<BrickId>, usize),
    /// A whole frame, until every brick of it is drawn.
    Frame(Vec<BrickId>, usize),
}

/// 24 bricks.
pub fn grid() -> BrickGrid {
    BrickLayout { edge: 8, halo: 2 }.grid(UVec3::new(16, 12, 8))
}

/// The grid's bricks, and some of the level above.
pub fn all_bricks() -> Vec<BrickId> {
    let grid = grid();
    let level_0 = (0..grid.len()).map(|index| BrickId::new(0, grid.brick(index)));
    level_0.chain((0..4).map(|x| BrickId { level: 1, x, y: 0, z: 0 })).collect()
}

/// Some bricks, each once, in any order.
fn some_bricks() -> impl Strategy<Value = Vec<BrickId>> {
    let all = all_bricks();
    let most = all.len();
    subsequence(all, 0..=most).prop_shuffle()
}

/// Places of some bricks of the grid, ascending.
pub fn plan() -> impl Strategy<Value = Vec<u32>> {
    let all: Vec<u32> = (0..grid().len() as u32).collect();
    let most = all.len();
    subsequence(all, 0..=most)
}

/// Anything that may be done.
pub fn deed() -> impl Strategy<Value = Deed> {
    let one = || proptest::sample::select(all_bricks());
    let most_loads = || prop_oneof![0..6usize, Just(usize::MAX)];
    prop_oneof![
        2 => Just(Deed::BeginFrame),
        4 => one().prop_map(Deed::SetDrawn),
        4 => one().prop_map(Deed::Hold),
        4 => one().prop_map(Deed::Admit),
        2 => Just(Deed::EndRound),
        2 => one().prop_map(Deed::Remove),
        1 => Just(Deed::Clear),
        1 => (0..20u32).prop_map(Deed::Limit),
        2 => some_bricks().prop_map(Deed::Pin),
        2 => plan().prop_map(Deed::Plan),
        4 => (some_bricks(), most_loads()).prop_map(|(wanted, most)| Deed::Round(wanted, most)),
        4 => (some_bricks(), most_loads()).prop_map(|(wanted, most)| Deed::Frame(wanted, most)),
    ]
}
