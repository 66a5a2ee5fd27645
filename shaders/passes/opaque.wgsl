#import glassbrick::full_screen::full_screen_corner
#import glassbrick::frame::{frame, frame_uniform}

// Finds the pixels whose accumulated opacity has reached the cutoff; the stencil keeps them.

@group(1) @binding(0) var accumulated: texture_2d<f32>;

@vertex
fn opaque_corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

@fragment
fn opaque_pixel(@builtin(position) at: vec4f) {
    frame = frame_uniform;
    if textureLoad(accumulated, vec2u(at.xy), 0).a < frame.opacity_cutoff {
        discard;
    }
}
