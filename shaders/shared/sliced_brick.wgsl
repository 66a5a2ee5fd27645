#define_import_path glassbrick::sliced_brick

// A brick as slices and boxes are drawn of it. Written once in Rust as `SlicedBrick`.
struct SlicedBrick {
    // The corners of its box, a little larger, in clip space before the division; z is the slice that they lie in.
    // Bit 0 of a corner's number chooses along the first axis and so on; corner 0 is nearest, corner 7 farthest.
    corners: array<vec4f, 8>,
    // The half-open box of samples that it owns.
    owned_low: vec3f,
    // The farthest slice, which is drawn first.
    last_slice: f32,
    owned_high: vec3f,
    // Where in [0, 1] the best stored value lies that a sample can have, for projections.
    best: f32,
    // Texel of voxel (0, 0, 0).
    texel_from_voxel: vec3f,
    // The nearest slice.
    first_slice: f32,
}

@group(2) @binding(0) var<uniform> brick: SlicedBrick;
