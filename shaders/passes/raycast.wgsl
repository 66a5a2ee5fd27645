#import glassbrick::frame::{frame, PASSES_MISSING}
#import glassbrick::rays::{ray_of, first_in_volume}
#import glassbrick::gathered::RayState
#import glassbrick::search::{find, MISSING}
#import glassbrick::samples::add

// One march per pixel through the resident bricks. A ray that meets a brick that is needed and not resident asks for
// it, keeps what it has gathered, and goes on from there when the pass is run again.

// What became of a brick in this frame.
const ASKED_FOR: u32 = 1u;
const RENDERED: u32 = 2u;

@group(0) @binding(6) var<storage, read_write> states: array<RayState>;
// Of each brick.
@group(0) @binding(7) var<storage, read_write> fates: array<atomic<u32>>;

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
