#import glassbrick::frame::{frame, frame_uniform}
#import glassbrick::sliced_brick::brick

// The back faces of a brick's box, for occlusion queries: a box is visible where one of its pixels is not opaque yet, or
// for projections where its best value is better than what the pixel has.

struct Vertex {
    @builtin(position) clip: vec4f,
}

@vertex
fn box_corner(@builtin(vertex_index) index: u32) -> Vertex {
    frame = frame_uniform;
    // Two triangles for each face, clockwise as seen from outside.
    var corners = array<u32, 36>(
        0u, 2u, 1u, 1u, 2u, 3u,  4u, 5u, 6u, 5u, 7u, 6u,
        0u, 1u, 4u, 1u, 5u, 4u,  2u, 6u, 3u, 3u, 6u, 7u,
        0u, 4u, 2u, 2u, 4u, 6u,  1u, 3u, 5u, 3u, 7u, 5u,
    );
    let at = brick.corners[corners[index]];
    let depth = frame.box_depth.x + frame.box_depth.y * at.z;
    return Vertex(vec4f(at.xy, depth, at.w));
}

#ifdef EXTREMUM
struct Fragment {
    @builtin(frag_depth) rank: f32,
}

@fragment
fn box_rank() -> Fragment {
    return Fragment(brick.best);
}
#endif
