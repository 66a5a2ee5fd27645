use glam::{UVec2, UVec3, Vec3};
use glassbrick_residency::{AtlasShape, VoxelEncoding};
use glassbrick_shaders::{Frame, Pixels};
use glassbrick_volume::{BrickGrid, BrickRange, Phong, PixelRect, ShownValues, Skip, VolumeDesc};

use crate::atlas_bindings::AtlasBindings;
use crate::ray_fan::ray_fan;
use crate::shared_buffers::SharedBuffers;
use crate::slot_cells::{CellLayout, CellQuestion};
use crate::waiting::Waiting;
use crate::{GpuDevice, GpuScene};

/// The volume's side of a frame.
pub struct Level<'a> {
    pub desc: &'a VolumeDesc,
    pub grid: BrickGrid,
    /// Smallest and largest stored value of the level.
    pub stored_range: [f32; 2],
    pub encoding: VoxelEncoding,
    pub atlas: AtlasShape,
}

/// What the tiles of a frame have in common.
pub struct FrameParts<'a> {
    pub device: &'a GpuDevice,
    pub shared: &'a SharedBuffers,
    pub atlas: &'a AtlasBindings,
    pub scene: &'a GpuScene<'a>,
    pub level: &'a Level<'a>,
    pub ranges: &'a [BrickRange],
    pub pixels: Pixels,
    pub waiting: Waiting,
}

/// What is asked of the cells of bricks; nothing where every sample counts, or every sample is to be taken.
pub fn cell_question(parts: &FrameParts) -> Option<CellQuestion> {
    let (scene, rescale) = (parts.scene, parts.level.desc.rescale);
    match (parts.pixels, scene.settings.skip) {
        (Pixels::Dvr | Pixels::DvrShaded, Skip::Empty | Skip::All) => {
            Some(CellQuestion::Distance(ShownValues::new(&scene.transfer_function.bands(), rescale)))
        }
        (Pixels::Extremum, Skip::All) => {
            let sign = scene.settings.mode.sign(rescale);
            Some(CellQuestion::Rank(rank_from_stored(parts.level.stored_range, sign)))
        }
        _ => None,
    }
}

/// What shaders know of a tile of a frame.
pub fn frame_uniform(
    parts: &FrameParts,
    CellLayout { cell_edge, cell_words, cell_bytes }: CellLayout,
    tile: &PixelRect,
) -> Frame {
    let (scene, level) = (parts.scene, parts.level);
    let (rays, grid, baked) = (scene.rays, &level.grid, scene.transfer_function);
    let rescale = level.desc.rescale;
    let [volume_low, _] = grid.owned_box(UVec3::ZERO);
    let [_, volume_high] = grid.owned_box(grid.counts - 1);
    let Phong { ambient, diffuse, specular, shininess } = scene.settings.shading.unwrap_or_default();
    let normals = level.desc.level(scene.plan.level).desc.normal_from_gradient().as_mat3();
    let sign = scene.settings.mode.sign(rescale);
    let flag = |is_set: bool, flag: u32| if is_set { flag } else { 0 };
    let flags = flag(parts.waiting == Waiting::Never, Frame::PASSES_MISSING)
        | flag(scene.settings.skip == Skip::All, Frame::SKIPS_UNCHANGED);
    Frame {
        tile_origin: tile.min,
        tile_size: (UVec2::from(tile.max) - UVec2::from(tile.min)).to_array(),
        sample_count: rays.sample_count,
        cores_per_voxel: 1.0 / grid.layout.core() as f32,
        core: grid.layout.core(),
        halo: grid.layout.halo,
        grid_counts: grid.counts.to_array(),
        flags,
        volume_low: volume_low.to_array(),
        opacity_cutoff: scene.settings.effective_cutoff().min(f32::MAX),
        volume_high: volume_high.to_array(),
        sign,
        atlas_from_texel: (Vec3::ONE / level.atlas.texture_extent().as_vec3()).to_array(),
        first_stored: rescale.stored(baked.first_value) as f32,
        stored_from_texel: level.encoding.stored_from_texel(),
        stored_bias: level.encoding.bias as f32,
        entries_per_stored: (baked.entries_per_value() * rescale.slope) as f32,
        phong: [ambient, diffuse, specular, shininess],
        normal_from_gradient: [normals.x_axis, normals.y_axis, normals.z_axis]
            .map(|column| column.extend(0.0).to_array()),
        step_mm: rays.step_mm as f32,
        cell_bytes,
        box_depth: box_depth(scene),
        rank_from_stored: rank_from_stored(level.stored_range, sign),
        cell_edge,
        cell_words,
        rays: ray_fan(rays),
    }
}

/// The baked columns as the look-up reads them: linear light and extinction per mm.
pub fn entries(scene: &GpuScene) -> Vec<[f32; 4]> {
    let baked = scene.transfer_function;
    baked.color.iter().zip(&baked.extinction).map(|(&[r, g, b], &extinction)| [r, g, b, extinction]).collect()
}

/// Clip depth of boxes from the slice that a corner lies in. All samples lie half a step in front of the eye or farther;
/// what is nearer than a quarter is clipped.
fn box_depth(scene: &GpuScene) -> [f32; 2] {
    let rays = scene.rays;
    if rays.is_perspective() {
        // Against a depth w in mm: 0 ≤ near ≤ w.
        return [(0.25 * rays.step_mm) as f32, 0.0];
    }
    // Parallel rays: from 1 at the near end to 0 beyond all slices.
    let near = 0.25 + rays.first_sample as f64;
    let slices = 2.0 * (near + f64::from(rays.sample_count) + 1.0);
    [(1.0 - near / slices) as f32, (-1.0 / slices) as f32]
}

/// Rank of stored values, 0 to 1: x times the value and y, the best value at 1.
pub fn rank_from_stored([min, max]: [f32; 2], sign: f32) -> [f32; 2] {
    let (best, worst) = if sign > 0.0 { (max, min) } else { (min, max) };
    if best == worst {
        return [0.0, 1.0];
    }
    let scale = 1.0 / (f64::from(best) - f64::from(worst));
    [scale as f32, (-f64::from(worst) * scale) as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_value_has_the_highest_rank() {
        let rank = |range, sign, value: f32| {
            let [scale, offset] = rank_from_stored(range, sign);
            scale * value + offset
        };
        assert_eq!(rank([-1000.0, 3000.0], 1.0, 3000.0), 1.0);
        assert_eq!(rank([-1000.0, 3000.0], 1.0, -1000.0), 0.0);
        assert_eq!(rank([-1000.0, 3000.0], -1.0, -1000.0), 1.0);
        assert_eq!(rank([7.0, 7.0], 1.0, 7.0), 1.0);
    }
}
