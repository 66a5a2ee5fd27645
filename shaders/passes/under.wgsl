#import glassbrick::full_screen::full_screen_corner

// Puts a layer's image under what lies in front of it: the blend state does the arithmetic.

@group(0) @binding(0) var layer_image: texture_2d<f32>;

@vertex
fn under_corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

@fragment
fn under_pixel(@builtin(position) at: vec4f) -> @location(0) vec4f {
    return textureLoad(layer_image, vec2u(at.xy), 0);
}
