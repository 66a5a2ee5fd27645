#define_import_path glassbrick::samples
#import glassbrick::frame::frame
#import glassbrick::rays::{Ray, sample_voxel}
#import glassbrick::atlas::{stored_value, gradient}
#import glassbrick::gathered::{RayState, NO_SAMPLE}
#import glassbrick::search::Slot
#ifdef DVR
#import glassbrick::transfer_function::look_up
#import glassbrick::light::shade
#endif

// Where a ray is after some samples.
struct Reached {
    // The sample to go on with.
    number: u32,
    // Whether it stops here.
    is_done: bool,
}

// Loops below ask at their end whether they go on: drivers that run rays in step run a loop's body once more, for no ray,
// where it asks at the start.

#ifdef DVR
// A sample that may show something.
struct Shown {
    texel: vec3f,
    // Colour and extinction.
    entry: vec4f,
    // The sample behind it.
    next: u32,
}

// The next sample. With shading, which is dear, the next one that shows something, or the last before `end`: so that rays
// in step shade together.
fn next_shown(slot: Slot, ray: Ray, first: u32, end: u32) -> Shown {
    var shown: Shown;
    shown.next = first;
    loop {
        shown.texel = sample_voxel(ray, f32(shown.next)) + slot.texel_from_voxel;
        shown.entry = look_up(stored_value(slot.texture, shown.texel));
        shown.next += 1u;
#ifdef SHADED
        if shown.entry.a > 0.0 || shown.next >= end {
            break;
        }
#else
        break;
#endif
    }
    return shown;
}

// Gathers a slot's samples from `first` to before `end`, of which there is one at least, or until the ray stops.
fn gather(state: ptr<function, RayState>, slot: Slot, ray: Ray, first: u32, end: u32) -> Reached {
    var number = first;
    var is_done = false;
    loop {
        let shown = next_shown(slot, ray, number, end);
        number = shown.next;
        let gathered = (*state).gathered;
        let weight = (1.0 - gathered.a) * (1.0 - exp(-shown.entry.a * ray.step_length_mm));
        let opacity = gathered.a + weight;
        var color = shown.entry.rgb;
#ifdef SHADED
        if weight > 0.0 {
            color = shade(color, gradient(slot.texture, shown.texel), ray);
        }
#endif
        (*state).gathered = vec4f(gathered.rgb + weight * color, opacity);
        if opacity >= 0.5 && (*state).surface == NO_SAMPLE {
            (*state).surface = number;
        }
        is_done = opacity >= frame.opacity_cutoff;
        if is_done || number >= end {
            break;
        }
    }
    return Reached(number, is_done);
}
#else
fn gather(state: ptr<function, RayState>, slot: Slot, ray: Ray, first: u32, end: u32) -> Reached {
    var number = first;
    loop {
        let texel = sample_voxel(ray, f32(number)) + slot.texel_from_voxel;
        let stored = stored_value(slot.texture, texel);
        number += 1u;
#ifdef EXTREMUM
        let signed = frame.sign * stored;
        if (*state).surface == NO_SAMPLE || signed > (*state).gathered.x {
            (*state).gathered.x = signed;
            (*state).surface = number;
        }
#else
        // The sum of many values, with what its rounding lost.
        let lost = stored - (*state).gathered.y;
        let sum = (*state).gathered.x + lost;
        (*state).gathered.y = (sum - (*state).gathered.x) - lost;
        (*state).gathered.x = sum;
        (*state).gathered.z += 1.0;
#endif
        if number >= end {
            break;
        }
    }
    return Reached(number, false);
}
#endif
