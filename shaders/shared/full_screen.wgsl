#define_import_path glassbrick::full_screen

// One triangle that covers the whole picture.
fn full_screen_corner(index: u32) -> vec4f {
    return vec4f(f32(index & 1u) * 4.0 - 1.0, f32(index & 2u) * 2.0 - 1.0, 0.0, 1.0);
}
