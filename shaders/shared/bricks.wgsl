#define_import_path glassbrick::bricks
#import glassbrick::frame::frame

// The brick that owns a sample of the volume.
fn owner(at: vec3f) -> vec3u {
    let cell = vec3u(max(floor(at + 0.5), vec3f(0.0)));
    return min(cell / frame.core, frame.grid_counts - 1u);
}

// A brick's place in tables: x fastest.
fn brick_index(brick: vec3u) -> u32 {
    return (brick.z * frame.grid_counts.y + brick.y) * frame.grid_counts.x + brick.x;
}

// First voxel of a brick's core.
fn core_start(brick: vec3u) -> vec3f {
    return vec3f(brick * frame.core);
}

// The half-open box of samples that a brick owns: its low corner.
fn owned_low(brick: vec3u) -> vec3f {
    return select(core_start(brick) - 0.5, frame.volume_low, brick == vec3u(0u));
}

// Its high corner.
fn owned_high(brick: vec3u) -> vec3f {
    return select(core_start(brick + 1u) - 0.5, frame.volume_high, brick + 1u == frame.grid_counts);
}
