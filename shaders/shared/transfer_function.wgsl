#define_import_path glassbrick::transfer_function
#import glassbrick::frame::frame

// Extinction per mm.
@group(0) @binding(2) var<storage, read> extinctions: array<f32>;
// Red, green and blue in linear light.
@group(0) @binding(9) var<storage, read> colors: array<vec4f>;

// A place between two entries.
struct Entry {
    index: u32,
    fraction: f32,
}

// Where a stored value stands in the baked transfer function.
fn entry_of(stored: f32) -> Entry {
    let last = arrayLength(&extinctions) - 1u;
    let at = clamp((stored - frame.first_stored) * frame.entries_per_stored, 0.0, f32(last));
    let index = min(u32(at), last - 1u);
    return Entry(index, at - f32(index));
}

fn extinction(entry: Entry) -> f32 {
    return mix(extinctions[entry.index], extinctions[entry.index + 1u], entry.fraction);
}

fn color_of(entry: Entry) -> vec3f {
    return mix(colors[entry.index], colors[entry.index + 1u], entry.fraction).rgb;
}
