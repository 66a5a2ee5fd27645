#import glassbrick::frame::{frame, frame_uniform, PASSES_MISSING}
#import glassbrick::rays::{ray_of, first_in_volume}
#import glassbrick::gathered::RayState
#import glassbrick::search::{find, MISSING}
#import glassbrick::samples::gather

// One march per pixel through the resident bricks. A ray that meets a brick that is needed and not resident asks for
// it, keeps what it has gathered, and goes on from there when the pass is run again.

// What became of a brick in this frame.
const ASKED_FOR: u32 = 1u;
const RENDERED: u32 = 2u;

@group(0) @binding(6) var<storage, read_write> states: array<RayState>;
// Of each brick.
@group(0) @binding(7) var<storage, read_write> fates: array<atomic<u32>>;

// The pixels of a group, so that those of four, eight and so on that follow one another lie near one another: rays that
// drivers run in step then take much the same way.
fn near_one_another(index: u32) -> vec2u {
    let spread = vec2u(index, index >> 1u) & vec2u(0x15u);
    return (spread & vec2u(1u)) | ((spread >> vec2u(1u)) & vec2u(2u)) | ((spread >> vec2u(2u)) & vec2u(4u));
}

@compute @workgroup_size(8, 8)
fn raycast(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) index: u32) {
    frame = frame_uniform;
    let pixel = 8u * group.xy + near_one_another(index);
    if any(pixel >= frame.tile_size) {
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
    if number < count {
        loop {
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
            } else {
                let reached = gather(&state, found.slot, ray, number, found.end);
                state.samples += reached.number - number;
                number = select(reached.number, count, reached.is_done);
            }
            if number >= count {
                break;
            }
        }
    }
    state.next = min(number, count);
    states[place] = state;
}
