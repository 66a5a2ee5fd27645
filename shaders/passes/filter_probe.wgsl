// How exact a texture unit filters: values between the texels of a small texture, to be compared with the truth.

@group(0) @binding(0) var texels: texture_3d<f32>;
@group(0) @binding(1) var linear: sampler;
// Texture coordinates of each place.
@group(0) @binding(2) var<storage, read> places: array<vec4f>;
@group(0) @binding(3) var<storage, read_write> values: array<f32>;

@compute @workgroup_size(64)
fn filter_probe(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&places) {
        values[id.x] = textureSampleLevel(texels, linear, places[id.x].xyz, 0.0).r;
    }
}
