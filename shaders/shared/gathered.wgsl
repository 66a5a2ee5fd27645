#define_import_path glassbrick::gathered
#import glassbrick::frame::frame

// What a ray has gathered, and where it goes on.
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

const NO_SAMPLE: u32 = 0u;

// Whether no sample up to a rank can change what the ray gathered.
fn is_unchanged_by(state: RayState, rank: f32) -> bool {
#ifdef EXTREMUM
    let gathered = frame.rank_from_stored.x * frame.sign * state.gathered.x + frame.rank_from_stored.y;
    return state.surface != NO_SAMPLE && rank <= gathered;
#else
    return false;
#endif
}
