#import glassbrick::frame::frame
#import glassbrick::rays::{Ray, ray_of, sample_voxel, end_in_box, first_in_volume}
#import glassbrick::bricks::{owner, brick_index, core_start, owned_low, owned_high}
#import glassbrick::atlas::{stored_value, gradient}
#ifdef DVR
#import glassbrick::transfer_function::look_up
#import glassbrick::light::shade
#endif

// One march per pixel through the resident bricks. A ray that meets a brick that is needed and not resident asks for
// it, keeps what it has gathered, and goes on from there when the pass is run again.

struct RayState {
    // DVR: premultiplied colour and opacity. Else: x is the extremal value times the sign, or the sum of the values.
    gathered: vec4f,
    // The sample to go on with; the ray's end when it is done.
    next: u32,
    // One more than the sample that the pixel's depth is taken from; 0 where there is none.
    surface: u32,
    // Samples evaluated.
    samples: u32,
    padding: u32,
}

// Page table entries that are not slots.
const NOT_PLANNED: u32 = 0xffffffffu;
const MISSING: u32 = 0xfffffffeu;
const NO_SAMPLE: u32 = 0u;
// What became of a brick in this frame.
const ASKED_FOR: u32 = 1u;
const RENDERED: u32 = 2u;

@group(0) @binding(3) var<storage, read> page_table: array<u32>;
// First texel of each slot, and its texture.
@group(0) @binding(4) var<storage, read> slot_places: array<vec4u>;
// Smallest and largest stored value that samples in a brick can have.
@group(0) @binding(5) var<storage, read> reaches: array<vec2f>;
@group(0) @binding(6) var<storage, read_write> states: array<RayState>;
// Of each brick.
@group(0) @binding(7) var<storage, read_write> fates: array<atomic<u32>>;

// Whether no sample of a brick can change what the ray gathered.
fn is_unchanged_by(state: RayState, index: u32) -> bool {
#ifdef EXTREMUM
    let reach = reaches[index];
    let best = select(-reach.x, reach.y, frame.sign > 0.0);
    return frame.skips_unchanged == 1u && state.surface != NO_SAMPLE && state.gathered.x >= best;
#else
    return false;
#endif
}

struct Slot {
    texture: u32,
    // Texel of voxel (0, 0, 0).
    texel_from_voxel: vec3f,
}

fn slot_of(entry: u32, brick: vec3u) -> Slot {
    let place = slot_places[entry];
    return Slot(place.w, vec3f(place.xyz) + f32(frame.halo) - core_start(brick));
}

// Adds a sample; whether the ray stops after it.
fn add(state: ptr<function, RayState>, slot: Slot, ray: Ray, number: u32) -> bool {
    let texel = sample_voxel(ray, number) + slot.texel_from_voxel;
    let stored = stored_value(slot.texture, texel);
#ifdef DVR
    let entry = look_up(stored);
    if entry.a <= 0.0 {
        return false;
    }
    let gathered = (*state).gathered;
    let weight = (1.0 - gathered.a) * (1.0 - exp(-entry.a * ray.step_length_mm));
#ifdef SHADED
    let color = shade(entry.rgb, gradient(slot.texture, texel), ray);
#else
    let color = entry.rgb;
#endif
    let opacity = gathered.a + weight;
    (*state).gathered = vec4f(gathered.rgb + weight * color, opacity);
    if opacity >= 0.5 && (*state).surface == NO_SAMPLE {
        (*state).surface = number + 1u;
    }
    return opacity >= frame.opacity_cutoff;
#else
#ifdef EXTREMUM
    let signed = frame.sign * stored;
    if (*state).surface == NO_SAMPLE || signed > (*state).gathered.x {
        (*state).gathered.x = signed;
        (*state).surface = number + 1u;
    }
#else
    // The sum of many values, with what its rounding lost.
    let lost = stored - (*state).gathered.y;
    let sum = (*state).gathered.x + lost;
    (*state).gathered.y = (sum - (*state).gathered.x) - lost;
    (*state).gathered.x = sum;
    (*state).gathered.z += 1.0;
#endif
    return false;
#endif
}

@compute @workgroup_size(8, 8)
fn raycast(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.tile_size) {
        return;
    }
    let place = id.y * frame.tile_size.x + id.x;
    var state = states[place];
    let ray = ray_of(id.xy + frame.tile_origin);
    let count = frame.sample_count;
    var number = state.next;
    if number < count {
        number = first_in_volume(ray, number);
    }
    let volume_end = select(count, end_in_box(ray, number, frame.volume_low, frame.volume_high), number < count);
    while number < volume_end {
        let brick = owner(sample_voxel(ray, number));
        let index = brick_index(brick);
        let entry = page_table[index];
        let end = end_in_box(ray, number, owned_low(brick), owned_high(brick));
        if entry == NOT_PLANNED || is_unchanged_by(state, index) {
            number = end;
            continue;
        }
        if entry == MISSING {
            atomicOr(&fates[index], ASKED_FOR);
            if frame.passes_missing == 1u {
                number = end;
                continue;
            }
            break;
        }
        atomicOr(&fates[index], RENDERED);
        let slot = slot_of(entry, brick);
        let first = number;
        var is_done = false;
        while number < end && !is_done {
            is_done = add(&state, slot, ray, number);
            number += 1u;
        }
        state.samples += number - first;
        if is_done {
            number = volume_end;
        }
    }
    state.next = select(number, count, number >= volume_end);
    states[place] = state;
}
