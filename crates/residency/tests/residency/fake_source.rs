use std::sync::{Arc, Condvar, Mutex, MutexGuard};

use glam::UVec3;
use glassbrick_volume::{
    Brick, BrickGrid, BrickId, BrickLayout, BrickRange, BrickSource, ReadError, StoredType, VolumeDesc,
    VoxelCountTable, Voxels,
};

/// A brick that cannot be read.
pub const DAMAGED: u32 = 1000;
/// A brick at which the reader panics.
pub const PANICS: u32 = 2000;

/// A source whose bricks come when they are let, and which remembers what it was asked for.
pub struct FakeSource {
    desc: VolumeDesc,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Default)]
struct State {
    begun: Vec<BrickId>,
    told: Vec<BrickId>,
    is_open: bool,
}

impl FakeSource {
    /// A source that gives no brick until it is opened.
    pub fn closed() -> Arc<Self> {
        let desc = VolumeDesc::new(UVec3::splat(4), StoredType::U8);
        Arc::new(Self { desc, state: Mutex::default(), changed: Condvar::new() })
    }

    /// A source that gives bricks at once.
    pub fn open() -> Arc<Self> {
        let source = Self::closed();
        source.let_through();
        source
    }

    /// Gives all bricks that are asked for from here on.
    pub fn let_through(&self) {
        self.lock().is_open = true;
        self.changed.notify_all();
    }

    /// Waits until that many bricks were asked for.
    pub fn wait_until_begun(&self, bricks: usize) {
        let waiting = |state: &mut State| state.begun.len() < bricks;
        drop(self.changed.wait_while(self.lock(), waiting).expect("no holder panics"));
    }

    /// What was asked for, in that order.
    pub fn begun(&self) -> Vec<BrickId> {
        self.lock().begun.clone()
    }

    /// What was hinted at, in that order.
    pub fn told(&self) -> Vec<BrickId> {
        self.lock().told.clone()
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().expect("no holder panics")
    }
}

impl BrickSource for FakeSource {
    fn desc(&self) -> &VolumeDesc {
        &self.desc
    }
    fn levels(&self) -> u32 {
        1
    }
    fn grid(&self, level: u32) -> BrickGrid {
        BrickLayout { edge: 8, halo: 2 }.level_grid(self.desc.extent, level)
    }
    fn ranges(&self, _level: u32) -> &[BrickRange] {
        &[]
    }
    fn voxel_count_tables(&self, _level: u32) -> Result<Arc<Vec<VoxelCountTable>>, ReadError> {
        Err("there are none".into())
    }
    fn brick(&self, id: BrickId) -> Result<Arc<Brick>, ReadError> {
        self.lock().begun.push(id);
        self.changed.notify_all();
        drop(self.changed.wait_while(self.lock(), |state| !state.is_open).expect("no holder panics"));
        match id.x {
            DAMAGED => Err("brick 1000,0,0 of level 0 is damaged".into()),
            PANICS => panic!("the reader is at its end"),
            x => Ok(Arc::new(Brick::new(1, Voxels::U16(vec![x as u16; 1 + Brick::PADDING])))),
        }
    }
    fn will_need(&self, bricks: &[BrickId]) {
        self.lock().told.extend(bricks);
    }
    fn can_hold(&self, _bricks: usize) -> bool {
        false
    }
    fn not_finite(&self) -> u64 {
        0
    }
    fn bytes_read(&self) -> u64 {
        0
    }
}
