#import glassbrick::frame::frame
#import glassbrick::rays::{Ray, ray_of, sample_voxel, is_inside}
#import glassbrick::sliced_brick::brick
#import glassbrick::atlas::{stored_value, gradient}
#ifdef DVR
#import glassbrick::transfer_function::look_up
#import glassbrick::light::shade
#endif

// The slices of one brick, farthest first: where a plane of samples cuts the brick's box. The polygon is a conservative
// proxy; the fragment forms its sample from the pixel and the slice, and is dropped where the brick does not own it.

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) number: u32,
}

// Where a path of edges from corner to corner, farther and farther, crosses a slice.
fn crossing(path: vec4u, slice: f32) -> vec4f {
    var a = path.x;
    var b = path.y;
    if brick.corners[b].z < slice {
        a = path.y;
        b = path.z;
    }
    if brick.corners[b].z < slice {
        a = path.z;
        b = path.w;
    }
    return on_edge(a, b, slice);
}

fn on_edge(a: u32, b: u32, slice: f32) -> vec4f {
    let from_corner = brick.corners[a];
    let to_corner = brick.corners[b];
    let t = clamp((slice - from_corner.z) / max(to_corner.z - from_corner.z, 1e-20), 0.0, 1.0);
    return mix(from_corner, to_corner, t);
}

// The corners of the polygon in which a plane cuts a box (Salama and Kolb 2005): three on paths from the nearest corner
// to the farthest, and between them three on the edges that are left, or else again what is before them.
fn polygon_corner(corner: u32, slice: f32) -> vec4f {
    var paths = array<vec4u, 3>(vec4u(0u, 1u, 3u, 7u), vec4u(0u, 4u, 5u, 7u), vec4u(0u, 2u, 6u, 7u));
    var between = array<vec2u, 3>(vec2u(1u, 5u), vec2u(4u, 6u), vec2u(2u, 3u));
    let pair = corner / 2u;
    if corner % 2u == 1u {
        let edge = between[pair];
        if brick.corners[edge.x].z < slice && slice < brick.corners[edge.y].z {
            return on_edge(edge.x, edge.y, slice);
        }
    }
    return crossing(paths[pair], slice);
}

@vertex
fn slice_polygon(@builtin(vertex_index) corner: u32, @builtin(instance_index) instance: u32) -> Vertex {
    let slice = brick.last_slice - f32(instance);
    let at = polygon_corner(corner, slice);
    return Vertex(vec4f(at.xy, 0.0, at.w), u32(slice));
}

struct Fragment {
    @location(0) color: vec4f,
#ifdef EXTREMUM
    @builtin(frag_depth) rank: f32,
#endif
}

@fragment
fn slice_sample(vertex: Vertex) -> Fragment {
    let ray = ray_of(vec2u(vertex.clip.xy) + frame.tile_origin);
    let at = sample_voxel(ray, vertex.number);
    if !is_inside(at, brick.owned_low, brick.owned_high) {
        discard;
    }
    let texel = at + brick.texel_from_voxel;
    let stored = stored_value(0u, texel);
#ifdef DVR
    let entry = look_up(stored);
    let opacity = 1.0 - exp(-entry.a * ray.step_length_mm);
#ifdef SHADED
    let color = shade(entry.rgb, gradient(0u, texel), ray);
#else
    let color = entry.rgb;
#endif
    return Fragment(vec4f(opacity * color, opacity));
#else
#ifdef EXTREMUM
    // The depth test keeps the best value of all slices.
    return Fragment(vec4f(stored, 0.0, 0.0, 1.0), rank_of(stored));
#else
    return Fragment(vec4f(stored, 1.0, 0.0, 0.0));
#endif
#endif
}

#ifdef EXTREMUM
// Where in [0, 1] a value lies between those that the volume has, the best at 1. Above 0: 0 is no value at all.
fn rank_of(stored: f32) -> f32 {
    return clamp(frame.rank_from_stored.x * stored + frame.rank_from_stored.y, 1e-6, 1.0);
}
#endif
