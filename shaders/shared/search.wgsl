#define_import_path glassbrick::search
#import glassbrick::frame::{frame, PASSES_MISSING, SKIPS_UNCHANGED}
#import glassbrick::rays::{Ray, sample_voxel, is_inside}
#import glassbrick::bricks::{owner, brick_index, core_start}
#import glassbrick::cells::{cell_answer, behind_box, CELL_EDGE}
#import glassbrick::gathered::{RayState, is_unchanged_by}

// Page table entries that are not slots. A brick that is not planned has its distance to the nearest one that is, in
// bricks along the farthest axis, in the other bits.
const NOT_PLANNED: u32 = 0x80000000u;
const MISSING: u32 = 0xffffffffu;

// Of each brick: its entry, and where its slot lies: along x, y and z in bricks, 9 bits each, and the texture.
@group(0) @binding(3) var<storage, read> page_table: array<vec2u>;
// Smallest and largest stored value that samples in a brick can have.
@group(0) @binding(5) var<storage, read> reaches: array<vec2f>;

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

// Goes on from a sample of the volume to the next one that may count, leaping over bricks that are not planned and over
// cells and bricks that cannot change the pixel. One loop for all leaps: drivers that run rays in step wait for the
// slowest.
fn find(state: RayState, ray: Ray, first: u32) -> Found {
    var found = Found(first, 0u, NOT_PLANNED, Slot(0u, vec3f(0.0)), first);
    let core = f32(frame.core);
    loop {
        let at = sample_voxel(ray, f32(found.number));
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
        if found.number >= frame.sample_count {
            break;
        }
    }
    return found;
}
