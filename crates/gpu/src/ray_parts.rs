use glam::DVec3;
use glassbrick_shaders::RayPart;
use glassbrick_volume::FrameRays;

/// What each column, and then each row, of a picture adds to its rays.
///
/// Positions are formed in f64 and rounded to f32 once, as the picture's definition asks, though the GPU has no f64: of
/// each part, `high` is a multiple of one power of two, so coarse that two highs add exactly, and `low` is the rest.
pub fn ray_parts(rays: &FrameRays) -> Vec<RayPart> {
    let fan = rays.fan();
    let columns = (0..rays.size.x).map(|column| {
        let x = rays.across(column);
        let at = |[middle, across, _]: [DVec3; 3]| middle + across * x;
        (at(fan.start_voxel), at(fan.step_voxel), fan.half_extent[0] * x)
    });
    let rows = (0..rays.size.y).map(|row| {
        let y = rays.along(row);
        let at = |[_, _, along]: [DVec3; 3]| along * y;
        (at(fan.start_voxel), at(fan.step_voxel), fan.half_extent[1] * y)
    });
    let parts: Vec<(DVec3, DVec3, f64)> = columns.chain(rows).collect();
    let start_grain = grain(parts.iter().map(|(start, _, _)| *start));
    let step_grain = grain(parts.iter().map(|(_, step, _)| *step));
    let part = |&(start, step, aside): &(DVec3, DVec3, f64)| {
        let ([start_high, start_low], [step_high, step_low]) =
            (split(start, start_grain), split(step, step_grain));
        let [x, y, z, _] = start_high;
        RayPart { start_high: [x, y, z, aside as f32], start_low, step_high, step_low }
    };
    parts.iter().map(part).collect()
}

/// The finest power of two of which every multiple up to twice the largest component is an f32.
fn grain(parts: impl Iterator<Item = DVec3>) -> f64 {
    let largest = parts.fold(0.0f64, |largest, part| largest.max(part.abs().max_element()));
    let bits = f64::from(f32::MANTISSA_DIGITS);
    (largest.max(f64::from(f32::MIN_POSITIVE)).log2().ceil() + 1.0 - bits).exp2()
}

fn split(part: DVec3, grain: f64) -> [[f32; 4]; 2] {
    let high = (part / grain).round() * grain;
    [high, part - high].map(|part| part.as_vec3().extend(0.0).to_array())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, UVec3, Vec3};
    use glassbrick_volume::{Camera, Projection, StoredType, VolumeDesc};

    fn sum(column: &RayPart, row: &RayPart) -> (Vec3, Vec3, Vec3) {
        let add = |a: [f32; 4], b: [f32; 4]| Vec3::from_slice(&a) + Vec3::from_slice(&b);
        let start = add(column.start_high, row.start_high) + add(column.start_low, row.start_low);
        let step = add(column.step_high, row.step_high) + add(column.step_low, row.step_low);
        (start, step, Vec3::new(column.start_high[3], row.start_high[3], 1.0))
    }

    #[test]
    fn parts_add_up_to_the_rays_that_the_cpu_forms() {
        let desc = VolumeDesc::new(UVec3::new(512, 304, 1730), StoredType::U16);
        let size = UVec2::new(61, 47);
        for (azimuth, projection) in [
            (0.0, Projection::Perspective { fov_y_deg: 30.0 }),
            (33.0, Projection::Perspective { fov_y_deg: 30.0 }),
            (120.0, Projection::Orthographic { height_mm: 900.0 }),
        ] {
            let camera = Camera { projection, ..Camera::framing_around(&desc, azimuth, 20.0) };
            let rays = FrameRays::new(&desc.level(0), &camera, size, 0.7).expect("sound camera");
            let parts = ray_parts(&rays);
            let mut differ = 0;
            for row in 0..size.y {
                for column in 0..size.x {
                    let ray = rays.ray(column, row);
                    let (start, step, aside) = sum(&parts[column as usize], &parts[(size.x + row) as usize]);
                    let ulps = |a: f32, b: f32| (a - b).abs() <= a.abs() * f32::EPSILON;
                    assert!((0..3).all(|axis| ulps(ray.start[axis], start[axis])), "{ray:?} {start}");
                    assert!((0..3).all(|axis| ulps(ray.step[axis], step[axis])), "{ray:?} {step}");
                    differ += u32::from(ray.start != start || ray.step != step);
                    let length = rays.step_mm as f32 * aside.length();
                    assert!((length - ray.step_length_mm).abs() < 1e-6 * length);
                }
            }
            assert!(differ <= size.element_product() / 100, "{differ} rays differ in their last bit");
        }
    }
}
