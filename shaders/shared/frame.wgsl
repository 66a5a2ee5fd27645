#define_import_path glassbrick::frame

// Rays as functions of a pixel's column and row: first + column * across + row * along, in voxels. Each is the sum of
// `high`, a multiple of one power of two so coarse that no such sum is rounded, and `low`, the rest.
struct RayFan {
    // Position of sample number 0; w: how far right of the picture's middle at depth 1.
    start_high: array<vec4f, 3>,
    start_low: array<vec4f, 3>,
    // From one sample to the next; w: how far above the middle.
    step_high: array<vec4f, 3>,
    step_low: array<vec4f, 3>,
}

// What every pass of a frame knows. Written once in Rust as `Frame`.
struct Frame {
    // The tile of the picture that is drawn, in pixels.
    tile_origin: vec2u,
    tile_size: vec2u,
    // Samples of a ray, at most.
    sample_count: u32,
    // 1 / core, rounded.
    cores_per_voxel: f32,
    // Voxels along a brick's core.
    core: u32,
    halo: u32,
    // Bricks along each axis of the level.
    grid_counts: vec3u,
    // PASSES_MISSING, SKIPS_UNCHANGED.
    flags: u32,
    // The volume's box with its margin, in voxels; the outermost cores reach to it.
    volume_low: vec3f,
    opacity_cutoff: f32,
    volume_high: vec3f,
    // 1 to look for the largest stored value, -1 for the smallest.
    sign: f32,
    // Texture coordinates per texel of an atlas texture.
    atlas_from_texel: vec3f,
    // The stored value at which the transfer function's first entry stands.
    first_stored: f32,
    // stored = dot(texel.rg, stored_from_texel) + stored_bias
    stored_from_texel: vec2f,
    stored_bias: f32,
    entries_per_stored: f32,
    // Ambient, diffuse, specular, shininess.
    phong: vec4f,
    // Takes gradients per voxel to world space, up to a common factor: three columns.
    normal_from_gradient: mat3x3f,
    // Length of a step along the view's axis, in mm.
    step_mm: f32,
    // Bytes of a cell, 1 or 2.
    cell_bytes: u32,
    // A box's depth in clip space is x + y times its slice: what is nearer than all samples is clipped, nothing else.
    box_depth: vec2f,
    // For projections: a value's rank, 1 for the best that the volume has, is x times the stored value, and y.
    rank_from_stored: vec2f,
    // Cells along each axis of a brick, and words of each slot's cells; 0 where no cell is leapt over.
    cell_edge: u32,
    cell_words: u32,
    // How rays fan out over the pixels of the picture.
    rays: RayFan,
}

// A brick that is not resident is passed by; else its ray waits for it.
const PASSES_MISSING: u32 = 1u;
// Bricks that cannot change a pixel are left out.
const SKIPS_UNCHANGED: u32 = 2u;

@group(0) @binding(0) var<uniform> frame_uniform: Frame;
// Its copy, which every entry point makes first: software drivers load a uniform anew, and for each ray apart, wherever
// it is read.
var<private> frame: Frame;
