use glam::{DVec3, DVec4};
use glassbrick_shaders::RayFan;
use glassbrick_volume::FrameRays;

/// How the rays of a frame fan out, for shaders.
///
/// Positions are formed in f64 and rounded to f32 once, as the picture's definition asks, though a GPU has no f64: of each
/// coefficient, `high` is a multiple of one power of two, so coarse that neither its product with a column's number nor
/// the sum of them all is rounded, and `low` is the rest.
pub fn ray_fan(rays: &FrameRays) -> RayFan {
    let fan = rays.fan();
    let size = rays.size.as_dvec2();
    // Pixel (0, 0), and from one column and row to the next.
    let by_pixel = |[middle, across, along]: [DVec3; 3]| {
        let first = middle + across * rays.across(0) + along * rays.along(0);
        [first, across * (2.0 / size.x), along * (-2.0 / size.y)]
    };
    let [half_width, half_height] = fan.half_extent;
    let right = [half_width * rays.across(0), half_width * 2.0 / size.x, 0.0];
    let up = [half_height * rays.along(0), 0.0, -half_height * 2.0 / size.y];
    let with = |parts: [DVec3; 3], aside: [f64; 3]| [0, 1, 2].map(|part| parts[part].extend(aside[part]));
    let (start_high, start_low) = split(with(by_pixel(fan.start_voxel), right), rays);
    let (step_high, step_low) = split(with(by_pixel(fan.step_voxel), up), rays);
    RayFan { start_high, start_low, step_high, step_low }
}

type Coefficients = [[f32; 4]; 3];

fn split(parts: [DVec4; 3], rays: &FrameRays) -> (Coefficients, Coefficients) {
    let grains = grains(parts, rays);
    let high = parts.map(|part| (part / grains).round() * grains);
    let low = [0, 1, 2].map(|part| parts[part] - high[part]);
    let to_f32 = |parts: [DVec4; 3]| parts.map(|part| part.as_vec4().to_array());
    (to_f32(high), to_f32(low))
}

/// Of each component, the finest power of two of which every multiple up to what any sum over the picture can reach is an
/// f32.
fn grains([first, across, along]: [DVec4; 3], rays: &FrameRays) -> DVec4 {
    let size = rays.size.as_dvec2();
    // A little more, for coefficients are rounded to the grain.
    let largest = (first.abs() + across.abs() * size.x + along.abs() * size.y) * 1.01;
    let bits = f64::from(f32::MANTISSA_DIGITS);
    largest.map(|largest| (largest.max(f64::from(f32::MIN_POSITIVE)).log2().ceil() - bits).exp2())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{UVec2, UVec3, Vec3, Vec4};
    use glassbrick_volume::{Camera, Projection, StoredType, VolumeDesc};

    /// As the shader adds them.
    fn sum(parts: &Coefficients, column: u32, row: u32) -> Vec4 {
        let [first, across, along] = parts.map(Vec4::from_array);
        first + across * column as f32 + along * row as f32
    }

    #[test]
    fn shaders_form_the_rays_that_the_cpu_forms() {
        let desc = VolumeDesc::new(UVec3::new(512, 304, 1730), StoredType::U16);
        for size in [UVec2::new(61, 47), UVec2::new(2000, 1), UVec2::new(333, 150)] {
            for (azimuth, projection) in [
                (0.0, Projection::Perspective { fov_y_deg: 30.0 }),
                (33.0, Projection::Perspective { fov_y_deg: 30.0 }),
                (120.0, Projection::Orthographic { height_mm: 900.0 }),
            ] {
                let camera = Camera { projection, ..Camera::framing_around(&desc, azimuth, 20.0) };
                let rays = FrameRays::new(&desc.level(0), &camera, size, 0.7).expect("sound camera");
                let fan = ray_fan(&rays);
                let mut differ = 0;
                for (column, row) in (0..size.y).flat_map(|row| (0..size.x).map(move |column| (column, row)))
                {
                    let ray = rays.ray(column, row);
                    let start = sum(&fan.start_high, column, row) + sum(&fan.start_low, column, row);
                    let step = sum(&fan.step_high, column, row) + sum(&fan.step_low, column, row);
                    let length = rays.step_mm as f32 * Vec3::new(start.w, step.w, 1.0).length();
                    let (start, step) = (start.truncate(), step.truncate());
                    let ulps = |a: f32, b: f32| (a - b).abs() <= a.abs().max(0.1) * f32::EPSILON;
                    assert!((0..3).all(|axis| ulps(ray.start[axis], start[axis])), "{ray:?} {start}");
                    assert!((0..3).all(|axis| ulps(ray.step[axis], step[axis])), "{ray:?} {step}");
                    differ += u32::from(ray.start != start || ray.step != step);
                    assert!((length - ray.step_length_mm).abs() < 1e-6 * length);
                }
                assert!(differ <= size.element_product() / 50, "{differ} rays differ in their last bit");
            }
        }
    }
}
