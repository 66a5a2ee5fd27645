//! The kernel for vectors of rays: packets of 4×4 rays go through a brick together, and leap over its cells that
//! cannot change them.
//!
//! The code is written once for any [`Lanes`] and compiled for each set of instructions; which one runs is chosen
//! when the processor is known.

#![allow(
    clippy::needless_range_loop,
    reason = "an index names the axis or component of several arrays at once"
)]

mod brick;
mod dvr;
mod extremum;
mod functions;
mod instruction_set;
mod lanes;
mod look_up;
mod march;
mod mean;
mod occupied_rows;
mod packet;
mod portable;
mod projection;
mod shown_cells;
mod voxel;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
#[cfg(target_arch = "x86_64")]
mod rows;

use glassbrick_volume::{BrickSource, FrameRays, Mode, PixelRect, ReadError, ShownValues, Skip, Voxels};

use crate::executor::{CpuFrame, CpuScene, draw_with};
use crate::kernel::{BrickView, Kernel};
use crate::scalar::LookUp;
use brick::LaneBrick;
use dvr::{LaneDvr, LaneHeadlight};
use extremum::LaneExtremum;
pub use instruction_set::InstructionSet;
use lanes::Lanes;
use look_up::LaneLookUp;
use march::march;
use mean::LaneMean;
use packet::{PACKET, PacketTile};
use portable::Portable;
use projection::Projection;
pub use shown_cells::ShownCells;
use voxel::LaneVoxel;

/// Bricks larger than this have voxels that an `f32` cannot count.
pub const LARGEST_EDGE: u32 = 256;

/// Draws a planned frame with vectors of rays.
pub fn draw(
    source: &dyn BrickSource,
    scene: &CpuScene,
    instruction_set: InstructionSet,
) -> Result<CpuFrame, ReadError> {
    let (desc, settings) = (source.desc(), &scene.settings);
    let (baked, rescale) = (scene.transfer_function, desc.rescale);
    let common = Vectors {
        projection: (),
        instruction_set,
        skip: settings.skip,
        last_sample: scene.rays.sample_count as f32 - 1.0,
    };
    match settings.mode {
        Mode::Dvr => {
            let light = settings.shading.map(|phong| LaneHeadlight {
                phong,
                normal_from_gradient: desc.level(scene.plan.level).desc.normal_from_gradient().as_mat3(),
            });
            let projection = LaneDvr {
                look_up: LaneLookUp::new(baked, rescale),
                opacity_cutoff: settings.effective_cutoff(),
                light,
                shown: ShownValues::new(&baked.bands(), rescale),
                shown_cells: scene.shown_cells,
                leaps: settings.skip != Skip::None,
            };
            common.with(projection).draw(source, scene)
        }
        mode @ (Mode::Mip | Mode::Minip) => {
            // A negative slope turns the largest value into the smallest stored value.
            let sign = mode.sign(rescale);
            let look_up = LookUp::new(baked, rescale);
            let leaps = settings.skip == Skip::All;
            common.with(LaneExtremum { look_up, sign, leaps }).draw(source, scene)
        }
        Mode::Mean => common.with(LaneMean { look_up: LookUp::new(baked, rescale) }).draw(source, scene),
    }
}

/// One way to form pixels, with one set of instructions.
struct Vectors<P> {
    projection: P,
    instruction_set: InstructionSet,
    skip: Skip,
    last_sample: f32,
}

impl Vectors<()> {
    fn with<P>(self, projection: P) -> Vectors<P> {
        let Self { instruction_set, skip, last_sample, .. } = self;
        Vectors { projection, instruction_set, skip, last_sample }
    }
}

/// A brick that has been looked at.
struct PreparedBrick<'a, C> {
    view: BrickView<'a>,
    cells: C,
    voxels: PreparedVoxels<'a>,
}

enum PreparedVoxels<'a> {
    U8(LaneBrick<'a, u8>),
    I8(LaneBrick<'a, i8>),
    U16(LaneBrick<'a, u16>),
    I16(LaneBrick<'a, i16>),
    F32(LaneBrick<'a, f32>),
}

impl<P: Projection> Kernel for Vectors<P> {
    type Tile = PacketTile<P::State>;
    type Prepared<'a> = PreparedBrick<'a, P::Cells>;

    fn start(&self, rays: &FrameRays, rect: PixelRect) -> Self::Tile {
        PacketTile::new(rays, rect, self.projection.start())
    }

    fn is_unchanged_by(&self, tile: &Self::Tile, rect: &PixelRect, reach: [f32; 2]) -> bool {
        let mut packets = tile.packets.iter().filter(|packet| packet.meets(rect));
        packets.all(|packet| packet.rays_in(rect) & !self.projection.unchanged_by(packet, reach) == 0)
    }

    fn prepare<'a>(&self, view: BrickView<'a>) -> Option<Self::Prepared<'a>> {
        let cells = self.projection.cells(&view)?;
        let occupancy = P::occupancy(&cells);
        let voxels = match &view.brick.voxels {
            Voxels::U8(voxels) => PreparedVoxels::U8(LaneBrick::new(&view, voxels, occupancy)),
            Voxels::I8(voxels) => PreparedVoxels::I8(LaneBrick::new(&view, voxels, occupancy)),
            Voxels::U16(voxels) => PreparedVoxels::U16(LaneBrick::new(&view, voxels, occupancy)),
            Voxels::I16(voxels) => PreparedVoxels::I16(LaneBrick::new(&view, voxels, occupancy)),
            Voxels::F32(voxels) => PreparedVoxels::F32(LaneBrick::new(&view, voxels, occupancy)),
        };
        Some(PreparedBrick { view, cells, voxels })
    }

    fn add_brick(&self, tile: &mut Self::Tile, brick: &Self::Prepared<'_>) -> u64 {
        match &brick.voxels {
            PreparedVoxels::U8(voxels) => self.add_voxels(tile, brick, voxels),
            PreparedVoxels::I8(voxels) => self.add_voxels(tile, brick, voxels),
            PreparedVoxels::U16(voxels) => self.add_voxels(tile, brick, voxels),
            PreparedVoxels::I16(voxels) => self.add_voxels(tile, brick, voxels),
            PreparedVoxels::F32(voxels) => self.add_voxels(tile, brick, voxels),
        }
    }

    fn rank(&self, reach: [f32; 2]) -> Option<f32> {
        self.projection.rank(reach)
    }

    fn finish(&self, tile: &Self::Tile, mut pixel: impl FnMut([f32; 4], u32)) {
        for (packet, lane) in tile.pixels() {
            let (rgba, number) = self.projection.finish(&packet.state, lane);
            pixel(rgba, number);
        }
    }
}

impl<P: Projection> Vectors<P> {
    /// Draws along the volume's rows where the rays go so, else by gathering voxels.
    fn draw(&self, source: &dyn BrickSource, scene: &CpuScene) -> Result<CpuFrame, ReadError> {
        #[cfg(target_arch = "x86_64")]
        if let Some(rays) = rows::suits(source, scene, self.instruction_set) {
            return rows::draw(&self.projection, source, scene, &rays);
        }
        draw_with(self, source, scene)
    }

    fn add_voxels<V: LaneVoxel>(
        &self,
        tile: &mut PacketTile<P::State>,
        brick: &PreparedBrick<P::Cells>,
        voxels: &LaneBrick<V>,
    ) -> u64 {
        match self.instruction_set {
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this set is chosen only where AVX-512F and POPCNT were detected.
            InstructionSet::Avx512 => unsafe { self.add_with_avx512(tile, brick, voxels) },
            #[cfg(target_arch = "x86_64")]
            // SAFETY: this set is chosen only where AVX2 and FMA were detected.
            InstructionSet::Avx2 => unsafe { self.add_with_avx2(tile, brick, voxels) },
            _ => self.add_with::<Portable, V>(tile, brick, voxels),
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx512f,popcnt")]
    fn add_with_avx512<V: LaneVoxel>(
        &self,
        tile: &mut PacketTile<P::State>,
        brick: &PreparedBrick<P::Cells>,
        voxels: &LaneBrick<V>,
    ) -> u64 {
        self.add_with::<avx512::Avx512, V>(tile, brick, voxels)
    }

    #[cfg(target_arch = "x86_64")]
    #[target_feature(enable = "avx2,fma")]
    fn add_with_avx2<V: LaneVoxel>(
        &self,
        tile: &mut PacketTile<P::State>,
        brick: &PreparedBrick<P::Cells>,
        voxels: &LaneBrick<V>,
    ) -> u64 {
        self.add_with::<avx2::Avx2, V>(tile, brick, voxels)
    }

    #[inline(always)]
    fn add_with<L: Lanes, V: LaneVoxel>(
        &self,
        tile: &mut PacketTile<P::State>,
        brick: &PreparedBrick<P::Cells>,
        voxels: &LaneBrick<V>,
    ) -> u64 {
        let mut samples = 0;
        for packet in &mut tile.packets {
            let is_passed_by = packet.open() == 0
                || !packet.meets(&brick.view.footprint)
                || (self.skip == Skip::All
                    && packet.open() & !self.projection.unchanged_by(packet, brick.view.reach) == 0);
            if is_passed_by {
                continue;
            }
            for first in (0..PACKET).step_by(L::COUNT) {
                samples +=
                    march::<P, L, V>(&self.projection, packet, first, voxels, &brick.cells, self.last_sample);
            }
        }
        samples
    }
}
