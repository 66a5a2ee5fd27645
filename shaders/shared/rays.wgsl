#define_import_path glassbrick::rays
#import glassbrick::frame::frame

// What a column or a row of the picture adds to its rays. A position is the sum of its column's and its row's part;
// of each part `high` is a multiple of one power of two, so that highs add without rounding, and `low` is the rest.
struct RayPart {
    // Position of sample number 0, in voxels; w: distance from the picture's middle at depth 1.
    start_high: vec4f,
    start_low: vec4f,
    // From one sample to the next, in voxels.
    step_high: vec4f,
    step_low: vec4f,
}

struct Ray {
    // Position of sample number 0, in voxels.
    start: vec3f,
    step: vec3f,
    step_length_mm: f32,
}

// Columns of the picture, then its rows.
@group(0) @binding(1) var<storage, read> ray_parts: array<RayPart>;

// The ray of a pixel of the picture: the f32 values that the CPU forms in f64 and rounds.
fn ray_of(pixel: vec2u) -> Ray {
    let column = ray_parts[pixel.x];
    let row = ray_parts[frame.picture_width + pixel.y];
    let start = (column.start_high + row.start_high) + (column.start_low + row.start_low);
    let step = (column.step_high + row.step_high) + (column.step_low + row.step_low);
    let aside = vec2f(column.start_high.w, row.start_high.w);
    return Ray(start.xyz, step.xyz, frame.step_mm * sqrt(1.0 + dot(aside, aside)));
}

// Voxel coordinates of a sample. This value alone decides which brick, cell and fraction the sample has.
fn sample_voxel(ray: Ray, number: u32) -> vec3f {
    return ray.start + f32(number) * ray.step;
}

fn is_inside(at: vec3f, low: vec3f, high: vec3f) -> bool {
    return all(at >= low) && all(at < high);
}

// One past the last sample, of those from `number` on, that lies in the half-open box [low, high), in which sample
// `number` lies. Estimated from where the ray leaves the box, then settled by the samples themselves.
fn end_in_box(ray: Ray, number: u32, low: vec3f, high: vec3f) -> u32 {
    let bound = select(low, high, ray.step > vec3f(0.0));
    let apart = select(vec3f(1e30), (bound - ray.start) / ray.step, ray.step != vec3f(0.0));
    let leaves = clamp(min(apart.x, min(apart.y, apart.z)), 0.0, f32(frame.sample_count));
    var end = max(u32(ceil(leaves)), number + 1u);
    while end > number + 1u && !is_inside(sample_voxel(ray, end - 1u), low, high) {
        end -= 1u;
    }
    while end < frame.sample_count && is_inside(sample_voxel(ray, end), low, high) {
        end += 1u;
    }
    return end;
}

// The first sample from `number` on that lies in the volume; the ray's end where there is none. Estimated from where the
// ray meets the box, with as much to spare as rounding can be off, then settled by the samples themselves.
fn first_in_volume(ray: Ray, number: u32) -> u32 {
    let low = frame.volume_low;
    let high = frame.volume_high;
    let goes_up = ray.step > vec3f(0.0);
    let near = select(high, low, goes_up);
    let far = select(low, high, goes_up);
    let is_still = ray.step == vec3f(0.0);
    let slack = (abs(ray.start) + max(abs(low), abs(high))) * 2.5e-7 / abs(ray.step) + 1.0;
    let enter = select((near - ray.start) / ray.step - slack, vec3f(-1e30), is_still);
    let leave = select((far - ray.start) / ray.step + slack, vec3f(1e30), is_still);
    let count = frame.sample_count;
    let enters = clamp(max(enter.x, max(enter.y, enter.z)), f32(number), f32(count));
    let leaves = clamp(min(leave.x, min(leave.y, leave.z)), 0.0, f32(count));
    let last = min(u32(leaves) + 1u, count);
    var first = u32(enters);
    while first < last && !is_inside(sample_voxel(ray, first), low, high) {
        first += 1u;
    }
    return select(count, first, first < last);
}
