#import glassbrick::frame::{frame, PASSES_MISSING, SKIPS_UNCHANGED}
#import glassbrick::rays::{Ray, ray_of, sample_voxel, is_inside, first_in_volume}
#import glassbrick::bricks::{owner, brick_index, core_start}
#import glassbrick::atlas::{stored_value, gradient}
#import glassbrick::cells::{cell_answer, behind_box, CELL_EDGE}
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

// Page table entries that are not slots. A brick that is not planned has its distance to the nearest one that is, in
// bricks along the farthest axis, in the other bits.
const NOT_PLANNED: u32 = 0x80000000u;
const MISSING: u32 = 0xffffffffu;
const NO_SAMPLE: u32 = 0u;
// What became of a brick in this frame.
const ASKED_FOR: u32 = 1u;
const RENDERED: u32 = 2u;

// Of each brick: its entry, and where its slot lies: along x, y and z in bricks, 9 bits each, and the texture.
@group(0) @binding(3) var<storage, read> page_table: array<vec2u>;
// Smallest and largest stored value that samples in a brick can have.
@group(0) @binding(5) var<storage, read> reaches: array<vec2f>;
@group(0) @binding(6) var<storage, read_write> states: array<RayState>;
// Of each brick.
@group(0) @binding(7) var<storage, read_write> fates: array<atomic<u32>>;

struct Slot {
    texture: u32,
    // Texel of the volume's voxel (0, 0, 0).
    texel_from_voxel: vec3f,
}

// Where a ray goes on.
struct Found {
    // The next sample; the ray's end where there is none.
    number: u32,
    // Its brick, and what the page table says of it.
    index: u32,
    entry: u32,
    slot: Slot,
    // The samples up to here lie in the same cell, or brick where no cells are asked about.
    end: u32,
}

// Whether no sample up to a rank can change what the ray gathered.
fn is_unchanged_by(state: RayState, rank: f32) -> bool {
#ifdef EXTREMUM
    let gathered = frame.rank_from_stored.x * frame.sign * state.gathered.x + frame.rank_from_stored.y;
    return state.surface != NO_SAMPLE && rank <= gathered;
#else
    return false;
#endif
}

// Goes on from a sample to the next one that may count, leaping over bricks that are not planned and over cells and bricks
// that cannot change the pixel. One loop for all leaps: drivers that run rays in step wait for the slowest.
fn find(state: RayState, ray: Ray, first: u32) -> Found {
    var found = Found(first, 0u, NOT_PLANNED, Slot(0u, vec3f(0.0)), first);
    let core = f32(frame.core);
    while found.number < frame.sample_count {
        let at = sample_voxel(ray, found.number);
        if !is_inside(at, frame.volume_low, frame.volume_high) {
            found.number = frame.sample_count;
            break;
        }
        let brick = owner(at);
        found.index = brick_index(brick);
        let page = page_table[found.index];
        found.entry = page.x;
        let is_planned = found.entry < NOT_PLANNED || found.entry == MISSING;
        // The brick, or all those around it that are not planned either.
        let apart = select(f32(found.entry - NOT_PLANNED), 1.0, is_planned);
        var low = (vec3f(brick) - (apart - 1.0)) * core - 0.5;
        var high = (vec3f(brick) + apart) * core - 0.5;
        var counts = is_planned;
#ifdef EXTREMUM
        let reach = reaches[found.index];
        let ranks = frame.rank_from_stored.x * reach + frame.rank_from_stored.y;
        let skips = (frame.flags & SKIPS_UNCHANGED) != 0u;
        counts = counts && !(skips && is_unchanged_by(state, max(ranks.x, ranks.y)));
#endif
        let is_resident = found.entry < NOT_PLANNED;
        let place = vec3u(page.y, page.y >> 9u, page.y >> 18u) & vec3u(0x1ffu);
        let origin = core_start(brick) - f32(frame.halo);
        found.slot = Slot(page.y >> 27u, vec3f(place) * (core + 2.0 * f32(frame.halo)) - origin);
#ifndef MEAN
        if counts && is_resident && frame.cell_words > 0u {
            let cell = floor((at - origin) / CELL_EDGE);
            let answer = f32(cell_answer(found.entry, vec3u(cell)));
#ifdef DVR
            counts = answer == 0.0;
            let cells = max(answer, 1.0);
#else
            counts = !is_unchanged_by(state, answer / 65535.0);
            let cells = 1.0;
#endif
            low = max(low, (cell - (cells - 1.0)) * CELL_EDGE + origin);
            high = min(high, (cell + cells) * CELL_EDGE + origin);
        }
#endif
        if found.entry == MISSING && counts && (frame.flags & PASSES_MISSING) == 0u {
            found.end = found.number;
            break;
        }
        found.end = behind_box(ray, at, found.number, max(low, frame.volume_low), min(high, frame.volume_high));
        if counts {
            break;
        }
        found.number = found.end;
    }
    return found;
}

// Adds a sample; whether the ray stops after it.
fn add(state: ptr<function, RayState>, slot: Slot, ray: Ray, number: u32) -> bool {
    let texel = sample_voxel(ray, number) + slot.texel_from_voxel;
    let stored = stored_value(slot.texture, texel);
#ifdef DVR
    let entry = look_up(stored);
    let gathered = (*state).gathered;
    let weight = (1.0 - gathered.a) * (1.0 - exp(-entry.a * ray.step_length_mm));
    let opacity = gathered.a + weight;
#ifdef SHADED
    var color = entry.rgb;
    if weight > 0.0 {
        color = shade(color, gradient(slot.texture, texel), ray);
    }
#else
    let color = entry.rgb;
#endif
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
    let pixel = id.xy + frame.march_min;
    if any(pixel >= frame.march_max) {
        return;
    }
    let place = pixel.y * frame.tile_size.x + pixel.x;
    var state = states[place];
    let ray = ray_of(pixel + frame.tile_origin);
    let count = frame.sample_count;
    var number = state.next;
    if number == 0u {
        number = first_in_volume(ray);
    }
    while number < count {
        let found = find(state, ray, number);
        number = found.number;
        if number >= count {
            break;
        }
        let is_missing = found.entry == MISSING;
        atomicOr(&fates[found.index], select(RENDERED, ASKED_FOR, is_missing));
        if is_missing {
            number = found.end;
            if (frame.flags & PASSES_MISSING) == 0u {
                break;
            }
            continue;
        }
        var is_done = false;
        while number < found.end && !is_done {
            is_done = add(&state, found.slot, ray, number);
            number += 1u;
        }
        state.samples += number - found.number;
        number = select(number, count, is_done);
    }
    state.next = min(number, count);
    states[place] = state;
}
