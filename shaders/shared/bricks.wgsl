#define_import_path glassbrick::bricks
#import glassbrick::frame::frame

// The brick that owns a sample of the volume. Divided by way of the reciprocal, and put right by exact products.
fn owner(at: vec3f) -> vec3u {
    let from_face = max(at + 0.5, vec3f(0.0));
    let core = f32(frame.core);
    var brick = floor(from_face * frame.cores_per_voxel);
    brick = select(brick, brick - 1.0, brick * core > from_face);
    brick = select(brick, brick + 1.0, (brick + 1.0) * core <= from_face);
    return min(vec3u(brick), frame.grid_counts - 1u);
}

// A brick's place in tables: x fastest.
fn brick_index(brick: vec3u) -> u32 {
    return (brick.z * frame.grid_counts.y + brick.y) * frame.grid_counts.x + brick.x;
}

// First voxel of a brick's core.
fn core_start(brick: vec3u) -> vec3f {
    return vec3f(brick * frame.core);
}
