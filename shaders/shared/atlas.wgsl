#define_import_path glassbrick::atlas
#import glassbrick::frame::frame

// Reads stored values between the texels of an atlas texture. MANY_TEXTURES: which of sixteen textures is chosen for
// each brick; else there is one. FILTERS: by the texture unit; else by eight loads, exact on every device.

#ifdef FILTERS
@group(1) @binding(16) var linear: sampler;

fn value_in(texture: texture_3d<f32>, texel: vec3f) -> f32 {
    let at = (texel + 0.5) * frame.atlas_from_texel;
    return dot(textureSampleLevel(texture, linear, at, 0.0).rg, frame.stored_from_texel) + frame.stored_bias;
}
#else
fn load(texture: texture_3d<f32>, texel: vec3u) -> f32 {
    return dot(textureLoad(texture, texel, 0).rg, frame.stored_from_texel);
}

fn value_in(texture: texture_3d<f32>, texel: vec3f) -> f32 {
    let cell = floor(texel);
    let t = texel - cell;
    let a = vec3u(cell);
    let b = a + 1u;
    let low = mix(
        mix(load(texture, a), load(texture, vec3u(b.x, a.y, a.z)), t.x),
        mix(load(texture, vec3u(a.x, b.y, a.z)), load(texture, vec3u(b.x, b.y, a.z)), t.x),
        t.y,
    );
    let high = mix(
        mix(load(texture, vec3u(a.x, a.y, b.z)), load(texture, vec3u(b.x, a.y, b.z)), t.x),
        mix(load(texture, vec3u(a.x, b.y, b.z)), load(texture, b), t.x),
        t.y,
    );
    return mix(low, high, t.z) + frame.stored_bias;
}
#endif

@group(1) @binding(0) var atlas: texture_3d<f32>;
#ifdef MANY_TEXTURES
@group(1) @binding(1) var atlas_b: texture_3d<f32>;
@group(1) @binding(2) var atlas_c: texture_3d<f32>;
@group(1) @binding(3) var atlas_d: texture_3d<f32>;
@group(1) @binding(4) var atlas_e: texture_3d<f32>;
@group(1) @binding(5) var atlas_f: texture_3d<f32>;
@group(1) @binding(6) var atlas_g: texture_3d<f32>;
@group(1) @binding(7) var atlas_h: texture_3d<f32>;
@group(1) @binding(8) var atlas_i: texture_3d<f32>;
@group(1) @binding(9) var atlas_j: texture_3d<f32>;
@group(1) @binding(10) var atlas_k: texture_3d<f32>;
@group(1) @binding(11) var atlas_l: texture_3d<f32>;
@group(1) @binding(12) var atlas_m: texture_3d<f32>;
@group(1) @binding(13) var atlas_n: texture_3d<f32>;
@group(1) @binding(14) var atlas_o: texture_3d<f32>;
@group(1) @binding(15) var atlas_p: texture_3d<f32>;

// The stored value at a place between the texels of one of the atlas textures.
fn stored_value(texture: u32, texel: vec3f) -> f32 {
    switch texture {
        case 1u: { return value_in(atlas_b, texel); }
        case 2u: { return value_in(atlas_c, texel); }
        case 3u: { return value_in(atlas_d, texel); }
        case 4u: { return value_in(atlas_e, texel); }
        case 5u: { return value_in(atlas_f, texel); }
        case 6u: { return value_in(atlas_g, texel); }
        case 7u: { return value_in(atlas_h, texel); }
        case 8u: { return value_in(atlas_i, texel); }
        case 9u: { return value_in(atlas_j, texel); }
        case 10u: { return value_in(atlas_k, texel); }
        case 11u: { return value_in(atlas_l, texel); }
        case 12u: { return value_in(atlas_m, texel); }
        case 13u: { return value_in(atlas_n, texel); }
        case 14u: { return value_in(atlas_o, texel); }
        case 15u: { return value_in(atlas_p, texel); }
        default: { return value_in(atlas, texel); }
    }
}
#else
// The stored value at a place between the texels of the atlas texture.
fn stored_value(texture: u32, texel: vec3f) -> f32 {
    return value_in(atlas, texel);
}
#endif

// Change of the stored value per voxel along each axis: central differences of one voxel.
fn gradient(texture: u32, texel: vec3f) -> vec3f {
    let x = vec3f(1.0, 0.0, 0.0);
    let y = vec3f(0.0, 1.0, 0.0);
    let z = vec3f(0.0, 0.0, 1.0);
    return 0.5 * vec3f(
        stored_value(texture, texel + x) - stored_value(texture, texel - x),
        stored_value(texture, texel + y) - stored_value(texture, texel - y),
        stored_value(texture, texel + z) - stored_value(texture, texel - z),
    );
}
