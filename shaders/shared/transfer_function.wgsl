#define_import_path glassbrick::transfer_function
#import glassbrick::frame::frame

// Red, green and blue in linear light; extinction per mm.
@group(0) @binding(2) var<storage, read> entries: array<vec4f>;

// The baked transfer function at a stored value.
fn look_up(stored: f32) -> vec4f {
    let last = arrayLength(&entries) - 1u;
    let at = clamp((stored - frame.first_stored) * frame.entries_per_stored, 0.0, f32(last));
    let index = min(u32(at), last - 1u);
    return mix(entries[index], entries[index + 1u], at - f32(index));
}
