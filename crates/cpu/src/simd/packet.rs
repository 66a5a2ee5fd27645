use glassbrick_volume::{FrameRays, PixelRect};

use super::lanes::Lanes;

/// Rays of a packet: 4×4 pixels.
pub const PACKET: usize = 16;

/// Pixels along a packet's side.
const SIDE: u32 = 4;

/// Steps are kept this far from zero when they are divided by, so that a ray along a face gives no NaN.
const SMALLEST_STEP: f32 = 1e-30;

/// One element for each ray of a packet.
pub type Column = [f32; PACKET];

/// Sixteen rays and what they have gathered, `S`.
pub struct Packet<S> {
    rect: PixelRect,
    /// Position of sample number 0, in voxels, by axis.
    pub start: [Column; 3],
    /// From one sample to the next.
    pub step: [Column; 3],
    /// One over the step.
    pub per_step: [Column; 3],
    /// World length of a step.
    pub step_length_mm: Column,
    /// The rays that are in the picture, by bit.
    pub in_picture: u32,
    /// The rays that no further sample is to be added to, by bit.
    pub done: u32,
    pub state: S,
}

impl<S> Packet<S> {
    /// The pixels of `rect`, which holds 4×4 or fewer.
    fn new(rays: &FrameRays, rect: PixelRect, state: S) -> Self {
        let mut packet = Self {
            rect,
            start: [[0.0; PACKET]; 3],
            step: [[1.0; PACKET]; 3],
            per_step: [[1.0; PACKET]; 3],
            step_length_mm: [1.0; PACKET],
            in_picture: 0,
            done: 0,
            state,
        };
        for row in rect.min[1]..rect.max[1] {
            for column in rect.min[0]..rect.max[0] {
                let lane = ((row - rect.min[1]) * SIDE + column - rect.min[0]) as usize;
                let ray = rays.ray(column, row);
                for axis in 0..3 {
                    packet.start[axis][lane] = ray.start[axis];
                    packet.step[axis][lane] = ray.step[axis];
                    let step = ray.step[axis];
                    packet.per_step[axis][lane] = 1.0 / step.abs().max(SMALLEST_STEP).copysign(step);
                }
                packet.step_length_mm[lane] = ray.step_length_mm;
                packet.in_picture |= 1 << lane;
            }
        }
        packet
    }

    /// The rays that take more samples, by bit.
    pub fn open(&self) -> u32 {
        self.in_picture & !self.done
    }

    /// The rays in the picture whose pixels lie in a rectangle, by bit.
    pub fn rays_in(&self, rect: &PixelRect) -> u32 {
        let bits = |axis: usize| {
            let first = rect.min[axis].saturating_sub(self.rect.min[axis]).min(SIDE);
            let end = rect.max[axis].saturating_sub(self.rect.min[axis]).min(SIDE);
            (first..end).fold(0u32, |bits, place| bits | 1 << place)
        };
        let (columns, rows) = (bits(0), bits(1));
        let in_rect =
            (0..SIDE).filter(|row| rows & (1 << row) != 0).fold(0, |all, row| all | columns << (row * SIDE));
        in_rect & self.in_picture
    }

    pub fn meets(&self, rect: &PixelRect) -> bool {
        self.rect.overlaps(rect)
    }
}

/// The way that vectors of rays go from sample to sample.
pub struct LaneSteps<L: Lanes> {
    /// In voxels, by axis.
    pub voxels: [L::F; 3],
    pub length_mm: L::F,
}

/// A tile as packets.
pub struct PacketTile<S> {
    pub rect: PixelRect,
    pub packets: Vec<Packet<S>>,
}

impl<S: Copy> PacketTile<S> {
    pub fn new(rays: &FrameRays, rect: PixelRect, start: S) -> Self {
        let corners = |axis: usize| (rect.min[axis]..rect.max[axis]).step_by(SIDE as usize);
        let packets = corners(1).flat_map(|row| corners(0).map(move |column| [column, row])).map(|min| {
            let max = [0, 1].map(|axis| (min[axis] + SIDE).min(rect.max[axis]));
            Packet::new(rays, PixelRect { min, max }, start)
        });
        Self { rect, packets: packets.collect() }
    }

    /// The packet and the ray of each pixel, row by row.
    pub fn pixels(&self) -> impl Iterator<Item = (&Packet<S>, usize)> {
        let [width, height] = [0, 1].map(|axis| self.rect.max[axis] - self.rect.min[axis]);
        let packets_across = width.div_ceil(SIDE);
        (0..height).flat_map(move |row| (0..width).map(move |column| (column, row))).map(
            move |(column, row)| {
                let packet = (row / SIDE * packets_across + column / SIDE) as usize;
                (&self.packets[packet], (row % SIDE * SIDE + column % SIDE) as usize)
            },
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, UVec3};
    use glassbrick_volume::{Camera, NamedView, StoredType, VolumeDesc};

    #[test]
    fn every_pixel_has_its_own_ray_at_the_pictures_edge_too() {
        let desc = VolumeDesc::new(UVec3::splat(20), StoredType::U8);
        let camera = Camera::framing(&desc, NamedView::Front);
        let rays = FrameRays::new(&desc.level(0), &camera, UVec2::new(7, 6), 1.0).expect("sound");
        let rect = PixelRect { min: [0, 0], max: [7, 6] };
        let tile = PacketTile::new(&rays, rect, ());
        let places = (0..6).flat_map(|row| (0..7).map(move |column| (column, row)));
        for ((packet, lane), (column, row)) in tile.pixels().zip(places) {
            assert_eq!(packet.start[0][lane], rays.ray(column, row).start.x);
            assert_eq!(packet.start[2][lane], rays.ray(column, row).start.z);
            let one = PixelRect { min: [column, row], max: [column + 1, row + 1] };
            assert_eq!(packet.rays_in(&one), 1 << lane);
        }
        assert_eq!(tile.packets.iter().map(|packet| packet.in_picture.count_ones()).sum::<u32>(), 42);
    }
}
