// Turns the counts of a layer's occlusion queries into its indirect draws: what no pixel saw is not drawn.

struct DrawArgs {
    vertex_count: u32,
    instance_count: u32,
    first_vertex: u32,
    first_instance: u32,
}

// Which queries are a layer's.
struct QueryRange {
    first: u32,
    count: u32,
}

@group(0) @binding(0) var<uniform> range: QueryRange;
// 64 bits each. Drivers need not count exactly: it is zero or not.
@group(0) @binding(1) var<storage, read> counts: array<vec2u>;
@group(0) @binding(2) var<storage, read_write> draws: array<DrawArgs>;

@compute @workgroup_size(64)
fn visible(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= range.count {
        return;
    }
    let query = range.first + id.x;
    if all(counts[query] == vec2u(0u)) {
        draws[query].instance_count = 0u;
    }
}
