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
