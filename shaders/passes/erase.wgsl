#import glassbrick::full_screen::full_screen_corner

// Empties the part of a picture that is drawn to.

@vertex
fn erase_corner(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return full_screen_corner(index);
}

@fragment
fn erase_pixel() -> @location(0) vec4f {
    return vec4f(0.0);
}
