#define_import_path glassbrick::transfer_function
#import glassbrick::frame::frame

// Red, green and blue in linear light, extinction per mm; one row.
@group(0) @binding(2) var entries: texture_2d<f32>;

// The baked transfer function at a stored value.
fn look_up(stored: f32) -> vec4f {
    let last = textureDimensions(entries).x - 1u;
    let at = clamp((stored - frame.first_stored) * frame.entries_per_stored, 0.0, f32(last));
    let index = min(u32(at), last - 1u);
    let low = textureLoad(entries, vec2u(index, 0u), 0);
    return mix(low, textureLoad(entries, vec2u(index + 1u, 0u), 0), at - f32(index));
}
