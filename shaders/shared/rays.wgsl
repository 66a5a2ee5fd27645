#define_import_path glassbrick::rays
#import glassbrick::frame::frame

struct Ray {
    // Position of sample number 0, in voxels.
    start: vec3f,
    step: vec3f,
    step_length_mm: f32,
}

// The ray of a pixel of the picture: the f32 values that the CPU forms in f64 and rounds.
fn ray_of(pixel: vec2u) -> Ray {
    let at = vec2f(pixel);
    let start_high = frame.rays.start_high[0] + at.x * frame.rays.start_high[1] + at.y * frame.rays.start_high[2];
    let start_low = frame.rays.start_low[0] + at.x * frame.rays.start_low[1] + at.y * frame.rays.start_low[2];
    let step_high = frame.rays.step_high[0] + at.x * frame.rays.step_high[1] + at.y * frame.rays.step_high[2];
    let step_low = frame.rays.step_low[0] + at.x * frame.rays.step_low[1] + at.y * frame.rays.step_low[2];
    let start = start_high + start_low;
    let step = step_high + step_low;
    return Ray(start.xyz, step.xyz, frame.step_mm * sqrt(1.0 + start.w * start.w + step.w * step.w));
}

// Voxel coordinates of a sample. This value alone decides which brick, cell and fraction the sample has.
fn sample_voxel(ray: Ray, number: f32) -> vec3f {
    return ray.start + number * ray.step;
}

fn is_inside(at: vec3f, low: vec3f, high: vec3f) -> bool {
    return all(at >= low) && all(at < high);
}

// The numbers between which a ray is in a box, with as much to spare as rounding can be off; the first is above the last
// where it passes the box by.
fn numbers_between(ray: Ray, low: vec3f, high: vec3f) -> vec2f {
    let goes_up = ray.step > vec3f(0.0);
    let near = select(high, low, goes_up);
    let far = select(low, high, goes_up);
    let is_still = ray.step == vec3f(0.0);
    let largest = abs(ray.start) + max(abs(low), abs(high));
    let slack = largest * 2.5e-7 / abs(ray.step) + 1.0;
    let enter = select((near - ray.start) / ray.step - slack, vec3f(-1e30), is_still);
    let leave = select((far - ray.start) / ray.step + slack, vec3f(1e30), is_still);
    return vec2f(max(enter.x, max(enter.y, enter.z)), min(leave.x, min(leave.y, leave.z)));
}

// The first sample that lies in the volume; the ray's end where there is none. Estimated from where the ray meets the box,
// then settled by the samples themselves.
fn first_in_volume(ray: Ray) -> u32 {
    let between = numbers_between(ray, frame.volume_low, frame.volume_high);
    let leaves = clamp(between.y + 1.0, 0.0, f32(frame.sample_count));
    let last = u32(leaves);
    var first = u32(clamp(between.x, 0.0, leaves));
    while first < last && !is_inside(sample_voxel(ray, f32(first)), frame.volume_low, frame.volume_high) {
        first += 1u;
    }
    return select(frame.sample_count, first, first < last);
}
