#import glassbrick::frame::{frame, frame_uniform}
#import glassbrick::rays::{Ray, ray_of, sample_voxel, is_inside, numbers_between}
#import glassbrick::sliced_brick::brick
#import glassbrick::atlas::{stored_value, gradient}
#ifdef DVR
#import glassbrick::transfer_function::look_up
#import glassbrick::light::shade
#endif

// The slices of one brick, in slabs of a few, farthest first. A slab's proxy is the rectangle around the part of the
// brick's box that its slices cut. The fragment forms its samples from the pixel and the slices' numbers, takes those that
// the brick owns, farthest first, and is dropped where there are none.

// Slices of a slab. Known to Rust, too.
const SLAB_SLICES: f32 = 16.0;

struct Vertex {
    @builtin(position) clip: vec4f,
    // The nearest slice of the slab and the farthest.
    @location(0) @interpolate(flat) slices: vec2f,
}

// Where an edge of the box, from a nearer corner to a farther one, crosses a slice, in the picture.
fn on_edge(a: u32, b: u32, slice: f32) -> vec2f {
    let from_corner = brick.corners[a];
    let to_corner = brick.corners[b];
    let t = clamp((slice - from_corner.z) / max(to_corner.z - from_corner.z, 1e-20), 0.0, 1.0);
    let at = mix(from_corner, to_corner, t);
    return at.xy / at.w;
}

@vertex
fn slab_corner(@builtin(vertex_index) corner: u32, @builtin(instance_index) slab: u32) -> Vertex {
    let last = brick.last_slice - f32(slab) * SLAB_SLICES;
    let first = max(last - (SLAB_SLICES - 1.0), brick.first_slice);
    // The corners of what the slab cuts from the box lie on the box's edges.
    var low = vec2f(1e30);
    var high = vec2f(-1e30);
    for (var axis = 1u; axis < 8u; axis *= 2u) {
        for (var a = 0u; a < 8u; a += 1u) {
            let b = a | axis;
            let enters = max(first, brick.corners[a].z);
            let leaves = min(last, brick.corners[b].z);
            if a != b && enters <= leaves {
                let near = on_edge(a, b, enters);
                let far = on_edge(a, b, leaves);
                low = min(low, min(near, far));
                high = max(high, max(near, far));
            }
        }
    }
    // Two triangles.
    let is_right = corner == 1u || corner == 2u || corner == 4u;
    let is_top = corner == 2u || corner == 4u || corner == 5u;
    return Vertex(vec4f(select(low, high, vec2<bool>(is_right, is_top)), 0.0, 1.0), vec2f(first, last));
}

struct Fragment {
    @location(0) color: vec4f,
#ifdef EXTREMUM
    @builtin(frag_depth) rank: f32,
#endif
}

struct Found {
    // Whether the brick owns the sample, and with shading, whether it shows anything.
    counts: bool,
    texel: vec3f,
    stored: f32,
#ifdef DVR
    // Colour and extinction.
    entry: vec4f,
#endif
    // The slice in front of it.
    next: f32,
}

// The sample in a slice, if the brick owns it. With shading, which is dear, the farthest up to there that shows something,
// so that pixels in step shade together. Asks at the loop's end whether to go on: drivers that run pixels in step run a
// body once more, for none, where it asks at the start.
fn next_sample(ray: Ray, slice: f32, first: f32) -> Found {
    var found: Found;
    found.next = slice;
    loop {
        let at = sample_voxel(ray, found.next);
        found.counts = found.next >= first && is_inside(at, brick.owned_low, brick.owned_high);
        found.texel = at + brick.texel_from_voxel;
        found.stored = stored_value(0u, found.texel);
        found.next -= 1.0;
#ifdef DVR
        found.entry = look_up(found.stored);
#endif
#ifdef SHADED
        found.counts = found.counts && found.entry.a > 0.0;
        if found.counts || found.next < first {
            break;
        }
#else
        break;
#endif
    }
    return found;
}

@fragment
fn slab_samples(vertex: Vertex) -> Fragment {
    frame = frame_uniform;
    let ray = ray_of(vec2u(vertex.clip.xy) + frame.tile_origin);
    let inside = numbers_between(ray, brick.owned_low, brick.owned_high);
    let first = max(vertex.slices.x, ceil(inside.x));
    var number = min(vertex.slices.y, floor(inside.y));
    // DVR: premultiplied colour and opacity. Extremum: x is the best value times the sign. Mean: sum and count.
    var gathered = vec4f(0.0);
    var is_empty = true;
    loop {
        let found = next_sample(ray, number, first);
        number = found.next;
        if found.counts {
#ifdef DVR
            let opacity = 1.0 - exp(-found.entry.a * ray.step_length_mm);
#ifdef SHADED
            let color = shade(found.entry.rgb, gradient(0u, found.texel), ray);
#else
            let color = found.entry.rgb;
#endif
            gathered = vec4f(opacity * color, opacity) + (1.0 - opacity) * gathered;
#else
#ifdef EXTREMUM
            let signed = frame.sign * found.stored;
            gathered.x = select(max(gathered.x, signed), signed, is_empty);
#else
            gathered += vec4f(found.stored, 1.0, 0.0, 0.0);
#endif
#endif
            is_empty = false;
        }
        if number < first {
            break;
        }
    }
    if is_empty {
        discard;
    }
#ifdef EXTREMUM
    // The depth test keeps the best value of all slabs.
    let stored = frame.sign * gathered.x;
    return Fragment(vec4f(stored, 0.0, 0.0, 1.0), rank_of(stored));
#else
    return Fragment(gathered);
#endif
}

#ifdef EXTREMUM
// Where in [0, 1] a value lies between those that the volume has, the best at 1. Above 0: 0 is no value at all.
fn rank_of(stored: f32) -> f32 {
    return clamp(frame.rank_from_stored.x * stored + frame.rank_from_stored.y, 1e-6, 1.0);
}
#endif
